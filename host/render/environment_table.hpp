// The environment as the kernels read it: packed radiance, each texel drawn in proportion to the
// light that comes from under its tent (shared/environment.h).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene.hpp"
#include "shared/environment.h"

namespace ppm::render {

struct EnvironmentTable {
  shared::EnvironmentShape shape{};
  std::vector<glm::uvec4> texels;  ///< radiance in words 0 and 1, alias bin in 2 and 3; row-major
  glm::dvec3 irradiance{0.0};      ///< radiance integrated over the whole sphere, W/m^2 by channel
};

/// Empty for an environment that gives off nothing.
EnvironmentTable make_environment_table(const scene::Environment& environment);

}  // namespace ppm::render
