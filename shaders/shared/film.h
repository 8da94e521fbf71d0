// The film of methods whose samples land in any order: sums in fixed point of 96 bits, so that a
// picture is a function of the set of its samples.
//
// The unit is 2^-PPM_FILM_FRACTION_BITS of a power of two near the mean radiance of a scene that
// keeps its light to itself: what is 2^40 times darker vanishes, sums may be 2^55 times brighter
// (a pixel full of a small lamp, times the samples of a night). Single precision goes into a sum
// without loss unless it is near the unit, where it is rounded to nearest.
#ifndef PPM_SHARED_FILM_H
#define PPM_SHARED_FILM_H

#include "shared/geometry.h"

PPM_NAMESPACE_BEGIN

#define PPM_FILM_FRACTION_BITS 40

// What kernels know of the film.
struct FilmConstants {
  float scale;  // units in a radiance of 1, a power of two
  uint width, height;
  uint spare;
};

// One channel of a pixel: low + 2^32 high + 2^64 top units.
struct FilmSum {
  uint low, high, top;
};

// Terms of this many units or more, infinity among them, are taken for it and counted.
#define PPM_FILM_LIMIT 1.2379400392853803e27f  // 2^90

// value: radiance times FilmConstants::scale, in units; not a NaN. Negative ones are taken for 0.
PPM_FN FilmSum to_film_sum(float value) {
  value = min(max(value, 0.0f), PPM_FILM_LIMIT);
  FilmSum sum;
  sum.low = value < 8388608.0f ? uint(roundEven(value)) : 0u;
  sum.high = 0u;
  sum.top = 0u;
  if (value < 8388608.0f) return sum;
  // From 2^23 on a float is a whole number: 24 bits that begin at this one.
  uint bits = floatBitsToUint(value);
  uint shift = (bits >> 23u) - 150u;
  uint mantissa = (bits & 0x007fffffu) | 0x00800000u;
  uint within = shift & 31u;
  uint lower = mantissa << within;
  uint upper = within == 0u ? 0u : mantissa >> (32u - within);
  if (shift < 32u) {
    sum.low = lower;
    sum.high = upper;
  } else if (shift < 64u) {
    sum.high = lower;
    sum.top = upper;
  } else {
    sum.top = lower;
  }
  return sum;
}

// FilmConstants::scale of a scene: total power over pi and the surface of its bounding sphere is
// the reference. Both in working units, as SceneConstants has them.
PPM_FN float film_scale(float total_power, float bounding_radius) {
  float area = 4.0f * PPM_PI * PPM_PI * bounding_radius * bounding_radius;
  float reference = total_power > 0.0f && area > 0.0f ? total_power / area : 1.0f;
  uint exponent = floatBitsToUint(clamp(reference, 1e-24f, 1e24f)) >> 23u;  // 127 for [1, 2)
  return uintBitsToFloat((254u + uint(PPM_FILM_FRACTION_BITS) - exponent) << 23u);
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_FILM_H
