#include "timed_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <variant>

#include "image.hpp"
#include "report.hpp"
#include "stopwatch.hpp"

namespace ppm::compare {
namespace {

using render::clock_seconds;

constexpr std::uint64_t kPassesAtATime = 1u << 16;

std::string text_of(const std::variant<int, double, std::string>& value) {
  return std::visit([](const auto& one) { return fmt::format("{}", one); }, value);
}

/// What tells of one rendering rather than of its method.
bool is_of_one_rendering(const std::string& name) {
  static const std::set<std::string> kNames = {
      "ppm-vk:program",        "ppm-vk:device",  "ppm-vk:driver",    "ppm-vk:scene",
      "ppm-vk:passes",         "ppm-vk:samples", "ppm-vk:mutations", "ppm-vk:photons_emitted",
      "ppm-vk:photons_stored", "ppm-vk:seed"};
  return kNames.contains(name);
}

class Run {
 public:
  Run(const Stage& stage, const Method& method, std::uint32_t seed, const Schedule& schedule,
      const std::filesystem::path& folder)
      : stage_(stage), settings_(method.settings), schedule_(schedule), folder_(folder) {
    settings_.seed = seed;
    record_.label = method.label;
    record_.seed = seed;
    record_.options = options_of(stage, method);
    record_.budget_seconds = schedule.seconds;
  }

  std::optional<RunRecord> make();

 private:
  /// Does `deed` on the clock.
  template <class Deed>
  auto timed(Deed deed) {
    const render::Stopwatch stopwatch(clock_);
    return deed();
  }
  std::uint64_t passes() { return integrator_->statistics().passes; }
  bool is_over();
  /// Passes that may be made before the schedule wants something.
  std::uint64_t passes_until_due();
  /// Whether the schedule wants a picture now.
  bool is_due();
  void keep();

  const Stage& stage_;
  render::Settings settings_;
  const Schedule& schedule_;
  std::filesystem::path folder_;
  Log log_{Verbosity::quiet};
  RunRecord record_;
  std::unique_ptr<render::Integrator> integrator_;
  double clock_ = 0.0;
  double resolve_seconds_ = 0.0;  // of the last picture: what the next is going to take
  std::size_t next_moment_ = 0, next_pass_ = 0;
};

bool Run::is_over() {
  if (integrator_->complete()) return record_.complete = true;
  if (schedule_.last_pass && passes() >= *schedule_.last_pass) return true;
  return schedule_.seconds > 0.0 && passes() > 0 && clock_ + resolve_seconds_ >= schedule_.seconds;
}

std::uint64_t Run::passes_until_due() {
  const std::uint64_t made = passes();
  if (schedule_.pass_by_pass || made == 0) return 1;
  std::uint64_t most = kPassesAtATime;
  if (schedule_.last_pass) most = std::min(most, *schedule_.last_pass - made);
  if (next_pass_ < schedule_.passes.size()) {
    most = std::min(most, schedule_.passes[next_pass_] - made);
  }
  const double until =
      next_moment_ < schedule_.moments.size() ? schedule_.moments[next_moment_] : schedule_.seconds;
  const double pass_seconds = (clock_ - record_.prepare_seconds) / static_cast<double>(made);
  if (until > 0.0 && pass_seconds > 0.0) {
    const double fitting = std::max(1.0, (until - clock_) / pass_seconds);
    if (fitting < static_cast<double>(most)) most = static_cast<std::uint64_t>(fitting);
  }
  return std::max<std::uint64_t>(most, 1);
}

bool Run::is_due() {
  bool due = false;
  while (next_moment_ < schedule_.moments.size() && clock_ >= schedule_.moments[next_moment_]) {
    ++next_moment_;
    due = true;
  }
  while (next_pass_ < schedule_.passes.size() && passes() >= schedule_.passes[next_pass_]) {
    ++next_pass_;
    due = true;
  }
  return due;
}

void Run::keep() {
  resolve_seconds_ = 0.0;
  render::Picture picture;
  {
    const render::Stopwatch stopwatch(resolve_seconds_);
    picture = integrator_->resolve();
  }
  const render::Statistics& statistics = integrator_->statistics();
  KeptPicture kept;
  kept.file = fmt::format("{:08}.exr", statistics.passes);
  kept.seconds = clock_ + resolve_seconds_;
  kept.resolve_seconds = resolve_seconds_;
  kept.passes = statistics.passes;
  kept.samples = statistics.samples;
  kept.mutations = statistics.mutations;
  kept.photons_emitted = statistics.photons_emitted;
  kept.photons_stored = statistics.photons_stored;
  kept.rays = statistics.eye_rays + statistics.photon_rays;
  image::write(folder_ / kept.file, {picture.width, picture.height, picture.rgb}, {},
               render::picture_attributes(settings_, stage_.circumstances, statistics));
  record_.pictures.push_back(kept);
}

std::optional<RunRecord> Run::make() {
  const double start = clock_seconds();
  integrator_ =
      render::make_integrator(settings_, stage_.scene, stage_.device, log_, stage_.threads);
  record_.start_seconds = clock_seconds() - start;
  if (!timed([&] { return integrator_->prepare(stage_.interrupted); })) return std::nullopt;
  record_.prepare_seconds = clock_;
  while (!is_over()) {
    const std::uint64_t wanted = passes_until_due();
    const std::uint64_t made = stage_.interrupted() ? 0 : timed([&] {
      return integrator_->advance_up_to(wanted, stage_.interrupted);
    });
    if (made == 0) return std::nullopt;
    if (schedule_.after_passes) schedule_.after_passes(*integrator_);
    if (is_due()) keep();
  }
  if (record_.pictures.empty() || record_.last().passes != passes()) keep();

  const render::Statistics& statistics = integrator_->statistics();
  record_.hit_points = statistics.hit_points;
  record_.paths_cut = statistics.paths_cut;
  record_.initial_radius = statistics.initial_radius_median;
  record_.rejected = statistics.rejected;
  record_.warnings = log_.warnings();
  return std::move(record_);
}

}  // namespace

Options options_of(const Stage& stage, const Method& method) {
  Options options;
  for (const auto& [name, value] :
       render::picture_attributes(method.settings, stage.circumstances, {})) {
    constexpr std::string_view kPrefix = "ppm-vk:";
    if (is_of_one_rendering(name) || !name.starts_with(kPrefix)) continue;
    options[name.substr(kPrefix.size())] = text_of(value);
  }
  options["width"] = std::to_string(method.settings.width);
  options["height"] = std::to_string(method.settings.height);
  return options;
}

std::optional<RunRecord> timed_run(const Stage& stage, const Method& method, std::uint32_t seed,
                                   const Schedule& schedule, const std::filesystem::path& folder) {
  return Run(stage, method, seed, schedule, folder).make();
}

}  // namespace ppm::compare
