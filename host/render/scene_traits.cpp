#include "scene_traits.hpp"

#include <algorithm>

#include "emission_mean.hpp"
#include "media.hpp"
#include "shared/bindings.h"
#include "shared/bsdf.h"

namespace ppm::render {
namespace {

// Without regard to textures and to how opaque the material is: at most one lobe too many.
bool may_have_rough_gloss(const scene::Material& material) {
  return material.roughness >= PPM_DELTA_ROUGHNESS &&
         (material.metallic > 0.0f || material.specular > 0.0f);
}

bool may_have_glass(const scene::Material& material) {
  return material.transmission > 0.0f && material.metallic < 1.0f;
}

bool may_have_layers(const scene::Material& material) {
  const bool rough = material.roughness >= PPM_DELTA_ROUGHNESS;
  return (may_have_glass(material) && rough) || material.clearcoat > 0.0f;
}

bool may_disperse(const scene::Material& material) {
  return may_have_glass(material) && material.solid && material.dispersion > 0.0f;
}

bool gives_off_light(const std::optional<scene::Environment>& environment) {
  return environment && environment->strength > 0.0f &&
         std::ranges::any_of(environment->texels,
                             [](const glm::vec3& texel) { return texel != glm::vec3(0.0f); });
}

}  // namespace

SceneTraits::Constants SceneTraits::specialisation(Constants own) const {
  const Constants of_scene = {
      {PPM_SPEC_SEGMENT_SHIFT, segment_shift}, {PPM_SPEC_ROUGH_GLOSS, rough_gloss},
      {PPM_SPEC_TEXTURES, textures},           {PPM_SPEC_DETAILS, details},
      {PPM_SPEC_COVERAGE, coverage},           {PPM_SPEC_LAYERS, layers},
      {PPM_SPEC_DISPERSION, dispersion},       {PPM_SPEC_MEDIA, media},
      {PPM_SPEC_ENVIRONMENT, environment},     {PPM_SPEC_TEXTURED_LIGHTS, textured_lights}};
  own.insert(own.end(), of_scene.begin(), of_scene.end());
  for (const auto& [binding, count] : segments) {
    own.emplace_back(PPM_SPEC_SEGMENTS + binding, count);
  }
  return own;
}

bool SceneTraits::is_plain() const {
  return segments.empty() && !textures && !details && !coverage && !layers && !dispersion &&
         !environment && !textured_lights;
}

gpu::Kernel make_kernel(gpu::Device& device, const SceneTraits& traits, const gpu::Shader& any,
                        const gpu::Shader& plain, SceneTraits::Constants own) {
  return {device, traits.is_plain() ? plain : any, traits.specialisation(std::move(own))};
}

SceneTraits traits_of(const scene::Scene& scene) {
  const auto any = [&](auto has) { return std::ranges::any_of(scene.materials, has); };
  SceneTraits traits;
  traits.bounds_min = scene.bounds_min;
  traits.bounds_max = scene.bounds_max;
  traits.rough_gloss = any(may_have_rough_gloss);
  traits.textures = !scene.textures.empty();
  traits.details = !scene.details.empty();
  traits.layers = any(may_have_layers);
  traits.dispersion = any(may_disperse);
  traits.coverage = any([](const scene::Material& material) {
    return material.alpha_mode != scene::AlphaMode::opaque;
  });
  traits.textured_lights = any(has_textured_emission);
  traits.media = any(scene::has_inside);
  traits.environment = gives_off_light(scene.environment);
  return traits;
}

}  // namespace ppm::render
