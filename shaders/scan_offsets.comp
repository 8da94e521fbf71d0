// Exclusive scan, step 3 of 3: the offset of every entry, and the total behind the last.
//
// One invocation a chunk.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

layout(push_constant, scalar) uniform PushBlock { ScanPush push; };
layout(binding = PPM_BIND_CELL_COUNT, scalar) readonly buffer Counts { uint counts[]; };
layout(binding = PPM_BIND_SCAN_SUMS, scalar) readonly buffer Sums { uint sums[]; };
layout(binding = PPM_BIND_CELL_START, scalar) writeonly buffer Starts { uint starts[]; };

void main() {
  uint chunk = item_of_invocation(push.first);
  if (chunk >= push.first + push.count) return;
  uint begin = chunk * PPM_SCAN_CHUNK;
  uint end = min(begin + PPM_SCAN_CHUNK, push.total);
  uint running = sums[chunk];
  for (uint i = begin; i < end; ++i) {
    starts[i] = running;
    running += counts[i];
  }
  if (end == push.total) starts[end] = running;
}
