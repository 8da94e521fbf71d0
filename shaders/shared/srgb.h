// sRGB codes to linear light.
#ifndef PPM_SHARED_SRGB_H
#define PPM_SHARED_SRGB_H

#include "shared/lang.h"

PPM_NAMESPACE_BEGIN

// IEC 61966-2-1 for a code in [0, 1], but for 1e-6 of the value: t^2.4 is t^2 times q^1.6 with q
// the fourth root of t, and q^1.6 is smooth where codes lie, so that a polynomial of the fifth
// degree does it. Two roots and eight products instead of a logarithm and an exponential, of which
// Vulkan grants but a few digits.
PPM_FN float srgb_to_linear(float code) {
  float t = (code + 0.055f) * 0.947867298578199f;
  float q = sqrt(sqrt(t));
  float p = 0.14706391f - 0.0269078035f * q;
  p = -0.385698318f + p * q;
  p = 1.02351069f + p * q;
  p = 0.256346017f + p * q;
  p = -0.0143143f + p * q;
  return code <= 0.04045f ? code * 0.0773993808f : t * t * p;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_SRGB_H
