// Tells what the device's profile made of the constants that are left to it, and which items were visited.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

layout(push_constant, scalar) uniform PushBlock { uint first, count; } push;
layout(binding = PPM_BIND_TEST_0, scalar) buffer Results { uint results[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  if (item == 0u) {
    results[0] = gl_WorkGroupSize.x;
    results[1] = kAlternateHalves ? 1u : 0u;
  }
  atomicAdd(results[2u + item], 1u);
}
