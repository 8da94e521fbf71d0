#version 460
// Writes its push constants and specialisation constants, word by word.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/bindings.h"

layout(constant_id = 3) const uint kUnsigned = 7u;
layout(constant_id = 5) const float kFloat = 0.5;
layout(constant_id = 8) const bool kFlag = false;

struct Inner { vec3 position; float words[2]; uvec2 pair; };

layout(local_size_x = 16) in;
// 128 bytes: 12 + 12 + 28 + 3 * 12 + 36 + 4, each member right behind the one before.
layout(push_constant, scalar) uniform Push {
  uint first, count;
  int sign;
  vec3 direction;
  Inner inner;
  vec3 rows[3];
  mat3 turn;
  uint last;
} push;
layout(set = 0, binding = PPM_BIND_TEST_0, scalar) buffer Results { uint results[]; };

void main() {
  if (gl_GlobalInvocationID.x != 0) return;
  results[0] = push.first;
  results[1] = push.count;
  results[2] = uint(push.sign);
  uint at = 3;
  for (int i = 0; i < 3; ++i) results[at++] = floatBitsToUint(push.direction[i]);
  for (int i = 0; i < 3; ++i) results[at++] = floatBitsToUint(push.inner.position[i]);
  for (int i = 0; i < 2; ++i) results[at++] = floatBitsToUint(push.inner.words[i]);
  for (int i = 0; i < 2; ++i) results[at++] = push.inner.pair[i];
  for (int i = 0; i < 9; ++i) results[at++] = floatBitsToUint(push.rows[i / 3][i % 3]);
  for (int i = 0; i < 9; ++i) results[at++] = floatBitsToUint(push.turn[i / 3][i % 3]);
  results[at++] = push.last;
  results[at++] = kUnsigned;
  results[at++] = floatBitsToUint(kFloat);
  results[at++] = kFlag ? 1u : 0u;
}
