#include "scene_traits.hpp"

#include <algorithm>

#include "shared/bindings.h"
#include "shared/bsdf.h"

namespace ppm::render {
namespace {

// Without regard to textures and to how opaque the material is: at most one lobe too many.
bool may_have_rough_gloss(const scene::Material& material) {
  return material.roughness >= PPM_DELTA_ROUGHNESS &&
         (material.metallic > 0.0f || material.specular > 0.0f);
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> SceneTraits::specialisation() const {
  return {{PPM_SPEC_ROUGH_GLOSS, rough_gloss},
          {PPM_SPEC_TEXTURES, textures},
          {PPM_SPEC_DETAILS, details},
          {PPM_SPEC_COVERAGE, coverage},
          {PPM_SPEC_LAYERS, layers},
          {PPM_SPEC_DISPERSION, dispersion},
          {PPM_SPEC_MEDIA, media},
          {PPM_SPEC_ENVIRONMENT, environment}};
}

SceneTraits traits_of(const scene::Scene& scene) {
  const auto any = [&](auto has) { return std::ranges::any_of(scene.materials, has); };
  SceneTraits traits;
  traits.bounds_min = scene.bounds_min;
  traits.bounds_max = scene.bounds_max;
  traits.rough_gloss = any(may_have_rough_gloss);
  traits.textures = !scene.textures.empty();
  traits.details = !scene.details.empty();
  traits.media = any([](const scene::Material& material) { return material.solid; });
  return traits;
}

}  // namespace ppm::render
