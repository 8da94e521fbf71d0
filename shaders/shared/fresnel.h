// Reflectance of smooth interfaces.
#ifndef PPM_SHARED_FRESNEL_H
#define PPM_SHARED_FRESNEL_H

#include "shared/geometry.h"

PPM_NAMESPACE_BEGIN

// Exact, unpolarised, for light that meets an interface at this cosine (>= 0). eta is the index of
// refraction on the far side over the one on the near side. cos_transmitted is 0 at total internal
// reflection, where F = 1.
PPM_FN float fresnel_dielectric(float cosine, float eta, PPM_OUT(float) cos_transmitted) {
  float sin2_transmitted = (1.0f - cosine * cosine) / (eta * eta);
  if (sin2_transmitted >= 1.0f) {
    cos_transmitted = 0.0f;
    return 1.0f;
  }
  cos_transmitted = sqrt(1.0f - sin2_transmitted);
  float parallel = (eta * cosine - cos_transmitted) / (eta * cosine + cos_transmitted);
  float perpendicular = (cosine - eta * cos_transmitted) / (cosine + eta * cos_transmitted);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// A thin sheet of glass without bending: all orders of reflection between its two faces summed,
// 2R/(1+R) of one face's R. What is not reflected is transmitted: (1-R)/(1+R).
PPM_FN float thin_sheet_reflectance(float interface_reflectance) {
  return 2.0f * interface_reflectance / (1.0f + interface_reflectance);
}

// (1 - cosine)^5, Schlick's approximation: F = f0 + (f90 - f0) * weight.
PPM_FN float schlick_weight(float cosine) {
  float x = clamp(1.0f - cosine, 0.0f, 1.0f);
  float x2 = x * x;
  return x2 * x2 * x;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_FRESNEL_H
