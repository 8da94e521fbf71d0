// Pilot pass, step 2 of 2: the initial radius of each hit point [HOJ08 section 4: "use the photon map to estimate the
// radius around each hit point"].
//
// Rounds of halving radii: whoever found fewer than PPM_PILOT_ENOUGH times the wanted photons takes
// R^2 = r^2 * wanted / found of that round, the others go on to the next. One invocation a hit point. Until it has its
// radius, STATISTICS.w holds the footprint squared, negated. Clears GATHER_SUMS.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"
#include "shared/geometry.h"

layout(push_constant, scalar) uniform PushBlock { PilotPush push; };
layout(binding = PPM_BIND_STATISTICS, scalar) buffer Statistics { vec4 statistics[]; };
layout(binding = PPM_BIND_GATHER_SUMS, scalar) buffer GatherSums { GatherSum gather_sums[]; };

void main() {
  uint hit = item_of_invocation(push.first);
  if (hit >= push.first + push.count) return;
  float mark = statistics[hit].w;
  if (mark >= 0.0) return;  // decided, or light seen
  uint found = gather_sums[hit].count;
  bool enough = gather_sums[hit].nearby > PPM_GATHER_SLICE || found >= PPM_PILOT_ENOUGH * push.wanted;
  gather_sums[hit].count = 0u;
  gather_sums[hit].nearby = 0u;

  float least = square(push.footprints_min) * -mark;
  float most = square(push.round_index == 0u ? push.radius : 2.0 * push.radius);
  if (enough && push.last_round == 0u && square(push.radius) > least) {
    count_event(PPM_COUNTER_UNDECIDED);
    return;
  }
  // With less than the wanted in the first round this is the largest radius there is.
  float radius2 = square(push.radius) * float(push.wanted) / float(max(found, 1u));
  statistics[hit].w = clamp(enough ? least : radius2, min(least, most), most);
}
