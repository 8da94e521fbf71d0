#include "render_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "budget.hpp"
#include "circumstances.hpp"
#include "driver.hpp"
#include "exit_code.hpp"
#include "failure.hpp"
#include "fingerprint.hpp"
#include "load_gltf.hpp"
#include "scene_settings.hpp"

namespace ppm::cli {
namespace {

constexpr const char* kProgram = "ppm-vk " PPM_VERSION;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int exit_code(render::Outcome outcome, const gpu::Device& device) {
  check_validation(device);
  return outcome == render::Outcome::interrupted ? kInterrupted : kDone;
}

render::Outputs outputs_for(const RenderOptions& options) {
  render::Outputs outputs;
  outputs.pictures = options.outputs;
  outputs.encoding = options.encoding;
  outputs.layers = options.layers;
  outputs.display = options.display;
  outputs.statistics = options.stats;
  outputs.keeping = {options.run.checkpoint, options.run.checkpoint_seconds, options.run.words, {}};
  outputs.preview = options.run.preview;
  outputs.preview_seconds = options.run.preview_seconds;
  outputs.fallback = options.run.fallback;
  outputs.progress =
      options.run.progress_json ? render::ProgressStyle::json : render::ProgressStyle::text;
  return outputs;
}

/// Of all that a checkpoint must find again.
std::vector<render::PartHash> parts_of(const scene::Scene& scene,
                                       const render::Settings& settings) {
  std::vector<render::PartHash> parts = render::part_hashes(scene);
  render::Hash camera;
  render::add_camera(camera, settings.camera);
  camera.add(settings.width);
  camera.add(settings.height);
  parts.push_back({"camera", camera.value()});
  return parts;
}

int render_scene(const RenderOptions& options, render::Checkpoint* resumed) {
  const Clock::time_point start = Clock::now();
  const render::Interruption interruption;
  Log log(options.verbosity);
  render::Outputs outputs = outputs_for(options);
  render::check_outputs(outputs);

  const MemoryLimits limits = memory_limits_for(options);
  scene::Scene scene = scene::load_gltf(options.scene, log, load_options_for(options, limits));
  const double load_seconds = seconds_since(start);
  if (interruption.requested()) {
    log.warn("interrupted while the scene was read; nothing is written");
    return kInterrupted;
  }
  render::Settings settings = settings_for(options, scene, log);
  log.note(fmt::format("{}: {} triangles, {} materials, {:.2f} s", scene.file,
                       scene.triangles.size(), scene.materials.size(), load_seconds));
  if (!outputs.keeping.file.empty()) outputs.keeping.parts = parts_of(scene, settings);
  if (resumed) {
    render::check_continues(outputs.keeping.file, *resumed, kProgram, outputs.keeping.parts);
  }

  gpu::Device device(options.device);
  log.note(fmt::format("device {}: {}, {}", device.description().index, device.description().name,
                       device.description().driver));
  if (resumed) {
    render::check_device(outputs.keeping.file, *resumed, device.description().name,
                         device.description().driver);
  }
  settings = fitting_settings(scene, settings, options, limits, &device, log);
  const std::unique_ptr<render::Integrator> integrator =
      make_fitting_integrator(settings, scene, options, limits, device, log);
  scene::release_arrays(scene);

  render::Circumstances circumstances = circumstances_for(scene, options.load, device);
  circumstances.load_seconds = load_seconds;
  circumstances.seconds_before = seconds_since(start);
  const render::Outcome outcome = render::drive(*integrator, settings, budget_for(options), outputs,
                                                circumstances, interruption, log, resumed);
  return exit_code(outcome, device);
}

/// A checkpoint is hours of somebody's time, and another file is somebody's as well.
void check_not_there(const std::filesystem::path& checkpoint) {
  std::error_code ignored;
  if (checkpoint.empty() || !std::filesystem::exists(checkpoint, ignored)) return;
  throw Failure(checkpoint.string(), "--checkpoint", "is there already",
                fmt::format("go on with ppm-vk resume {}, or remove it", checkpoint.string()));
}

}  // namespace

int render_command(const RenderOptions& options) {
  check_not_there(options.run.checkpoint);
  return render_scene(options, nullptr);
}

int render_from(const RenderOptions& options, render::Checkpoint checkpoint) {
  return render_scene(options, &checkpoint);
}

}  // namespace ppm::cli
