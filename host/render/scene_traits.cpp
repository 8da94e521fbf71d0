#include "scene_traits.hpp"

#include <algorithm>

#include "shared/bsdf.h"

namespace ppm::render {
namespace {

// Without regard to textures and to how opaque the material is: at most one lobe too many.
bool may_have_rough_gloss(const scene::Material& material) {
  return material.roughness >= PPM_DELTA_ROUGHNESS &&
         (material.metallic > 0.0f || material.specular > 0.0f);
}

}  // namespace

SceneTraits traits_of(const scene::Scene& scene) {
  return {scene.bounds_min, scene.bounds_max,
          std::ranges::any_of(scene.materials, may_have_rough_gloss)};
}

}  // namespace ppm::render
