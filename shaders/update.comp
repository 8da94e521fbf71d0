// Radius reduction and flux correction [HOJ08 Eqs. 7, 9, 12]: one invocation owns one hit point's statistics.
//
// Reads and clears GATHER_SUMS; updates STATISTICS and PHOTON_COUNTS; adds to the histogram of radii from which the
// next pass's grid is sized.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/subgroup.glsl"
#include "shared/ppm.h"

layout(push_constant, scalar) uniform PushBlock { UpdatePush push; };
layout(binding = PPM_BIND_STATISTICS, scalar) buffer Statistics { vec4 statistics[]; };
layout(binding = PPM_BIND_PHOTON_COUNTS, scalar) buffer PhotonCounts { uint photon_counts[]; };
layout(binding = PPM_BIND_GATHER_SUMS, scalar) buffer GatherSums { GatherSum gather_sums[]; };
layout(binding = PPM_BIND_RADIUS_HISTOGRAM, scalar) buffer RadiusHistogram { uint radius_histogram[]; };

// One addition for the invocations of the subgroup that share the lowest bin, which most do.
void count_radius(uint bin) {
  uint lowest = subgroup_min(bin);
  uint sharing = subgroup_sum(bin == lowest ? 1u : 0u);
  bool adds_all = lane() == 0u && lowest < PPM_RADIUS_BINS;
  if (adds_all) atomicAdd(radius_histogram[lowest], sharing);
  if (bin != lowest && bin < PPM_RADIUS_BINS) atomicAdd(radius_histogram[bin], 1u);
}

void main() {
  uint item = item_of_invocation(push.first);
  bool present = item < push.first + push.count;
  vec4 statistic = vec4(0.0);
  if (present) statistic = statistics[item];
  uint bin = PPM_RADIUS_BINS;       // none
  if (statistic.w > 0.0) {          // else light seen, not a hit point
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
    bin = radius_bin(statistic.w);
  }
  count_radius(bin);
}
