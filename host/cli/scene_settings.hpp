// From options and a scene to what an integrator wants to know.
#pragma once

#include "log.hpp"
#include "options.hpp"
#include "scene.hpp"

namespace ppm::cli {

/// The settings that the options ask for in this scene, with its camera and size. Throws Failure
/// for what does not fit the scene.
render::Settings settings_for(const RenderOptions& options, const scene::Scene& scene, Log& log);

/// As asked for, or one for each core.
unsigned thread_count(unsigned asked_for);

}  // namespace ppm::cli
