// Functions of the shared text, each over 8 words of input and to 8 words of output, for both
// languages to compile: the device's answers are compared with the host's.
#ifndef PPM_TESTS_SHARED_PROBE_H
#define PPM_TESTS_SHARED_PROBE_H

#include "shared/bsdf.h"
#include "shared/camera.h"
#include "shared/grid.h"
#include "shared/light.h"
#include "shared/photon.h"
#include "shared/ppm.h"
#include "shared/random.h"

PPM_NAMESPACE_BEGIN

#define PPM_PROBE_WORDS 0u  // integers in, integers out: exact
#define PPM_PROBE_FIXED 1u
#define PPM_PROBE_GRID 2u
#define PPM_PROBE_PIXELS 3u
#define PPM_PROBE_UPDATE 4u  // precise floats
#define PPM_PROBE_CIRCLE 5u  // from here on floats
#define PPM_PROBE_FRAME 6u
#define PPM_PROBE_GGX 7u
#define PPM_PROBE_FRESNEL 8u
#define PPM_PROBE_CAMERA 9u
#define PPM_PROBE_UNPACK 10u
#define PPM_PROBE_PACK 11u  // two packed directions
#define PPM_PROBE_COUNT 12u

struct ProbeWords {
  uvec4 a, b;
};

PPM_FN uvec4 float_words(float x, float y, float z, float w) {
  return uvec4(floatBitsToUint(x), floatBitsToUint(y), floatBitsToUint(z), floatBitsToUint(w));
}
PPM_FN uvec4 vector_words(vec3 v, float w) {
  return float_words(v.x, v.y, v.z, w);
}

// Somewhere on the upper hemisphere, from two words; cosine at least 0.02.
PPM_FN vec3 upper_direction(uint x, uint y) {
  float z = 0.02f + 0.98f * unit_from_word(x);
  float azimuth = unit_from_word(y);
  float r = sqrt(1.0f - z * z);
  vec2 circle = unit_circle(azimuth);
  return vec3(r * circle.x, r * circle.y, z);
}

PPM_FN ProbeWords probe_integers(uint which, ProbeWords words) {
  ProbeWords result;
  result.a = uvec4(0u);
  result.b = uvec4(0u);
  if (which == PPM_PROBE_WORDS) {
    result.a = philox_4x32_10(words.a, uvec2(words.b.x, words.b.y));
    result.b = uvec4(index_from_word(words.a.x, words.b.z), radius_bin(unit_from_word(words.a.y)),
                     floatBitsToUint(unit_from_word(words.a.z)),
                     floatBitsToUint(radical_inverse(words.a.w)));
  } else if (which == PPM_PROBE_FIXED) {
    float scale = uintBitsToFloat(0x2f800000u + ((words.a.y % 62u) << 23u));  // 2^-32 to 2^29
    Fixed64 x = to_fixed(scale * (1.0f + unit_from_word(words.a.x)));
    Fixed64 sum;
    sum.low = words.a.z;
    sum.high = words.a.w;
    uint carry;
    sum = add_fixed(sum, x, carry);
    result.a = uvec4(x.low, x.high, sum.low, sum.high);
    result.b = uvec4(carry, floatBitsToUint(from_fixed(sum)), 0u, 0u);
  } else if (which == PPM_PROBE_GRID) {
    GridConstants grid;
    grid.origin = vec3(-1.0f, -0.5f, 0.0f);
    grid.inverse_cell = 37.7f;
    grid.size = uvec3(70u, 40u, 90u);
    grid.table_mask = (words.b.x & 1u) == 0u ? 0xffffffffu : 0xfffu;
    grid.table_first = words.b.y & 0xffu;
    vec3 position =
        vec3(unit_from_word(words.a.x), unit_from_word(words.a.y), unit_from_word(words.a.z)) *
            3.0f -
        vec3(1.5f);
    uvec3 cell = grid_cell(grid, position);
    result.a = uvec4(cell.x, cell.y, cell.z, grid_table_index(grid, cell));
  } else if (which == PPM_PROBE_PIXELS) {
    uint width = 1u + words.a.x % 100u;
    uint height = 1u + words.a.y % 100u;
    uvec2 pixel = pixel_position(words.a.z % (width * height), width, height);
    result.a = uvec4(pixel.x, pixel.y, 0u, 0u);
  } else if (which == PPM_PROBE_UPDATE) {
    Estimate estimate;
    estimate.lambda = vec3(unit_from_word(words.a.x), unit_from_word(words.a.y), 0.5f);
    estimate.radius2 = 1e-6f + 1e-3f * unit_from_word(words.a.z);
    estimate.count = words.a.w % 100000u;
    estimate = update_estimate(estimate, 0.7f, words.b.x % 100u,
                               vec3(unit_from_word(words.b.y), unit_from_word(words.b.z), 0.0f));
    result.a = vector_words(estimate.lambda, estimate.radius2);
    result.b = uvec4(estimate.count, 0u, 0u, 0u);
  }
  return result;
}

