#version 460
// One step of a rotation of a buffer's words: item i takes what item i + 1 held, and adds one.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint first, count, items; } push;
layout(set = 0, binding = PPM_BIND_TEST_0, scalar) readonly buffer From { uint from[]; };
layout(set = 0, binding = PPM_BIND_TEST_1, scalar) writeonly buffer To { uint to[]; };

void main() {
  if (gl_GlobalInvocationID.x >= push.count) return;
  const uint i = push.first + gl_GlobalInvocationID.x;
  to[i] = from[(i + 1) % push.items] + 1;
}
