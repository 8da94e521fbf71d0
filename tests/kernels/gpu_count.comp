#version 460
// Adds one to the word of each item: shows how often each item was visited.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint first, count; } push;
layout(set = 0, binding = PPM_BIND_TEST_0, scalar) buffer Visits { uint visits[]; };

void main() {
  if (gl_GlobalInvocationID.x >= push.count) return;
  atomicAdd(visits[push.first + gl_GlobalInvocationID.x], 1u);
}
