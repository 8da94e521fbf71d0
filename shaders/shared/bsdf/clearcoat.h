// Clearcoat (KHR_materials_clearcoat): a colourless coat of index 1.5 over everything else, smooth
// or of GGX facets.
//
// What lies under it gets what the coat lets through, in reciprocal forms that gain no energy:
// lobes that mirror or transmit are multiplied by the smaller of 1 - F(o) and 1 - F(i) (a mirror
// under a coat still reflects all), the diffuse one by their product, made to lose nothing as in
// diffuse.h. F is c times Schlick's with 0.04.
#ifndef PPM_SHARED_BSDF_CLEARCOAT_H
#define PPM_SHARED_BSDF_CLEARCOAT_H

#include "shared/bsdf/diffuse.h"
#include "shared/bsdf/ggx.h"

PPM_NAMESPACE_BEGIN

#define PPM_CLEARCOAT_F0 0.04f

struct Clearcoat {
  float strength;  // c, share of the surface that is coated; 0: no coat
  float alpha;     // 0: smooth
};

PPM_FN float clearcoat_transmittance(Clearcoat coat, float cosine) {
  return 1.0f -
         coat.strength * (PPM_CLEARCOAT_F0 + (1.0f - PPM_CLEARCOAT_F0) * schlick_weight(cosine));
}

// Of lobes that mirror or transmit; the cosines' signs do not matter.
PPM_FN float under_clearcoat(Clearcoat coat, float cos_o, float cos_i) {
  return clearcoat_transmittance(coat, min(abs(cos_o), abs(cos_i)));
}

// The part of the diffuse lobe's factor that does not depend on cos_i; times
// clearcoat_transmittance(coat, cos_i) it is the whole. The lobe's own coat lets T1 through, this
// one T2; the lobe is normalised by the cosine-weighted mean of T1, and both together by that of
// T1 T2. Means of (1-c)^5 and of its square: 1/21, 1/66.
PPM_FN float diffuse_under_clearcoat(DiffuseLobe lobe, Clearcoat coat, float cos_o) {
  float f1 = lobe.coat_f0;
  float d1 = lobe.coat_f90 - lobe.coat_f0;
  float f2 = coat.strength * PPM_CLEARCOAT_F0;
  float d2 = coat.strength - f2;
  float mean1 = 1.0f - f1 - d1 * (1.0f / 21.0f);
  float mean12 = (1.0f - f1) * (1.0f - f2) -
                 ((1.0f - f1) * d2 + (1.0f - f2) * d1) * (1.0f / 21.0f) + d1 * d2 * (1.0f / 66.0f);
  return clearcoat_transmittance(coat, cos_o) * mean1 / max(mean12, 1e-6f);
}

PPM_FN GgxLobe clearcoat_lobe(Clearcoat coat) {
  GgxLobe lobe;
  lobe.f0 = vec3(coat.strength * PPM_CLEARCOAT_F0);
  lobe.f90 = coat.strength;
  lobe.alpha = coat.alpha;
  return lobe;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_BSDF_CLEARCOAT_H
