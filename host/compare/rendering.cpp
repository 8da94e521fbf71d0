#include "rendering.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "progress.hpp"

namespace ppm::compare {
namespace {

constexpr std::uint32_t kWarmSide = 16;
constexpr std::uint64_t kWarmPhotons = 1000;

void warm_up(Stage& stage, const Method& method) {
  if (stage.warm.contains(method.settings.integrator)) return;
  render::Settings settings = method.settings;
  settings.width = std::min(settings.width, kWarmSide);
  settings.height = std::min(settings.height, kWarmSide);
  settings.photons_per_pass = std::min(settings.photons_per_pass, kWarmPhotons);
  Log log(Verbosity::quiet);
  const auto integrator =
      render::make_integrator(settings, stage.scene, stage.device, log, stage.threads);
  if (!integrator->prepare(stage.interrupted)) return;
  for (int pass = 0; pass < 2 && !integrator->complete(); ++pass) {
    if (integrator->advance_up_to(1, stage.interrupted) == 0) return;
  }
  integrator->resolve();
  stage.warm.insert(method.settings.integrator);
}

}  // namespace

std::string run_name(const Method& method, std::uint32_t seed) {
  return fmt::format("{}-{}", directory_name(method.label), seed);
}

std::optional<RunRecord> rendering(
    Stage& stage, const ReportFolder& folder, const std::string& name, const Method& method,
    std::uint32_t seed, const Schedule& schedule,
    const std::function<void(const std::filesystem::path&)>& finish) {
  RunRecord wanted;
  wanted.options = options_of(stage, method);
  wanted.budget_seconds = schedule.seconds;
  if (auto record = folder.find(name, wanted)) return record;
  if (stage.interrupted()) return std::nullopt;
  const Method fitting{method.label, stage.admit(method.settings)};
  stage.tell(schedule.seconds > 0.0
                 ? fmt::format("{}: {}", name, render::clock_time(schedule.seconds))
                 : fmt::format("{}: {} passes", name, schedule.last_pass.value_or(0)));
  warm_up(stage, fitting);
  return folder.add(name, [&](const std::filesystem::path& part) -> std::optional<RunRecord> {
    auto record = timed_run(stage, fitting, seed, schedule, part);
    if (record && finish) finish(part);
    return record;
  });
}

}  // namespace ppm::compare
