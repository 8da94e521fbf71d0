// What searches and kernels are told of a scene beforehand.
#pragma once

#include "scene.hpp"

namespace ppm::render {

struct SceneTraits {
  glm::vec3 bounds_min{-1.0f}, bounds_max{1.0f};  ///< of all triangles, working frame
  bool rough_gloss = true;  ///< whether some material may have a rough glossy lobe
};

SceneTraits traits_of(const scene::Scene& scene);

}  // namespace ppm::render
