// The progressive radiance estimate [HOJ08 section 4], one hit point, one pass.
//
// Two identities make it exact and cheap. Eqs. 9 and 12 scale R^2 and tau by the same ratio, so
// that lambda = tau / (pi R^2) only ever adds up: lambda += tau_M / (pi R^2), R being the radius
// that the pass searched. And from N = 0 Eq. 7 gives N = alpha * C, where C, the count of all
// photons accepted, is an integer. tau and N follow from (lambda, R^2, C) whenever they are wanted.
#ifndef PPM_SHARED_PPM_H
#define PPM_SHARED_PPM_H

#include "shared/geometry.h"
#include "shared/layout.h"

PPM_NAMESPACE_BEGIN

// (N + alpha M) / (N + M) with N = alpha C: the factor of R^2 in Eq. 9 and of tau in Eq. 12. M > 0.
PPM_FN float shrink_ratio(float alpha, uint count, uint new_photons) {
  float c = float(count);
  float m = float(new_photons);
  PPM_PRECISE float ratio = alpha * (c + m) / (alpha * c + m);
  return ratio;
}

// State of a hit point between passes.
struct Estimate {
  vec3 lambda;    // sum over passes of sum(f_r * photon flux) / (pi R^2)
  float radius2;  // R(x)^2, working units
  uint count;     // C
};

// One pass: new_photons is M, new_flux is tau_M of Eq. 11. Without photons nothing changes.
PPM_FN Estimate update_estimate(Estimate estimate, float alpha, uint new_photons, vec3 new_flux) {
  if (new_photons == 0u) return estimate;
  PPM_PRECISE float area = PPM_PI * estimate.radius2;
  PPM_PRECISE vec3 lambda = estimate.lambda + new_flux / area;
  PPM_PRECISE float radius2 = estimate.radius2 * shrink_ratio(alpha, estimate.count, new_photons);
  estimate.lambda = lambda;
  estimate.radius2 = radius2;
  // Four billion photons are as good as any number: the count stays there, and the ratio at
  // nearly 1.
  uint carry;
  uint count = uaddCarry(estimate.count, new_photons, carry);
  estimate.count = carry == 0u ? count : 0xffffffffu;
  return estimate;
}

// N of Eq. 7 and tau of Eq. 12, on demand.
PPM_FN float accumulated_photons(Estimate estimate, float alpha) {
  return alpha * float(estimate.count);
}
PPM_FN vec3 accumulated_flux(Estimate estimate) {
  return estimate.lambda * (PPM_PI * estimate.radius2);
}

// Eq. 13: fluxes are in units in which all lights together emit 1 a path, so total_power /
// photons_emitted
// (`scale`) turns lambda into radiance.
PPM_FN vec3 radiance(Estimate estimate, float scale) {
  return estimate.lambda * scale;
}

// Bin of the histogram of radii: half octaves of R^2 from 2^-64 on, straight from the exponent and
// the highest bit of the mantissa.
PPM_FN uint radius_bin(float radius2) {
  uint half_octave = floatBitsToUint(radius2) >> 22u;  // 2 * (exponent + 127) + that bit
  return clamp(half_octave, 126u, 126u + uint(PPM_RADIUS_BINS) - 1u) - 126u;
}

// Sums are 32.32 fixed point: a function of the set of photons, whatever their order or partition.
// Range of one term [0, 2^31); resolution 2^-32, of sums of terms that are typically 0.1 to 1.
#define PPM_FIXED_LIMIT 2147483648.0f

struct Fixed64 {
  uint low, high;
};

// x in [0, PPM_FIXED_LIMIT), rounded to nearest.
PPM_FN Fixed64 to_fixed(float x) {
  float whole = floor(x);
  Fixed64 result;
  result.high = uint(whole);
  result.low = uint(roundEven((x - whole) * 4294967296.0f));
  return result;
}

PPM_FN float from_fixed(Fixed64 x) {
  PPM_PRECISE float value = float(x.high) + float(x.low) * 2.3283064365386963e-10f;
  return value;
}

// carry_out is 1 when the sum does not fit: it must be counted as an overflow.
PPM_FN Fixed64 add_fixed(Fixed64 a, Fixed64 b, PPM_OUT(uint) carry_out) {
  uint carry;
  Fixed64 sum;
  sum.low = uaddCarry(a.low, b.low, carry);
  uint carry_high;
  uint high = uaddCarry(a.high, carry, carry_high);
  sum.high = uaddCarry(high, b.high, carry_out);
  carry_out |= carry_high;
  return sum;
}

// Adds x in [0, PPM_FIXED_LIMIT). Bit 31 of `highs` is set as soon as the sum passes 2^31, before
// it could pass 2^32 unseen.
PPM_FN void accumulate_fixed(PPM_INOUT(Fixed64) sum, float x, PPM_INOUT(uint) highs) {
  Fixed64 term = to_fixed(x);
  sum.low += term.low;
  sum.high += term.high + (sum.low < term.low ? 1u : 0u);
  highs |= sum.high;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_PPM_H
