// Directions, frames and their packed forms; offsets of ray origins.
#ifndef PPM_SHARED_GEOMETRY_H
#define PPM_SHARED_GEOMETRY_H

#include "shared/lang.h"

PPM_NAMESPACE_BEGIN

#define PPM_PI 3.14159265358979324f
#define PPM_INVERSE_PI 0.318309886183790672f

PPM_FN float square(float x) {
  return x * x;
}
PPM_FN float max_component(vec3 v) {
  return max(v.x, max(v.y, v.z));
}
PPM_FN float mean_component(vec3 v) {
  return (v.x + v.y + v.z) * 0.333333333333f;
}
PPM_FN float sign_not_zero(float x) {
  return x >= 0.0f ? 1.0f : -1.0f;
}

// Bit test, since the driver may assume that NaN and infinity do not occur.
PPM_FN bool is_finite(float x) {
  return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}
PPM_FN bool is_finite3(vec3 v) {
  return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}

// Octahedral map of the unit sphere to 2 x 16 bits; error below 7e-5 radians.
// Cigolle et al.: A Survey of Efficient Representations for Independent Unit Vectors (JCGT 2014).
// Directions along the axes are exact.
PPM_FN uint pack_direction(vec3 direction) {
  float scale = 1.0f / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  float x = direction.x * scale;
  float y = direction.y * scale;
  if (direction.z < 0.0f) {
    float folded = (1.0f - abs(y)) * sign_not_zero(x);
    y = (1.0f - abs(x)) * sign_not_zero(y);
    x = folded;
  }
  // 65534 steps, so that 0 and both ends are representable.
  uint qx = uint(clamp(x, -1.0f, 1.0f) * 32767.0f + 32767.5f);
  uint qy = uint(clamp(y, -1.0f, 1.0f) * 32767.0f + 32767.5f);
  return qx | (qy << 16u);
}

// A vector along the packed direction, not shorter than 1 / sqrt(3) and not longer than 1.
PPM_FN vec3 unpack_octahedral(uint bits) {
  // By way of int, which converts in fewer steps on CPUs.
  float x = (float(int(bits & 0xffffu)) - 32767.0f) * (1.0f / 32767.0f);
  float y = (float(int(bits >> 16u)) - 32767.0f) * (1.0f / 32767.0f);
  float z = 1.0f - abs(x) - abs(y);
  if (z < 0.0f) {
    float folded = (1.0f - abs(y)) * sign_not_zero(x);
    y = (1.0f - abs(x)) * sign_not_zero(y);
    x = folded;
  }
  return vec3(x, y, z);
}

PPM_FN vec3 unpack_direction(uint bits) {
  vec3 v = unpack_octahedral(bits);
  return v * (1.0f / sqrt(v.x * v.x + v.y * v.y + v.z * v.z));  // one division, not three
}

// Sine and cosine of 2 pi u for u in [0, 1): Vulkan grants sin and cos only 2^-11.
// Taylor polynomials on [-pi/4, pi/4], error below 4e-7.
PPM_FN vec2 unit_circle(float u) {
  float quarter = floor(u * 4.0f + 0.5f);
  float x = (u * 4.0f - quarter) * (0.5f * PPM_PI);
  float x2 = x * x;
  float sine = x * (1.0f + x2 * (-1.0f / 6.0f + x2 * (1.0f / 120.0f - x2 * (1.0f / 5040.0f))));
  float cosine =
      1.0f + x2 * (-0.5f + x2 * (1.0f / 24.0f + x2 * (-1.0f / 720.0f + x2 * (1.0f / 40320.0f))));
  uint turns = uint(quarter) & 3u;
  if (turns == 1u) return vec2(-sine, cosine);
  if (turns == 2u) return vec2(-cosine, -sine);
  if (turns == 3u) return vec2(sine, -cosine);
  return vec2(cosine, sine);
}

// Two unit vectors that make a right-handed frame with the unit vector n.
// Duff et al.: Building an Orthonormal Basis, Revisited (JCGT 2017).
PPM_FN void tangent_frame(vec3 n, PPM_OUT(vec3) tangent, PPM_OUT(vec3) bitangent) {
  float s = sign_not_zero(n.z);
  float a = -1.0f / (s + n.z);
  float b = n.x * n.y * a;
  tangent = vec3(1.0f + s * n.x * n.x * a, s * b, -s * n.x);
  bitangent = vec3(b, s + n.y * n.y * a, -n.y);
}

PPM_FN vec3 to_world(vec3 local, vec3 n) {
  vec3 tangent;
  vec3 bitangent;
  tangent_frame(n, tangent, bitangent);
  return tangent * local.x + bitangent * local.y + n * local.z;
}

PPM_FN vec3 to_local(vec3 world, vec3 n) {
  vec3 tangent;
  vec3 bitangent;
  tangent_frame(n, tangent, bitangent);
  return vec3(dot(world, tangent), dot(world, bitangent), dot(world, n));
}

// Where a ray that leaves a surface starts: off the surface by more than the rounding error of the
// position. All geometry lies within [-1,1]^3 of the working frame, where barycentric interpolation
// errs by less than 8 * 2^-24 a coordinate; 2^-20 is twice that. `side` is the geometric normal on
// the side the ray leaves to. A ray also skips the triangle it starts on, so that the offset only
// has to clear its neighbours.
PPM_FN vec3 offset_origin(vec3 position, vec3 side) {
  return position + side * 9.5367431640625e-7f;
}

// Radius squared of the circle that a pixel's solid angle cuts from a surface:
// pi r^2 cos = solid_angle * distance^2, the cosine held above 0.1.
PPM_FN float footprint_radius(float pixel_solid_angle, float path_length, float cosine) {
  return path_length * sqrt(pixel_solid_angle * PPM_INVERSE_PI / max(abs(cosine), 0.1f));
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_GEOMETRY_H
