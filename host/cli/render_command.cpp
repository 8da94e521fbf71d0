#include "render_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "circumstances.hpp"
#include "driver.hpp"
#include "load_gltf.hpp"
#include "scene_settings.hpp"

namespace ppm::cli {
namespace {

constexpr int kInterrupted = 130;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int exit_code(render::Outcome outcome, const gpu::Device& device) {
  check_validation(device);
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
  const bool bounded = options.seconds || render::method_named(settings.integrator).ends_itself;
  if (!bounded) budget.passes = options.passes_or_usual();
  const render::Outcome outcome =
      render::drive(*integrator, settings, budget, outputs, circumstances, interruption, log);
  return exit_code(outcome, device);
}

}  // namespace ppm::cli
