#include "driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <map>
#include <optional>

#include "failure.hpp"
#include "image.hpp"
#include "output_file.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "stopwatch.hpp"

namespace ppm::render {
namespace {

std::atomic<bool> interruption_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

extern "C" void note_interruption(int) {
  interruption_requested = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

/// Whether the budget was spent, or the method is complete. `start`: when the time of the budget
/// began, by clock_seconds.
bool advance_all(Integrator& integrator, const Settings& settings, const Budget& budget,
                 double start, const Interruption& interruption, const Log& log) {
  const auto interrupted = [&] { return interruption.requested(); };
  Progress progress(log, budget.passes, std::uint64_t{settings.width} * settings.height);
  progress.preparing();
  if (!integrator.prepare(interrupted)) return false;
  progress.passing();
  const double prepared = clock_seconds();
  std::uint64_t passes = 0, wanted = budget.passes.value_or(UINT64_MAX);
  while (passes < wanted && !integrator.complete()) {
    std::uint64_t at_a_time = wanted - passes;
    std::optional<double> seconds_left;
    if (budget.seconds) {
      const double now = clock_seconds();
      seconds_left = start + *budget.seconds - now;
      if (*seconds_left <= 0.0 && passes > 0) return true;
      // As many as are likely to end in time; a pass that was begun is finished.
      const double pass_seconds =
          (now - prepared) / static_cast<double>(std::max<std::uint64_t>(passes, 1));
      const double in_time = passes > 0 ? *seconds_left / pass_seconds : 1.0;
      at_a_time = std::min(at_a_time, static_cast<std::uint64_t>(std::clamp(in_time, 1.0, 1e9)));
    }
    const std::uint64_t made = interrupted() ? 0 : integrator.advance_up_to(at_a_time, interrupted);
    if (made == 0) return false;
    passes += made;
    if (budget.seconds) seconds_left = start + *budget.seconds - clock_seconds();
    const bool last =
        passes == wanted || integrator.complete() || seconds_left.value_or(1.0) <= 0.0;
    progress.passed(integrator.statistics(), seconds_left, last);
  }
  return true;
}

/// Of all that makes the picture doubtful. Clamped normal factors do not: every picture of coarse
/// meshes has some.
void warn_of_losses(const Statistics& statistics, Log& log) {
  const auto warn = [&](std::uint64_t count, const char* what) {
    if (count > 0) log.warn(fmt::format("{} {}", count, what));
  };
  const auto rejected = [&](const char* reason) {
    const auto entry = statistics.rejected.find(reason);
    return entry == statistics.rejected.end() ? 0 : entry->second;
  };
  warn(statistics.paths_cut, "paths were cut by the safety cap on their length: light is missing");
  warn(rejected("non_finite"), "photons or hit points were dropped for a NaN or infinity");
  warn(rejected("overflow"), "sums were out of the range of fixed point: light is missing");
}

/// Does `deed`, keeping the first Failure for later.
template <class Deed>
void attempt(std::optional<Failure>& first, Deed deed) {
  try {
    deed();
  } catch (const Failure& failure) {
    if (!first) first = failure;
  }
}

}  // namespace

Interruption::Interruption() {
  interruption_requested = false;
  struct sigaction action = {};
  action.sa_handler = note_interruption;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interruption::requested() const {
  return interruption_requested;
}

void check_outputs(const Outputs& outputs) {
  for (const auto& file : outputs.pictures) image::check_writable(file);
  if (!outputs.statistics.empty()) check_creatable(outputs.statistics);
}

Outcome drive(Integrator& integrator, const Settings& settings, const Budget& budget,
              const Outputs& outputs, const Circumstances& circumstances,
              const Interruption& interruption, Log& log) {
  const double start = clock_seconds();
  check_outputs(outputs);
  const bool complete = advance_all(integrator, settings, budget, start, interruption, log);

  const Picture picture = integrator.resolve();
  const Statistics& statistics = integrator.statistics();
  warn_of_losses(statistics, log);
  if (!complete) {
    const std::string wanted = budget.passes ? fmt::format(" of {}", *budget.passes) : "";
    log.warn(fmt::format("interrupted after {}{} {}; the picture so far is written",
                         statistics.passes, wanted, pass_names(statistics)));
  }
  const double writing_start = clock_seconds();
  const auto attributes = picture_attributes(settings, circumstances, statistics);
  std::optional<Failure> failure;
  for (const auto& file : outputs.pictures) {
    attempt(failure, [&] {
      image::write(file, {picture.width, picture.height, picture.rgb}, outputs.exposure,
                   attributes);
      log.note(fmt::format("wrote {}", file.string()));
    });
  }
  if (!outputs.statistics.empty()) {
    const std::map<std::string, double> seconds = {
        {"load", circumstances.load_seconds},
        {"write", clock_seconds() - writing_start},
        {"total", circumstances.seconds_before + clock_seconds() - start}};
    attempt(failure, [&] {
      write_whole(outputs.statistics,
                  statistics_json(settings, circumstances, statistics, seconds, log.warnings()));
    });
  }
  const auto second = [&](const char* stage) {
    const auto entry = statistics.seconds.find(stage);
    return entry == statistics.seconds.end() ? 0.0 : entry->second;
  };
  log.note(fmt::format(
      "load {:.2f} s, tree {:.2f} s, upload {:.2f} s, eye paths {:.2f} s, pilot {:.2f} s, {:.2f} s "
      "in all; {} triangles, {} hit points",
      circumstances.load_seconds, second("bvh"), second("upload"), second("eye"), second("pilot"),
      circumstances.seconds_before + clock_seconds() - start, statistics.triangles,
      statistics.hit_points));
  if (failure) throw *failure;
  return complete ? Outcome::complete : Outcome::interrupted;
}

}  // namespace ppm::render
