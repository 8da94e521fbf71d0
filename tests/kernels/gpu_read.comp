#version 460
// Reads item i as a texel and as words of a storage buffer and a uniform block, and writes what it read.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/bindings.h"

layout(local_size_x = 32) in;
layout(push_constant, scalar) uniform Push { uint first, count; } push;
layout(set = 0, binding = PPM_BIND_TEST_0) uniform usamplerBuffer texels;
layout(set = 0, binding = PPM_BIND_TEST_1, scalar) readonly buffer Words { uvec4 words[]; };
layout(set = 0, binding = PPM_BIND_TEST_2, scalar) writeonly buffer Results { uvec4 results[]; };
layout(set = 0, binding = PPM_BIND_TEST_3, scalar) uniform Constants { uvec3 offset; uint scale; } constants;
// Declared, but used by no instruction: must not ask for a buffer.
layout(set = 0, binding = PPM_BIND_COUNTERS, scalar) buffer Counters { uint counters[]; };

void main() {
  if (gl_GlobalInvocationID.x >= push.count) return;
  const uint i = push.first + gl_GlobalInvocationID.x;
  const uvec4 texel = texelFetch(texels, int(i));
  const uvec4 word = words[i];
  results[3 * i] = texel;
  results[3 * i + 1] = word;
  results[3 * i + 2] = uvec4(texel.xyz * constants.scale + constants.offset, word.w);
}
