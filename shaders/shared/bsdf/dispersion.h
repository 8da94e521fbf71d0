// Dispersion in three channels: red light bends least, blue most.
//
// A path that meets a dispersive interface goes on in one channel; it is then told by its weight
// alone, whose other channels are 0. The indices are those of KHR_materials_dispersion's own
// example: with n at green (587.6 nm) and n_F - n_C = (n - 1) / V, V = 20 / dispersion being Abbe's
// number, red has n - (n_F - n_C) / 2 and blue n + (n_F - n_C) / 2.
#ifndef PPM_SHARED_BSDF_DISPERSION_H
#define PPM_SHARED_BSDF_DISPERSION_H

#include "shared/geometry.h"

PPM_NAMESPACE_BEGIN

#define PPM_ALL_CHANNELS 3u  // of a path that carries several

// Which channel alone is left of a path's weight or flux, 0 to 2; else PPM_ALL_CHANNELS.
PPM_FN uint channel_of(vec3 weight) {
  uint left =
      (weight.x > 0.0f ? 1u : 0u) | (weight.y > 0.0f ? 2u : 0u) | (weight.z > 0.0f ? 4u : 0u);
  if (left == 1u) return 0u;
  if (left == 2u) return 1u;
  if (left == 4u) return 2u;
  return PPM_ALL_CHANNELS;
}

// The weight, but only one channel of it.
PPM_FN vec3 in_channel(vec3 weight, uint channel) {
  return vec3(channel == 0u ? weight.x : 0.0f, channel == 1u ? weight.y : 0.0f,
              channel == 2u ? weight.z : 0.0f);
}

// Index of refraction for a channel; PPM_ALL_CHANNELS sees what green does. `dispersion` as in
// KHR_materials_dispersion, 20 / Abbe's number. Not below 1, however strong the dispersion.
PPM_FN float dispersed_ior(float ior, float dispersion, uint channel) {
  float half_spread = (ior - 1.0f) * 0.025f * dispersion;
  float shift = channel == 0u ? -half_spread : channel == 2u ? half_spread : 0.0f;
  return max(ior + shift, 1.0f);
}

// One channel in proportion to the flux it carries: what becomes of it, undone of its probability.
PPM_FN vec3 drawn_channel(vec3 flux, float u) {
  float sum = flux.x + flux.y + flux.z;
  float chosen = u * sum;
  if (chosen < flux.x) return vec3(sum, 0.0f, 0.0f);
  if (chosen < flux.x + flux.y || flux.z <= 0.0f) {
    return flux.y > 0.0f ? vec3(0.0f, sum, 0.0f) : vec3(sum, 0.0f, 0.0f);
  }
  return vec3(0.0f, 0.0f, sum);
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_BSDF_DISPERSION_H
