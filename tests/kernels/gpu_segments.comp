#version 460
// Reads item i from a buffer in segments and writes what it read.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/texels.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint first, count; } push;
PPM_SEGMENTED_TEXELS(PPM_BIND_TEST_0, texels);
layout(set = 0, binding = PPM_BIND_TEST_1, scalar) writeonly buffer Results { uvec4 results[]; };

void main() {
  if (gl_GlobalInvocationID.x >= push.count) return;
  const uint i = push.first + gl_GlobalInvocationID.x;
  results[i] = PPM_FETCH_SEGMENTED(texels, i);
}
