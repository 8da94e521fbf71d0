#include "scene_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <tuple>

#include "camera_choice.hpp"
#include "failure.hpp"
#include "machine_memory.hpp"
#include "memory_shortage.hpp"
#include "scene_traits.hpp"

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

/// Of the device, of the scene if it is there, and of what is to be written.
render::MemoryDemand demand_of(const RenderOptions& options, const scene::SceneSize& size,
                               const scene::Scene* scene, const gpu::Device* device) {
  render::MemoryDemand demand{
      size, device ? render::PassLimits::of(*device) : render::PassLimits::of_cpu(), options.layers,
      !options.run.checkpoint.empty()};
  if (scene) demand.limits.layered_hits = render::traits_of(*scene).layers;
  return demand;
}

constexpr unsigned kMostTries = 5;

/// Such as take three quarters of what these do on the device; nothing where that cannot be.
std::optional<render::Settings> settings_with_less(const scene::Scene& scene,
                                                   const render::Settings& settings,
                                                   const RenderOptions& options,
                                                   MemoryLimits limits, const gpu::Device& device) {
  const render::MemoryDemand demand =
      demand_of(options, scene::SceneSize::of(scene), &scene, &device);
  limits.machine = limits.budget.value_or(limits.machine);
  limits.budget.reset();
  limits.device = demand.plan(settings).device_peak() / 4 * 3;
  render::MemoryFit fit = render::fit_memory(demand, settings, limits);
  if (!fit.fits) return std::nullopt;
  return fit.settings;
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
    fit_or_refuse(options.scene.string(), demand_of(options, size, scene, nullptr), settings,
                  limits, scene != nullptr ? Known::all : Known::a_part);
  };
  return load;
}

render::Settings fitting_settings(const scene::Scene& scene, const render::Settings& settings,
                                  const RenderOptions& options, MemoryLimits limits,
                                  const gpu::Device* device, const Log& log) {
  if (device && !device->shares_host_memory()) limits.device = device->free_bytes();
  const render::MemoryDemand demand =
      demand_of(options, scene::SceneSize::of(scene), &scene, device);
  const render::MemoryFit fit = fit_or_refuse(scene.file, demand, settings, limits, Known::all);
  const std::string change = render::describe_change(demand, settings, fit.settings);
  if (!change.empty()) {
    const std::uint64_t most =
        std::min(limits.budget.value_or(limits.machine), limits.device.value_or(UINT64_MAX));
    log.tell(fmt::format("{}, so that it fits {}", change, render::size_text(most)));
  }
  log.note(fmt::format("memory: up to {}, of which {} on the device ({})",
                       render::size_text(fit.plan.peak()),
                       render::size_text(fit.plan.device_peak()), render::describe_peak(fit.plan)));
  return fit.settings;
}

std::unique_ptr<render::Integrator> make_fitting_integrator(render::Settings& settings,
                                                            const scene::Scene& scene,
                                                            const RenderOptions& options,
                                                            const MemoryLimits& limits,
                                                            gpu::Device& device, Log& log) {
  const unsigned threads = thread_count(options.threads);
  for (unsigned tries = 1;; ++tries) {
    try {
      return render::make_integrator(settings, scene, device, log, threads);
    } catch (const gpu::MemoryShortage& shortage) {
      if (tries == kMostTries) throw;
      const std::optional<render::Settings> less =
          settings_with_less(scene, settings, options, limits, device);
      if (!less) throw;
      settings = *less;
      log.warn(std::string(shortage.what()) + "; the rendering goes on with less at a time");
    }
  }
}

unsigned thread_count(unsigned asked_for) {
  return asked_for > 0 ? asked_for : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace ppm::cli
