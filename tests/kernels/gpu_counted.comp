#version 460
// Adds one to the word of each item, as many in each row as TEST_1 says from its third word on.
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

layout(push_constant, scalar) uniform PushBlock { uint first, count, stride; } push;
layout(binding = PPM_BIND_TEST_0, scalar) buffer Visits { uint visits[]; };
layout(binding = PPM_BIND_TEST_1, scalar) readonly buffer Counts { uint counts[]; };

void main() {
  uint row = gl_WorkGroupID.y;
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count || item >= counts[2u + row]) return;
  atomicAdd(visits[row * push.stride + item], 1u);
}
