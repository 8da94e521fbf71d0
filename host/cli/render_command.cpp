#include "render_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "camera_choice.hpp"
#include "driver.hpp"
#include "failure.hpp"
#include "load_gltf.hpp"

namespace ppm::cli {
namespace {

constexpr int kInterrupted = 130;

/// Radii, in units of half the scene's size, that single precision can square and that can matter.
constexpr double kSmallestRadius = 1e-9, kLargestRadius = 1e3;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void check_radius(const render::Settings& settings, const scene::Scene& scene) {
  if (settings.radius_mode != render::RadiusMode::fixed) return;
  const double working = settings.radius * scene.frame.scale;
  if (working >= kSmallestRadius && working <= kLargestRadius) return;
  throw Failure(
      scene.file, "--radius",
      fmt::format("{} is out of all proportion to the scene", settings.radius),
      fmt::format("choose one between {:.3g} and {:.3g}, or auto",
                  kSmallestRadius / scene.frame.scale, kLargestRadius / scene.frame.scale));
}

render::Settings settings_for(const RenderOptions& options, const scene::Scene& scene, Log& log) {
  render::Settings settings = options.settings;
  settings.camera = choose_camera(options, scene, log);
  std::tie(settings.width, settings.height) =
      choose_resolution(options, settings.camera, options.settings.width);
  check_radius(settings, scene);
  return settings;
}

render::Circumstances circumstances_for(const scene::Scene& scene, const gpu::Device& device) {
  render::Circumstances circumstances;
  circumstances.program = "ppm-vk " PPM_VERSION;
  circumstances.device = device.description().name;
  circumstances.driver = device.description().driver;
  circumstances.scene = scene.file;
  circumstances.frame = scene.frame;
  circumstances.device_memory_bytes = [&device] { return device.peak_bytes(); };
  return circumstances;
}

unsigned thread_count(unsigned asked_for) {
  return asked_for > 0 ? asked_for : std::max(1u, std::thread::hardware_concurrency());
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

  const scene::Scene scene = scene::load_gltf(options.scene, log);
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
  const std::unique_ptr<render::Integrator> integrator =
      render::make_integrator(settings, scene, device, log, thread_count(options.threads));

  render::Circumstances circumstances = circumstances_for(scene, device);
  circumstances.load_seconds = load_seconds;
  circumstances.seconds_before = seconds_since(start);
  const render::Outcome outcome = render::drive(*integrator, settings, {options.passes}, outputs,
                                                circumstances, interruption, log);
  return exit_code(outcome, device);
}

}  // namespace ppm::cli
