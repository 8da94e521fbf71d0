// Which camera looks at the scene, and how many pixels it fills.
#pragma once

#include <cstdint>
#include <utility>

#include "log.hpp"
#include "options.hpp"
#include "scene.hpp"

namespace ppm::cli {

/// The camera that the options ask for, in the working frame: one of the file's by name or index,
/// one that frames the scene (with a warning) where the file has none, with what --camera-position
/// and its kin replace. Throws Failure on a name or index that is not there, and on vectors that
/// give no direction.
scene::Camera choose_camera(const RenderOptions& options, const scene::Scene& scene, Log& log);

/// Width and height in pixels. What the options leave open follows from the camera's aspect (4:3
/// where it has none), starting from `default_width`. Throws Failure where that is out of range.
std::pair<std::uint32_t, std::uint32_t> choose_resolution(const RenderOptions& options,
                                                          const scene::Camera& camera,
                                                          std::uint32_t default_width);

}  // namespace ppm::cli
