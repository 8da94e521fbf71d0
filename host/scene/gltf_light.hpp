// KHR_lights_punctual to the scene's punctual lights.
#pragma once

#include "gltf_nodes.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// The light that hangs on a node, if one does and it shines at all. Candela is taken as W/sr, lux
/// as W/m^2.
std::optional<PunctualLight> read_light(const Placement& placement, const Frame& frame);

}  // namespace ppm::scene::gltf
