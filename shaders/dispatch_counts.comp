// Items that were counted on the device, as commands for vkCmdDispatchIndirect: no host in between.
//
// One invocation a range: range i has the items [i * step, (i + 1) * step), the last one all the rest. Rows (the y of
// workgroups) have counts of their own, and as many workgroups each as the longest.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shared/bindings.h"
#include "shared/dispatch_counts.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform PushBlock { DispatchCountsPush push; };
layout(binding = PPM_BIND_DISPATCH_WORDS, scalar) readonly buffer Words { uint words[]; };
layout(binding = PPM_BIND_DISPATCH_COMMANDS, scalar) writeonly buffer Commands { uint commands[]; };

void main() {
  uint range = gl_GlobalInvocationID.x;
  if (range >= push.ranges) return;
  uint items = 0u;
  for (uint row = 0u; row < push.rows; ++row) items = max(items, words[push.word + row]);
  items = min(items, push.most);
  uint first = min(range * push.step, items);
  uint here = items - first;
  if (range + 1u < push.ranges) here = min(here, push.step);
  uint at = 3u * (push.command + range);
  commands[at] = (here + push.workgroup_size - 1u) / push.workgroup_size;
  commands[at + 1u] = push.rows;
  commands[at + 2u] = 1u;
}
