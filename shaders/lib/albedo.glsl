// A surface's colour, for layers beside the picture.
#ifndef PPM_LIB_ALBEDO_GLSL
#define PPM_LIB_ALBEDO_GLSL

#include "lib/scene_kinds.glsl"

#include "shared/bsdf.h"

// What the non-specular lobes send back of light at normal incidence, or let through where they are rough glass:
// the base colour for the most part. In [0,1].
vec3 albedo_of(Bsdf bsdf) {
  vec3 albedo = bsdf.diffuse.albedo * coat_transmittance(bsdf.diffuse, 1.0);
  if (has_rough_gloss(bsdf)) albedo += bsdf.glossy.f0;
  if (has_rough_glass(bsdf)) {
    float reflectance = facet_reflectance(rough_glass(bsdf), 1.0);
    albedo += bsdf.glass * mix(bsdf.glass_tint, vec3(1.0), reflectance);
  }
  if (has_clearcoat(bsdf)) {
    float passes = clearcoat_transmittance(bsdf.coat, 1.0);
    albedo = albedo * passes + (has_rough_clearcoat(bsdf) ? 1.0 - passes : 0.0);
  }
  return clamp(albedo, vec3(0.0), vec3(1.0));
}

#endif
