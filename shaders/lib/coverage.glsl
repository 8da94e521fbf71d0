// Coverage: alphaMode MASK and BLEND. A surface stops a ray, or lets it pass as if nothing were there. With BLEND that
// is a matter of chance, decided for each segment of a path and each triangle by a hash: whatever the order in which a
// ray meets triangles, and on however many devices, the decision is the same, and a ray meets each triangle once.
//
// Defines the hit_filter of lib/traverse.glsl. Kernels set the key before each ray.
#ifndef PPM_LIB_COVERAGE_GLSL
#define PPM_LIB_COVERAGE_GLSL

#include "lib/scene.glsl"
#include "lib/triangle_data.glsl"
#include "shared/random.h"

// Random blocks of a path that decide about its segments, by scattering events before.
const uint kCoverageBlock = 0x80000000u;

uint coverage_key;    // of the ray's segment
uint coverage_shift;  // fraction of 2^32 that is added to all its decisions: strata of rays with one key

// The share of light that is stopped at a point.
float coverage_at(uint triangle, uint material, vec2 barycentric) {
  vec3 weights = corner_weights(barycentric);
  uint first_use = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * material).w;
  uint flags = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * material + 3u).w;
  uvec4 e = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * material + 4u);  // alpha, cutoff, normal scale, uses
  uvec4 c = PPM_FETCH_SEGMENTED(triangle_shading, 4u * triangle + 2u);
  uvec4 d = PPM_FETCH_SEGMENTED(triangle_shading, 4u * triangle + 3u);
  float alpha = uintBitsToFloat(e.x) * color_at(c, d, weights).a;
  if (kTextures) {
    uvec4 b = PPM_FETCH_SEGMENTED(triangle_shading, 4u * triangle + 1u);
    Details details;
    if (kDetails) details = details_at(triangle, weights);
    alpha *= sample_use(first_use, e.w, PPM_USE_BASE_COLOR, texcoords_at(b, c, weights, details)).a;
  }
  if ((flags & PPM_MATERIAL_BLEND) != 0u) return alpha;
  return (flags & PPM_MATERIAL_MASK) == 0u || alpha >= uintBitsToFloat(e.y) ? 1.0 : 0.0;
}

// `material`: as TrianglePositions has it.
bool hit_filter(uint triangle, uint material, vec2 barycentric) {
  if (!kCoverage || (material & PPM_HAS_COVERAGE) == 0u) return true;
  float coverage = coverage_at(triangle, material & ~PPM_HAS_COVERAGE, barycentric);
  return unit_from_word(hash_words(coverage_key, triangle) + coverage_shift) < coverage;
}

// A texture of the triangle's material, or ones.
vec4 sample_use_at(uint triangle, uint material, vec2 barycentric, uint which) {
  if (!kTextures) return vec4(1.0);
  vec3 weights = corner_weights(barycentric);
  uint first_use = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * material).w;
  uint use_mask = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * material + 4u).w;
  uvec4 b = PPM_FETCH_SEGMENTED(triangle_shading, 4u * triangle + 1u);
  uvec4 c = PPM_FETCH_SEGMENTED(triangle_shading, 4u * triangle + 2u);
  Details details;
  if (kDetails) details = details_at(triangle, weights);
  return sample_use(first_use, use_mask, which, texcoords_at(b, c, weights, details));
}

// What a triangle light has of its material's emission at a point: its emissive texture, where it is covered.
vec3 light_texture(uint triangle, vec2 barycentric) {
  uint material = PPM_FETCH_SEGMENTED(triangle_shading, 4u * triangle).w;
  float coverage = kCoverage ? coverage_at(triangle, material, barycentric) : 1.0;
  return sample_use_at(triangle, material, barycentric, PPM_USE_EMISSIVE).rgb * coverage;
}

// The clear coat over a triangle light.
float light_coat(uint triangle, vec2 barycentric) {
  uint material = PPM_FETCH_SEGMENTED(triangle_shading, 4u * triangle).w;
  float coat = fetch_material(material).clearcoat;
  return kTexturedLights ? coat * sample_use_at(triangle, material, barycentric, PPM_USE_CLEARCOAT).r : coat;
}

#endif
