// Canonical order of hit points, step 3 (step 2 is the scan): staged hit points listed by eye path.
//
// One invocation a staged hit point; writes ORDER. Within one eye path the order is still arbitrary.
// CELL_COUNT counts down to zero.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

layout(push_constant, scalar) uniform PushBlock { EyeOrderPush push; };
layout(binding = PPM_BIND_STAGED_KEYS, scalar) readonly buffer StagedKeys { StagedKey staged_keys[]; };
layout(binding = PPM_BIND_CELL_COUNT, scalar) buffer Counts { uint counts[]; };
layout(binding = PPM_BIND_SAMPLE_START, scalar) readonly buffer SampleStarts { uint sample_start[]; };
layout(binding = PPM_BIND_ORDER, scalar) writeonly buffer Order { uint order[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  uint group = staged_keys[item].group;
  order[sample_start[group] + atomicAdd(counts[group], 0xffffffffu) - 1u] = item;
}
