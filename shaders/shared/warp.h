// Samplers and, next to each, its density. Measures are in the names.
#ifndef PPM_SHARED_WARP_H
#define PPM_SHARED_WARP_H

#include "shared/geometry.h"
#include "shared/layout.h"

PPM_NAMESPACE_BEGIN

// Uniform on the unit sphere.
PPM_FN vec3 sample_sphere(vec2 u) {
  float z = 1.0f - 2.0f * u.x;
  float r = sqrt(max(0.0f, 1.0f - z * z));
  vec2 circle = unit_circle(u.y);
  return vec3(r * circle.x, r * circle.y, z);
}
PPM_FN float sphere_pdf_solid_angle() {
  return 0.25f * PPM_INVERSE_PI;
}

// Cosine weighted on the hemisphere around +z.
PPM_FN vec3 sample_cosine_hemisphere(vec2 u) {
  vec2 circle = unit_circle(u.y);
  float r = sqrt(u.x);
  return vec3(r * circle.x, r * circle.y, sqrt(max(0.0f, 1.0f - u.x)));
}
PPM_FN float cosine_hemisphere_pdf_solid_angle(float cosine) {
  return max(cosine, 0.0f) * PPM_INVERSE_PI;
}

// Uniform in the cone around +z whose half angle has this cosine.
PPM_FN vec3 sample_cone(vec2 u, float cos_angle) {
  float z = 1.0f - u.x * (1.0f - cos_angle);
  float r = sqrt(max(0.0f, 1.0f - z * z));
  vec2 circle = unit_circle(u.y);
  return vec3(r * circle.x, r * circle.y, z);
}
PPM_FN float cone_pdf_solid_angle(float cos_angle) {
  return 0.5f * PPM_INVERSE_PI / (1.0f - cos_angle);
}

// Uniform on the unit disc.
PPM_FN vec2 sample_disc(vec2 u) {
  return unit_circle(u.y) * sqrt(u.x);
}
PPM_FN float disc_pdf_area() {
  return PPM_INVERSE_PI;
}

// Uniform on a triangle: barycentric weights of the corners 1 and 2.
PPM_FN vec2 sample_triangle(vec2 u) {
  float root = sqrt(u.x);
  return vec2(root * (1.0f - u.y), root * u.y);
}

// Inverse of the error function on (-1, 1), relative error below 4e-7.
// Giles: Approximating the erfinv Function (GPU Computing Gems, 2012), single precision.
PPM_FN float inverse_erf(float x) {
  float w = -log((1.0f - x) * (1.0f + x));
  float p;
  if (w < 5.0f) {
    w = w - 2.5f;
    p = 2.81022636e-08f;
    p = 3.43273939e-07f + p * w;
    p = -3.5233877e-06f + p * w;
    p = -4.39150654e-06f + p * w;
    p = 0.00021858087f + p * w;
    p = -0.00125372503f + p * w;
    p = -0.00417768164f + p * w;
    p = 0.246640727f + p * w;
    p = 1.50140941f + p * w;
  } else {
    w = sqrt(w) - 3.0f;
    p = -0.000200214257f;
    p = 0.000100950558f + p * w;
    p = 0.00134934322f + p * w;
    p = -0.00367342844f + p * w;
    p = 0.00573950773f + p * w;
    p = -0.0076224613f + p * w;
    p = 0.00943887047f + p * w;
    p = 1.00167406f + p * w;
    p = 2.83297682f + p * w;
  }
  return p * x;
}

// One coordinate of the pixel filter: an offset from the pixel's centre, in pixels. The density of
// the offset is the filter itself, so that all eye paths weigh the same. Box: width 1. Tent:
// radius 1. Gaussian: standard deviation 0.5, cut at three of them.
PPM_FN float sample_filter(uint kind, float u) {
  if (kind == PPM_FILTER_TENT) {
    return u < 0.5f ? sqrt(2.0f * u) - 1.0f : 1.0f - sqrt(max(0.0f, 2.0f - 2.0f * u));
  }
  if (kind == PPM_FILTER_GAUSSIAN) {
    // 0.99730020 = erf(3 / sqrt 2); 0.70710678 = 0.5 * sqrt 2.
    return 0.70710678f * inverse_erf(0.99730020f * (2.0f * u - 1.0f));
  }
  return u - 0.5f;
}

// The filter itself at an offset from the pixel's centre: the density of sample_filter.
PPM_FN float filter_value(uint kind, float offset) {
  float size = abs(offset);
  if (kind == PPM_FILTER_TENT) return max(1.0f - size, 0.0f);
  if (kind == PPM_FILTER_GAUSSIAN) {
    // 1 / (0.5 sqrt(2 pi) * 0.99730020)
    return size < 1.5f ? 0.80004450f * exp(-2.0f * size * size) : 0.0f;
  }
  return size <= 0.5f ? 1.0f : 0.0f;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_WARP_H
