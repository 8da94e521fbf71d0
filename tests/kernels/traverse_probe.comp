// Traces rays given by a test: the closest hit, and whether anything is hit before t_max.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/traverse.glsl"

struct ProbeRay {
  vec3 origin;
  float t_max;  // of the any-hit query
  vec3 direction;
  uint skip;
};

struct ProbeHit {
  float t;
  uint triangle;
  vec2 barycentric;
  uint any;
};

layout(push_constant, scalar) uniform PushBlock { uint first, count, refuse_odd; } push;
layout(binding = PPM_BIND_TEST_0, scalar) readonly buffer Rays { ProbeRay rays[]; };
layout(binding = PPM_BIND_TEST_1, scalar) writeonly buffer Hits { ProbeHit hits[]; };

bool hit_filter(uint triangle, uint material, vec2 barycentric) {
  return push.refuse_odd == 0u || (triangle & 1u) == 0u;
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  ProbeRay ray = rays[item];
  Hit hit = closest_hit(ray.origin, ray.direction, ray.skip);
  bool any = any_hit(ray.origin, ray.direction, ray.t_max, ray.skip);
  hits[item] = ProbeHit(hit.t, hit.triangle, hit.barycentric, any ? 1u : 0u);
}
