// Which materials cover less than all.
#pragma once

#include "scene.hpp"

namespace ppm::scene {

/// Makes opaque the materials whose alphaMode has no effect: with no texel, no vertex and no factor
/// below what it takes. Exporters write BLEND and MASK without need, and rays pay for them.
void settle_alpha_modes(Scene& scene);

}  // namespace ppm::scene
