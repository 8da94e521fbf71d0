// From options and a scene to what an integrator wants to know.
#pragma once

#include <memory>

#include "device.hpp"
#include "integrator.hpp"
#include "log.hpp"
#include "memory_budget.hpp"
#include "options.hpp"
#include "scene.hpp"

namespace ppm::cli {

/// The settings that the options ask for in this scene, with its camera and size. Throws Failure
/// for what does not fit the scene.
render::Settings settings_for(const RenderOptions& options, const scene::Scene& scene, Log& log);

/// What a rendering may take, as the options say or else the machine now.
MemoryLimits memory_limits_for(const RenderOptions& options);

/// What of the file is read, and no more than the limits allow.
scene::LoadOptions load_options_for(const RenderOptions& options, const MemoryLimits& limits);

/// The settings with which the scene, of which all is known now, fits the limits and this device,
/// if there is one; tells what had to change. Throws Failure where there are none. Layers and the
/// checkpoint are the options'.
render::Settings fitting_settings(const scene::Scene& scene, const render::Settings& settings,
                                  const RenderOptions& options, MemoryLimits limits,
                                  const gpu::Device* device, const Log& log);

/// An integrator with these settings. Others may have taken what the device had left: then with
/// such as take less and less of it, which a warning tells and `settings` are afterwards.
std::unique_ptr<render::Integrator> make_fitting_integrator(render::Settings& settings,
                                                            const scene::Scene& scene,
                                                            const RenderOptions& options,
                                                            const MemoryLimits& limits,
                                                            gpu::Device& device, Log& log);

/// As asked for, or one for each core.
unsigned thread_count(unsigned asked_for);

}  // namespace ppm::cli
