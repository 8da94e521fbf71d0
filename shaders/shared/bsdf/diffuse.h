// The diffuse lobe: Lambert, under a coat where the material has a dielectric specular part.
//
// Light that the coat reflects does not reach the base: f = albedo / pi * (1 - F(o)) (1 - F(i)) /
// (1 - F_avg). This form is reciprocal, and with the smooth coat's F it loses no energy for albedo
// 1 (Kelemen and Szirmay-Kalos: A Microfacet Based Coupled Specular-Matte BRDF Model, 2001).
// Without a coat (f0 = f90 = 0) it is Lambert's albedo / pi.
#ifndef PPM_SHARED_BSDF_DIFFUSE_H
#define PPM_SHARED_BSDF_DIFFUSE_H

#include "shared/fresnel.h"
#include "shared/warp.h"

PPM_NAMESPACE_BEGIN

struct DiffuseLobe {
  vec3 albedo;
  float coat_f0, coat_f90;
};

PPM_FN float coat_transmittance(DiffuseLobe lobe, float cosine) {
  return 1.0f - (lobe.coat_f0 + (lobe.coat_f90 - lobe.coat_f0) * schlick_weight(cosine));
}

// What of the lobe does not depend on cos_i.
PPM_FN vec3 diffuse_base(DiffuseLobe lobe, float cos_o) {
  // Cosine-weighted hemispherical mean of Schlick's F; the integral of (1-c)^5 c is 1/42.
  float average = lobe.coat_f0 + (lobe.coat_f90 - lobe.coat_f0) * (1.0f / 21.0f);
  return lobe.albedo *
         (PPM_INVERSE_PI * coat_transmittance(lobe, cos_o) / max(1.0f - average, 1e-6f));
}

// Both cosines positive. Per steradian; no cosine included.
PPM_FN vec3 diffuse_eval(DiffuseLobe lobe, float cos_o, float cos_i) {
  return diffuse_base(lobe, cos_o) * coat_transmittance(lobe, cos_i);
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_BSDF_DIFFUSE_H
