// Pilot pass: the initial radius of each hit point [HOJ08 section 4: "use the photon map to estimate the radius around
// each hit point"].
//
// Rounds of halving radii: whoever finds fewer than PPM_PILOT_ENOUGH times the wanted photons takes
// R^2 = r^2 * wanted / found of that round, the others go on to the next. One invocation a hit point, all of them or
// those in CONTINUE_IN; until it has its radius, STATISTICS.w holds the footprint squared, negated. A round depends on
// the set of photons alone, neither on their order nor on their division into chunks, so that radii do not either.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"
#include "lib/pilot.glsl"
#include "lib/search.glsl"
#include "shared/ppm.h"

// Whether the grid holds all photons, so that the round can be decided at once and those it does not decide be listed
// in CONTINUE_OUT. Otherwise what is found is added to GATHER_SUMS for pilot_decide.comp.
layout(constant_id = 0) const bool kDecide = false;

layout(push_constant, scalar) uniform PushBlock { PilotPush push; };
layout(binding = PPM_BIND_STATISTICS, scalar) buffer Statistics { vec4 statistics[]; };
layout(binding = PPM_BIND_GATHER_SUMS, scalar) buffer GatherSums { GatherSum gather_sums[]; };
layout(binding = PPM_BIND_CONTINUE_IN, scalar) readonly buffer ContinueIn { uint continue_in[]; };
layout(binding = PPM_BIND_CONTINUE_OUT, scalar) writeonly buffer ContinueOut { uint continue_out[]; };

struct Found {
  uint count;       // photons that count within the round's radius; no more than tell that there are enough
  uint candidates;  // photons in the cells around; above PPM_PILOT_CROWD it is too many to look at them
};

Found search(uint hit) {
  uvec4 plane0 = PPM_FETCH(hits_0, hit);
  vec3 position = uintBitsToFloat(plane0.xyz);
  vec3 normal = unpack_direction(plane0.w);
  uint flags = 0u;
  if (kLayers) flags = PPM_FETCH(hits_1, hit).w;
  float radius2 = square(push.radius);
  uint enough = PPM_PILOT_ENOUGH * push.wanted;
  CellBox box = cells_within(push.grid, position, radius2);
  Found found = Found(0u, 0u);
  uint rows = row_count(box);
  uint i = 0u;
  do {
    CellRow row = cell_row(push.grid, box, i);
    found.candidates += row.end - row.begin;
    if (found.candidates > PPM_PILOT_CROWD) row.end = row.begin;
    uint first = row.begin;
    do {
      uint nearby = photons_within(push.grid, row, position, radius2, first, min(first + 32u, row.end));
      do {
        bool valid = nearby != 0u;
        uvec4 flux = PPM_FETCH(sorted_flux, valid ? first + uint(findLSB(nearby)) : 0u);
        nearby &= nearby - 1u;
        bool counts = valid && accepts(normal, flags, flux.x, flux.y);
        found.count += counts ? 1u : 0u;
      } while (nearby != 0u);
      first += 32u;
    } while (first < row.end && found.count < enough);
  } while (++i < rows && found.count < enough && found.candidates <= PPM_PILOT_CROWD);
  return found;
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  uint hit = item;
  if (push.from_list != 0u) hit = continue_in[item];
  float mark = statistics[hit].w;
  if (mark >= 0.0) return;  // decided, or light seen
  Found found = search(hit);
  bool crowded = found.candidates > PPM_PILOT_CROWD;
  if (!kDecide) {
    gather_sums[hit].nearby += found.candidates;
    gather_sums[hit].count += found.count;
    return;
  }
  // In larger cells than the round's there may be too many photons where in its own there are not.
  if (crowded && push.coarse != 0u) {
    count_event(PPM_COUNTER_CROWDED);
    return;
  }
  float radius2 = radius2_from_round(push, mark, crowded || found.count >= PPM_PILOT_ENOUGH * push.wanted, found.count);
  if (radius2 > 0.0) {
    statistics[hit].w = radius2;
  } else {
    continue_out[atomicAdd(counters[PPM_COUNTER_UNDECIDED], 1u)] = hit;
  }
}