PPM_FN ProbeWords probe_floats(uint which, ProbeWords words) {
  vec3 wo = upper_direction(words.a.x, words.a.y);
  vec3 wi = upper_direction(words.a.z, words.a.w);
  float u = unit_from_word(words.b.x);
  float v = unit_from_word(words.b.y);
  ProbeWords result;
  result.a = uvec4(0u);
  result.b = uvec4(0u);
  if (which == PPM_PROBE_CIRCLE) {
    vec2 circle = unit_circle(u);
    result.a = vector_words(sample_sphere(vec2(u, v)), circle.x);
    result.b = vector_words(sample_cosine_hemisphere(vec2(u, v)), circle.y);
  } else if (which == PPM_PROBE_FRAME) {
    result.a = vector_words(to_world(wi, wo), 0.0f);
    result.b = vector_words(to_local(wi, wo), 0.0f);
  } else if (which == PPM_PROBE_GGX) {
    GgxLobe lobe;
    lobe.f0 = vec3(0.2f, 0.5f, 0.9f);
    lobe.f90 = 1.0f;
    lobe.alpha = 0.05f + u;
    result.a = vector_words(ggx_eval(lobe, wo, wi), ggx_pdf_solid_angle(lobe.alpha, wo, wi));
    result.b = vector_words(ggx_sample(lobe.alpha, wo, vec2(v, unit_from_word(words.b.z))), 0.0f);
  } else if (which == PPM_PROBE_FRESNEL) {
    float transmitted;
    // Indices either side of 1, but for total reflection's edge, where the root has no digits.
    float eta = 1.1f + u;
    float fresnel = fresnel_dielectric(wo.z, eta, transmitted);
    result.a =
        float_words(fresnel, transmitted, thin_sheet_reflectance(fresnel), schlick_weight(wi.z));
    DiffuseLobe lobe;
    lobe.albedo = vec3(u, v, 0.5f);
    lobe.coat_f0 = 0.04f;
    lobe.coat_f90 = 1.0f;
    result.b = vector_words(diffuse_eval(lobe, wo.z, wi.z), 0.0f);
  } else if (which == PPM_PROBE_CAMERA) {
    vec2 film = film_sample(words.b.z % 3u, 7u, 9u, words.b.w % 5u, 5u, vec3(u, v, 0.3f));
    result.a = float_words(film.x, film.y, footprint_radius(0.001f, u + 0.1f, wo.z), 0.0f);
    result.b = vector_words(offset_origin(wo, wi), 0.0f);
  } else if (which == PPM_PROBE_UNPACK) {
    result.a = vector_words(unpack_direction(words.a.x), 0.0f);
    result.b = vector_words(unpack_direction(words.a.y), 0.0f);
  } else if (which == PPM_PROBE_PACK) {
    vec3 down = vec3(wi.x, wi.y, -wi.z);
    result.a = uvec4(pack_direction(wo), pack_direction(down), 0u, 0u);
  }
  return result;
}

PPM_FN ProbeWords probe(uint which, ProbeWords words) {
  if (which < PPM_PROBE_CIRCLE) return probe_integers(which, words);
  return probe_floats(which, words);
}

PPM_NAMESPACE_END

#endif  // PPM_TESTS_SHARED_PROBE_H
