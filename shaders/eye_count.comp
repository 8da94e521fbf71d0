// Canonical order of hit points, step 1: how many each eye path left.
//
// One invocation a staged hit point; adds to CELL_COUNT (cleared before), one entry an eye path of the tile.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

layout(push_constant, scalar) uniform PushBlock { EyeOrderPush push; };
layout(binding = PPM_BIND_STAGED_KEYS, scalar) readonly buffer StagedKeys { StagedKey staged_keys[]; };
layout(binding = PPM_BIND_CELL_COUNT, scalar) buffer Counts { uint counts[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  atomicAdd(counts[staged_keys[item].group], 1u);
}
