// Exclusive scan, step 2 of 3: the chunks' sums turned into their first offsets, in place, by one invocation.
// A dispatch takes at most PPM_SCAN_SLICE chunks (loops are bounded); the next goes on from its total.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

layout(push_constant, scalar) uniform PushBlock { ScanPush push; };
layout(binding = PPM_BIND_SCAN_SUMS, scalar) buffer Sums { uint sums[]; };

void main() {
  if (item_of_invocation(push.first) != push.first) return;
  // `total` chunks in all; `slice` is the first of this dispatch. The slot past the last holds the running total.
  uint running = push.slice == 0u ? 0u : sums[push.total];
  uint end = min(push.slice + PPM_SCAN_SLICE, push.total);
  for (uint i = push.slice; i < end; ++i) {
    uint sum = sums[i];
    sums[i] = running;
    running += sum;
  }
  sums[push.total] = running;
}
