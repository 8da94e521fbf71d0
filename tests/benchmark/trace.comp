// Closest hits of given rays, as the passes find them: for measuring traversal by itself.
//
// Reads rays (TEST_0: origin and direction, two texels each), writes the triangle's slot and the distance of each
// (TEST_1). One invocation a ray.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/traverse.glsl"

layout(push_constant, scalar) uniform PushBlock { uint first, count; } push;
PPM_TEXELS(PPM_BIND_TEST_0, rays);
layout(binding = PPM_BIND_TEST_1, scalar) writeonly buffer Hits { uvec2 hits[]; };

bool hit_filter(uint triangle, uint material, vec2 barycentric) {
  return true;
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  vec3 origin = uintBitsToFloat(PPM_FETCH(rays, 2u * item).xyz);
  vec3 direction = uintBitsToFloat(PPM_FETCH(rays, 2u * item + 1u).xyz);
  Hit hit = closest_hit(origin, direction, PPM_NO_TRIANGLE);
  hits[item] = uvec2(hit.triangle, floatBitsToUint(hit.t));
}
