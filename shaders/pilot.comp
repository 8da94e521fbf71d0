// Pilot pass, step 1 of 2: how many photons lie in reach of each hit point that has no radius yet.
//
// One invocation a hit point; adds to its GATHER_SUMS the photons that count within the round's radius (no more than
// are needed to know that there are enough) and, as `nearby`, those in the cells around. Both sums depend on the set of
// photons alone, neither on their order nor on their division into chunks, so that radii do not either.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/search.glsl"
#include "shared/ppm.h"

layout(push_constant, scalar) uniform PushBlock { PilotPush push; };
PPM_TEXELS(PPM_BIND_STATISTICS, statistics);
layout(binding = PPM_BIND_GATHER_SUMS, scalar) buffer GatherSums { GatherSum gather_sums[]; };

void main() {
  uint hit = item_of_invocation(push.first);
  if (hit >= push.first + push.count) return;
  if (uintBitsToFloat(PPM_FETCH(statistics, hit).w) >= 0.0) return;  // decided, or light seen

  uvec4 plane0 = PPM_FETCH(hits_0, hit);
  vec3 position = uintBitsToFloat(plane0.xyz);
  vec3 normal = unpack_direction(plane0.w);
  float radius2 = square(push.radius);
  CellBox box = cells_within(push.grid, position, radius2);
  uint rows = row_count(box);
  uint candidates = 0u;
  for (uint i = 0u; i < rows; ++i) {
    CellRow row = cell_row(push.grid, box, i);
    candidates += row.end - row.begin;
  }
  gather_sums[hit].nearby += candidates;
  if (candidates > PPM_GATHER_SLICE) return;  // too many to look at: enough, see pilot_decide

  uint enough = PPM_PILOT_ENOUGH * push.wanted;
  uint found = 0u;
  for (uint i = 0u; i < rows && found < enough; ++i) {
    CellRow row = cell_row(push.grid, box, i);
    for (uint j = row.begin; j < row.end && found < enough; ++j) {
      uvec4 photon_position = PPM_FETCH(sorted_position, j);
      if (!within(push.grid, row, position, uintBitsToFloat(photon_position.xyz), radius2)) continue;
      if (accepts_photon(normal, unpack_direction(photon_position.w),
                         unpack_direction(PPM_FETCH(sorted_flux, j).w))) {
        found += 1u;
      }
    }
  }
  gather_sums[hit].count += found;
}
