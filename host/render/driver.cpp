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
#include "report.hpp"
#include "session.hpp"
#include "stopwatch.hpp"

namespace ppm::render {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> interruption_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

extern "C" void note_interruption(int) {
  interruption_requested = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

/// Not the second one: a terminal that goes away sends it, and the shell once more.
extern "C" void note_hangup(int) {
  interruption_requested = true;
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

/// Does `deed`, keeping the first Failure for later; the others are warned of.
template <class Deed>
void attempt(std::optional<Failure>& first, Log& log, Deed deed) {
  try {
    deed();
  } catch (const Failure& failure) {
    if (first) log.warn(failure.what());
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
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler == SIG_IGN) return;  // nohup
  action.sa_handler = note_hangup;
  sigaction(SIGHUP, &action, nullptr);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (std::signal(SIGHUP, SIG_DFL) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

bool Interruption::requested() const {
  return interruption_requested;
}

void check_outputs(const Outputs& outputs) {
  for (const auto& file : outputs.pictures) {
    image::check_writable(file);
    if (!image::takes_layers(file)) continue;
    for (const LayerKind kind : outputs.layers) {
      image::check_writable(image::layer_file(file, std::string(facts_of(kind).name)));
    }
  }
  if (!outputs.statistics.empty()) check_creatable(outputs.statistics);
  if (!outputs.keeping.file.empty()) check_creatable(outputs.keeping.file);
  if (!outputs.preview.empty()) image::check_writable(outputs.preview);
  if (outputs.fallback.empty()) return;
  for (const auto& file : outputs.pictures) {
    check_creatable(outputs.fallback / file.filename());
  }
}

Outcome drive(Integrator& integrator, const Settings& settings, const Budget& budget,
              const Outputs& outputs, const Circumstances& circumstances,
              const Interruption& interruption, Log& log, Checkpoint* resumed) {
  const double start = clock_seconds();
  check_outputs(outputs);
  Session session(
      integrator, settings, budget, outputs, circumstances,
      [&] { return interruption.requested(); }, log, resumed);
  const bool complete = session.advance_all();

  // The checkpoint first: with it nothing is lost, whatever happens to the pictures.
  Elsewhere elsewhere(outputs.fallback, log);
  std::optional<Failure> failure;
  attempt(failure, log, [&] { session.keep_last(elsewhere); });
  const Picture picture = integrator.resolve();
  const Statistics statistics = session.statistics();
  warn_of_losses(statistics, log);
  if (!complete) {
    const std::string wanted = budget.passes ? fmt::format(" of {}", *budget.passes) : "";
    log.warn(fmt::format("interrupted after {}{} {}; the picture so far is written",
                         statistics.passes, wanted, pass_names(statistics)));
  }
  const double writing_start = clock_seconds();
  // Without its layers a picture is still a picture.
  std::vector<image::Layer> layers;
  attempt(failure, log, [&] { layers = layers_of(integrator, outputs.layers); });
  for (const auto& file : outputs.pictures) {
    attempt(failure, log, [&] {
      elsewhere.write(
          file, [&](const fs::path& place) { session.write_picture(place, picture, layers); });
      log.note(fmt::format("wrote {}", file.string()));
    });
  }
  session.show_last(picture);
  if (!outputs.statistics.empty()) {
    const std::map<std::string, double> seconds = {
        {"load", circumstances.load_seconds},
        {"write", clock_seconds() - writing_start},
        {"total", circumstances.seconds_before + clock_seconds() - start}};
    attempt(failure, log, [&] {
      elsewhere.write(outputs.statistics, [&](const fs::path& place) {
        write_whole(place,
                    statistics_json(settings, circumstances, statistics, seconds, log.warnings()));
      });
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
