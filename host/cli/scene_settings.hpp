// From options and a scene to what an integrator wants to know.
#pragma once

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

/// Throws Failure where the scene, of which all is known now, does not fit the limits with these
/// settings and layers, on this device if there is one.
void check_memory_for(const scene::Scene& scene, const render::Settings& settings,
                      MemoryLimits limits, const gpu::Device* device,
                      std::span<const render::LayerKind> layers = {});

/// As asked for, or one for each core.
unsigned thread_count(unsigned asked_for);

}  // namespace ppm::cli
