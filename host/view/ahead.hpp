// How far away what a camera looks at is.
#pragma once

#include <optional>

#include "scene.hpp"

namespace ppm::view {

/// Distance of the surface in the middle of the picture, working units: the median of what a few
/// rays about it find, whatever it is made of; nothing where most find none. Asks every triangle.
std::optional<double> distance_ahead(const scene::Scene& scene, const scene::Camera& camera);

}  // namespace ppm::view
