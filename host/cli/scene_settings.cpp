#include "scene_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <tuple>

#include "camera_choice.hpp"
#include "failure.hpp"
#include "machine_memory.hpp"

namespace ppm::cli {
namespace {

/// Radii, in units of half the scene's size, that single precision can square and that can matter.
constexpr double kSmallestRadius = 1e-9, kLargestRadius = 1e3;

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

void add_layers(render::MemoryPlan& plan, const render::Settings& settings,
                std::span<const render::LayerKind> layers) {
  for (render::MemoryPart& part : render::layers_memory(settings, layers)) {
    plan.parts.push_back(std::move(part));
  }
}

}  // namespace

render::Settings settings_for(const RenderOptions& options, const scene::Scene& scene, Log& log) {
  render::Settings settings = options.settings;
  settings.camera = choose_camera(options, scene, log);
  std::tie(settings.width, settings.height) =
      choose_resolution(options, settings.camera, options.settings.width);
  check_radius(settings, scene);
  return settings;
}

MemoryLimits memory_limits_for(const RenderOptions& options) {
  return {options.memory_budget, available_memory(), std::nullopt};
}

scene::LoadOptions load_options_for(const RenderOptions& options, const MemoryLimits& limits) {
  scene::LoadOptions load = options.load;
  load.admit = [options, limits](const scene::SceneSize& size, const scene::Scene* scene) {
    render::Settings settings = options.settings;
    if (scene != nullptr) {
      Log silence(Verbosity::quiet);  // what there is to say of the camera is said later
      settings = settings_for(options, *scene, silence);
    } else {  // as small as it can be
      settings.width = options.width.value_or(1);
      settings.height = options.height.value_or(1);
    }
    render::MemoryPlan plan = render::memory_plan(size, settings, render::PassLimits::of_cpu());
    add_layers(plan, settings, options.layers);
    plan.is_complete = scene != nullptr;
    if (!options.run.checkpoint.empty()) {
      plan.parts.push_back(render::checkpoint_memory(settings, render::PassLimits::of_cpu()));
    }
    check_memory(options.scene.string(), plan, limits);
  };
  return load;
}

void check_memory_for(const scene::Scene& scene, const render::Settings& settings,
                      MemoryLimits limits, const gpu::Device* device,
                      std::span<const render::LayerKind> layers) {
  if (device && !device->shares_host_memory()) limits.device = device->free_bytes();
  const render::PassLimits passes =
      device ? render::PassLimits::of(*device) : render::PassLimits::of_cpu();
  render::MemoryPlan plan = render::memory_plan(scene::SceneSize::of(scene), settings, passes);
  add_layers(plan, settings, layers);
  check_memory(scene.file, plan, limits);
}

unsigned thread_count(unsigned asked_for) {
  return asked_for > 0 ? asked_for : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace ppm::cli
