// Radius reduction and flux correction [HOJ08 Eqs. 7, 9, 12]: one invocation owns one hit point's statistics.
//
// Reads and clears GATHER_SUMS; updates STATISTICS and PHOTON_COUNTS; adds to the histogram of radii from which the
// next pass's grid is sized.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "shared/ppm.h"

layout(push_constant, scalar) uniform PushBlock { UpdatePush push; };
layout(binding = PPM_BIND_STATISTICS, scalar) buffer Statistics { vec4 statistics[]; };
layout(binding = PPM_BIND_PHOTON_COUNTS, scalar) buffer PhotonCounts { uint photon_counts[]; };
layout(binding = PPM_BIND_GATHER_SUMS, scalar) buffer GatherSums { GatherSum gather_sums[]; };
layout(binding = PPM_BIND_RADIUS_HISTOGRAM, scalar) buffer RadiusHistogram { uint radius_histogram[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  vec4 statistic = statistics[item];
  if (statistic.w <= 0.0) return;  // light seen, not a hit point
  GatherSum sums = gather_sums[item];
  if (sums.count != 0u) {
    vec3 flux = vec3(from_fixed(Fixed64(sums.flux[0], sums.flux[1])),
                     from_fixed(Fixed64(sums.flux[2], sums.flux[3])),
                     from_fixed(Fixed64(sums.flux[4], sums.flux[5])));
    Estimate estimate = Estimate(statistic.xyz, statistic.w, photon_counts[item]);
    estimate = update_estimate(estimate, push.alpha, sums.count, flux);
    statistic = vec4(estimate.lambda, estimate.radius2);
    statistics[item] = statistic;
    photon_counts[item] = estimate.count;
    gather_sums[item] = GatherSum(0u, uint[6](0u, 0u, 0u, 0u, 0u, 0u), 0u, uint[2](0u, 0u));
  }
  atomicAdd(radius_histogram[radius_bin(statistic.w)], 1u);
}
