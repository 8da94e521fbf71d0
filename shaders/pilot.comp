// The initial radius of each hit point from a discarded pilot pass [HOJ08 section 4: "use the photon map to estimate the
// radius around each hit point"].
//
// Rounds of halving radii: whoever finds fewer than four times the wanted photons takes R^2 = r^2 * wanted / found
// of that round, the others go on to the next. One invocation a hit point. Until it has its radius, STATISTICS.w holds
// the footprint squared, negated. How far a search goes depends on the set of photons alone, not on their order.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"
#include "lib/search.glsl"
#include "shared/ppm.h"

layout(push_constant, scalar) uniform PushBlock { PilotPush push; };
layout(binding = PPM_BIND_STATISTICS, scalar) buffer Statistics { vec4 statistics[]; };

// Photons that count within the round's radius, at most `enough`; `enough` too where looking would take too long.
uint count_photons(uint hit, uint enough) {
  uvec4 plane0 = PPM_FETCH(hits_0, hit);
  vec3 position = uintBitsToFloat(plane0.xyz);
  vec3 normal = unpack_direction(plane0.w);
  float radius2 = push.radius * push.radius;
  CellBox box = cells_within(push.grid, position, radius2);
  uint rows = row_count(box);
  uint candidates = 0u;
  for (uint i = 0u; i < rows; ++i) {
    CellRow row = cell_row(push.grid, box, i);
    candidates += row.end - row.begin;
  }
  if (candidates > PPM_GATHER_SLICE) return enough;
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
  return found;
}

void main() {
  uint hit = item_of_invocation(push.first);
  if (hit >= push.first + push.count) return;
  vec4 statistic = statistics[hit];
  if (statistic.w >= 0.0) return;  // decided, or light seen
  float least = square(push.footprints_min) * -statistic.w;
  float most = square(push.round_index == 0u ? push.radius : 2.0 * push.radius);
  uint enough = 4u * push.wanted;
  uint found = count_photons(hit, enough);
  if (found >= enough && push.last_round == 0u && push.radius * push.radius > least) {
    count_event(PPM_COUNTER_UNDECIDED);
    return;
  }
  // Fewer than wanted in the first round: the largest radius there is.
  float radius2 = push.radius * push.radius * float(push.wanted) / float(max(found, 1u));
  statistic.w = clamp(radius2, min(least, most), most);
  statistics[hit] = statistic;
}
