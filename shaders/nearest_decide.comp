// Photon map: what a round of the searches for hit points' n-th nearest photons decides (shared/nearest.h).
//
// One invocation a hit point of the list CONTINUE_IN. Whose photon is known gets its squared distance in STATISTICS.w,
// in the histogram of radii, and nothing in the rest of its statistics; the others go on in the list CONTINUE_OUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"
#include "shared/nearest.h"
#include "shared/ppm.h"

layout(push_constant, scalar) uniform PushBlock { NearestStepPush push; };
layout(binding = PPM_BIND_STATISTICS, scalar) writeonly buffer Statistics { vec4 statistics[]; };
layout(binding = PPM_BIND_PHOTON_COUNTS, scalar) writeonly buffer PhotonCounts { uint photon_counts[]; };
layout(binding = PPM_BIND_RADIUS_HISTOGRAM, scalar) buffer RadiusHistogram { uint radius_histogram[]; };
layout(binding = PPM_BIND_NEAREST, scalar) buffer Searches { NearestSearch searches[]; };
layout(binding = PPM_BIND_CONTINUE_IN, scalar) readonly buffer ContinueIn { uint continue_in[]; };
layout(binding = PPM_BIND_CONTINUE_OUT, scalar) writeonly buffer ContinueOut { uint continue_out[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  uint hit = continue_in[item];
  NearestSearch search = searches[hit];
  uint word = nearest_decide(search, push.wanted, push.most, push.round);
  if (word == 0u) {
    searches[hit] = search;
    continue_out[atomicAdd(counters[PPM_COUNTER_UNDECIDED], 1u)] = hit;
  } else {
    float radius2 = uintBitsToFloat(word);
    statistics[hit] = vec4(0.0, 0.0, 0.0, radius2);
    photon_counts[hit] = 0u;
    atomicAdd(radius_histogram[radius_bin(radius2)], 1u);
  }
}
