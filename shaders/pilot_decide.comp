// Pilot pass, where its photons come in chunks: what a round decides once all have been counted.
//
// One invocation a hit point; writes the radius to STATISTICS and clears GATHER_SUMS.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"
#include "lib/pilot.glsl"

layout(push_constant, scalar) uniform PushBlock { PilotPush push; };
layout(binding = PPM_BIND_STATISTICS, scalar) buffer Statistics { vec4 statistics[]; };
layout(binding = PPM_BIND_GATHER_SUMS, scalar) buffer GatherSums { GatherSum gather_sums[]; };

void main() {
  uint hit = item_of_invocation(push.first);
  if (hit >= push.first + push.count) return;
  float mark = statistics[hit].w;
  if (mark >= 0.0) return;  // decided, or light seen
  uint found = gather_sums[hit].count;
  bool enough = gather_sums[hit].nearby > PPM_PILOT_CROWD || found >= PPM_PILOT_ENOUGH * push.wanted;
  gather_sums[hit].count = 0u;
  gather_sums[hit].nearby = 0u;
  float radius2 = radius2_from_round(push, mark, enough, found);
  if (radius2 > 0.0) {
    statistics[hit].w = radius2;
  } else {
    count_event(PPM_COUNTER_UNDECIDED);
  }
}
