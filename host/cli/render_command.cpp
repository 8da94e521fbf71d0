#include "render_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <numbers>

#include "driver.hpp"
#include "failure.hpp"
#include "load_gltf.hpp"
#include "scene_settings.hpp"

namespace ppm::cli {
namespace {

constexpr int kInterrupted = 130;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

render::Circumstances circumstances_for(const scene::Scene& scene, const scene::LoadOptions& load,
                                        const gpu::Device& device) {
  render::Circumstances circumstances;
  circumstances.program = "ppm-vk " PPM_VERSION;
  circumstances.device = device.description().name;
  circumstances.driver = device.description().driver;
  circumstances.scene = scene.file;
  circumstances.frame = scene.frame;
  circumstances.load_attributes = {{"ppm-vk:luminous_efficacy", load.luminous_efficacy}};
  if (scene.environment) {
    const scene::Environment& environment = *scene.environment;
    circumstances.load_attributes.insert(
        circumstances.load_attributes.end(),
        {{"ppm-vk:environment", std::filesystem::path(environment.name).filename().string()},
         {"ppm-vk:environment_rotation", environment.rotation * 180.0 / std::numbers::pi},
         {"ppm-vk:environment_strength", static_cast<double>(environment.strength)}});
  }
  circumstances.device_memory_bytes = [&device] { return device.peak_bytes(); };
  return circumstances;
}

int exit_code(render::Outcome outcome, const gpu::Device& device) {
  if (const std::uint64_t messages = device.validation_messages(); messages > 0) {
    throw Failure(device.description().name, "--validate",
                  fmt::format("{} validation messages", messages), "see the lines above");
  }
  return outcome == render::Outcome::interrupted ? kInterrupted : 0;
}

}  // namespace

int render_command(const RenderOptions& options) {
  const Clock::time_point start = Clock::now();
  const render::Interruption interruption;
  Log log(options.verbosity);
  const render::Outputs outputs{options.outputs, options.exposure, options.stats};
  render::check_outputs(outputs);

  const MemoryLimits limits = memory_limits_for(options);
  scene::Scene scene = scene::load_gltf(options.scene, log, load_options_for(options, limits));
  const double load_seconds = seconds_since(start);
  if (interruption.requested()) {
    log.warn("interrupted while the scene was read; nothing is written");
    return kInterrupted;
  }
  const render::Settings settings = settings_for(options, scene, log);
  log.note(fmt::format("{}: {} triangles, {} materials, {:.2f} s", scene.file,
                       scene.triangles.size(), scene.materials.size(), load_seconds));

  gpu::Device device(options.device);
  log.note(fmt::format("device {}: {}, {}", device.description().index, device.description().name,
                       device.description().driver));
  check_memory_for(scene, settings, limits, &device);
  const std::unique_ptr<render::Integrator> integrator =
      render::make_integrator(settings, scene, device, log, thread_count(options.threads));
  scene::release_arrays(scene);

  render::Circumstances circumstances = circumstances_for(scene, options.load, device);
  circumstances.load_seconds = load_seconds;
  circumstances.seconds_before = seconds_since(start);
  render::Budget budget{options.passes, options.seconds};
  if (!options.seconds) budget.passes = options.passes_or_usual();
  const render::Outcome outcome =
      render::drive(*integrator, settings, budget, outputs, circumstances, interruption, log);
  return exit_code(outcome, device);
}

}  // namespace ppm::cli
