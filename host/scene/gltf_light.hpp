// KHR_lights_punctual to the scene's punctual lights.
#pragma once

#include "gltf_nodes.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// The light that hangs on a node, if one does and it shines at all. Candela and lux are
/// divided by `luminous_efficacy` (lm/W) to W/sr and W/m^2.
std::optional<PunctualLight> read_light(const Placement& placement, const Frame& frame,
                                        double luminous_efficacy);

}  // namespace ppm::scene::gltf
