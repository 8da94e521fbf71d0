// Canonical order of hit points, step 2 (step 1 is the scan of their counts): listed by eye path.
//
// One invocation a hit point; writes ARRIVALS. Within one eye path the order is still arbitrary.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

layout(push_constant, scalar) uniform PushBlock { EyeOrderPush push; };
layout(binding = PPM_BIND_HIT_KEYS, scalar) readonly buffer HitKeys { HitKey hit_keys[]; };
layout(binding = PPM_BIND_SAMPLE_START, scalar) readonly buffer SampleStarts { uint sample_start[]; };
layout(binding = PPM_BIND_ARRIVALS, scalar) writeonly buffer Arrivals { uint arrivals[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  arrivals[sample_start[hit_keys[item].group] + hit_keys[item].arrival] = item;
}
