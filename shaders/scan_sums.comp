// Exclusive scan, step 1 of 3: the sum of each chunk of counts.
//
// Serial chunks, no shared memory: barriers cost more than they save on lavapipe. One invocation a chunk.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

layout(push_constant, scalar) uniform PushBlock { ScanPush push; };
layout(binding = PPM_BIND_CELL_COUNT, scalar) readonly buffer Counts { uint counts[]; };
layout(binding = PPM_BIND_SCAN_SUMS, scalar) writeonly buffer Sums { uint sums[]; };

void main() {
  uint chunk = item_of_invocation(push.first);
  if (chunk >= push.first + push.count) return;
  uint begin = chunk * PPM_SCAN_CHUNK;
  uint end = min(begin + PPM_SCAN_CHUNK, push.total);
  uint sum = 0u;
  for (uint i = begin; i < end; ++i) sum += counts[i];
  sums[chunk] = sum;
}
