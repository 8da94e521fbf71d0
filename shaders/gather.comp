// The sums M(x) and tau_M(x) of [HOJ08 Eq. 11] over the photons in each hit point's disc.
//
// One invocation owns one hit point (or goes on with one search); it walks the cells its disc touches and adds to
// its GATHER_SUMS: integers, so that neither the order of photons nor their division into chunks matters.
// A search that meets more than PPM_GATHER_SLICE rows and photons leaves a cursor in CONTINUE_OUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"
#include "lib/search.glsl"
#include "shared/ppm.h"

layout(push_constant, scalar) uniform PushBlock { GatherPush push; };
layout(binding = PPM_BIND_SCENE_CONSTANTS, scalar) uniform SceneBlock { SceneConstants scene; };
PPM_TEXELS(PPM_BIND_HITS_2, hits_2);
PPM_TEXELS(PPM_BIND_HITS_3, hits_3);
PPM_TEXELS(PPM_BIND_STATISTICS, statistics);
layout(binding = PPM_BIND_GATHER_SUMS, scalar) buffer GatherSums { GatherSum gather_sums[]; };
layout(binding = PPM_BIND_CONTINUE_IN, scalar) readonly buffer ContinueIn { GatherCursor continue_in[]; };
layout(binding = PPM_BIND_CONTINUE_OUT, scalar) writeonly buffer ContinueOut { GatherCursor continue_out[]; };

// A hit point unpacked for evaluation.
struct Receiver {
  vec3 position;
  vec3 geometric_normal;
  vec3 shading_normal, tangent, bitangent;
  vec3 wo;               // local
  uint events;           // scattering events of its eye path
  Bsdf bsdf;
};

Receiver fetch_receiver(uint hit) {
  uvec4 plane0 = PPM_FETCH(hits_0, hit);
  uvec4 plane1 = PPM_FETCH(hits_1, hit);
  Receiver receiver;
  receiver.position = uintBitsToFloat(plane0.xyz);
  receiver.geometric_normal = unpack_direction(plane0.w);
  receiver.shading_normal = unpack_direction(plane1.x);
  tangent_frame(receiver.shading_normal, receiver.tangent, receiver.bitangent);
  vec3 outgoing = unpack_direction(plane1.y);
  receiver.wo = vec3(dot(outgoing, receiver.tangent), dot(outgoing, receiver.bitangent),
                     dot(outgoing, receiver.shading_normal));
  receiver.events = (plane1.w >> 8u) & 0xffu;
  receiver.bsdf = unpack_bsdf(PPM_FETCH(hits_3, hit), PPM_FETCH(hits_2, hit).w);
  return receiver;
}

// Lavapipe runs the code of every branch, with lanes masked off, and an atomic lane by lane: so events are counted
// in registers and told once a search.
struct Sums {
  uint count;
  Fixed64 red, green, blue;
  uint clamped, overflow;  // events
};

void add_term(inout Fixed64 sum, float term, inout uint overflow) {
  if (!(term >= 0.0 && term < PPM_FIXED_LIMIT)) {
    overflow += 1u;
    term = term > 0.0 ? PPM_FIXED_LIMIT * 0.5 : 0.0;
  }
  uint carry;
  sum = add_fixed(sum, to_fixed(term), carry);
  overflow += carry;
}

// f_r * flux of a photon within the disc [HOJ08 Eq. 11], if it counts there.
void add_photon(Receiver receiver, Photon photon, inout Sums sums) {
  if (!accepts_photon(receiver.geometric_normal, photon.incident, photon.normal)) return;
  if (scene.max_depth != 0u && photon.events + 1u + receiver.events > scene.max_depth) return;
  sums.count += 1u;
  vec3 wi = vec3(dot(photon.incident, receiver.tangent), dot(photon.incident, receiver.bitangent),
                 dot(photon.incident, receiver.shading_normal));
  float factor = merge_normal_factor(wi.z, dot(photon.incident, photon.normal));
  if (factor > PPM_MAX_NORMAL_FACTOR) {
    factor = PPM_MAX_NORMAL_FACTOR;
    sums.clamped += 1u;
  }
  precise vec3 term = bsdf_eval(receiver.bsdf, receiver.wo, wi) * photon.flux * factor;
  add_term(sums.red, term.x, sums.overflow);
  add_term(sums.green, term.y, sums.overflow);
  add_term(sums.blue, term.z, sums.overflow);
}

// Which of up to 32 photons lie in the disc, a bit each. Finding is cheap and adding dear, and invocations in step
// take as long as the one with most to do: apart, neither waits for the other.
uint photons_within(CellRow row, vec3 position, float radius2, uint first, uint last) {
  uint found = 0u;
  for (uint i = first; i < last; ++i) {
    vec3 photon_position = uintBitsToFloat(PPM_FETCH(sorted_position, i).xyz);
    if (within(push.grid, row, position, photon_position, radius2)) found |= 1u << (i - first);
  }
  return found;
}

void leave_cursor(uint hit, uint row, uint offset) {
  uint slot = atomicAdd(counters[PPM_COUNTER_CONTINUE], 1u);
  if (slot < push.cursor_capacity) continue_out[slot] = GatherCursor(hit, row, offset);
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  GatherCursor cursor = GatherCursor(item, 0u, 0u);
  if (push.from_cursors != 0u) cursor = continue_in[item];
  uint hit = cursor.hit;
  float radius2 = uintBitsToFloat(PPM_FETCH(statistics, PPM_FETCH(hits_1, hit).z).w);
  if (radius2 <= 0.0) return;  // light seen, not a hit point

  vec3 position = uintBitsToFloat(PPM_FETCH(hits_0, hit).xyz);
  CellBox box = cells_within(push.grid, position, radius2);
  Receiver receiver = fetch_receiver(hit);
  Sums sums = Sums(0u, Fixed64(0u, 0u), Fixed64(0u, 0u), Fixed64(0u, 0u), 0u, 0u);
  uint rows = row_count(box);
  uint budget = PPM_GATHER_SLICE;
  uint offset = cursor.offset;
  for (uint row_index = cursor.row; row_index < rows; ++row_index) {
    if (budget == 0u) {
      leave_cursor(hit, row_index, offset);
      break;
    }
    budget -= 1u;
    CellRow row = cell_row(push.grid, box, row_index);
    uint begin = row.begin + offset;
    uint end = min(row.end, begin + budget);
    for (uint first = begin; first < end; first += 32u) {
      uint found = photons_within(row, position, radius2, first, min(first + 32u, end));
      while (found != 0u) {
        uint i = first + uint(findLSB(found));
        found &= found - 1u;
        add_photon(receiver, unpack_photon(PPM_FETCH(sorted_position, i), PPM_FETCH(sorted_flux, i)), sums);
      }
    }
    budget -= end - begin;
    if (end < row.end) {
      leave_cursor(hit, row_index, end - row.begin);
      break;
    }
    offset = 0u;
  }
  if (sums.count == 0u) return;
  GatherSum total = gather_sums[hit];
  uint carry0, carry1, carry2;
  Fixed64 red = add_fixed(Fixed64(total.flux[0], total.flux[1]), sums.red, carry0);
  Fixed64 green = add_fixed(Fixed64(total.flux[2], total.flux[3]), sums.green, carry1);
  Fixed64 blue = add_fixed(Fixed64(total.flux[4], total.flux[5]), sums.blue, carry2);
  sums.overflow += carry0 + carry1 + carry2;
  if (sums.overflow != 0u) atomicAdd(counters[PPM_COUNTER_OVERFLOW], sums.overflow);
  if (sums.clamped != 0u) atomicAdd(counters[PPM_COUNTER_CLAMPED], sums.clamped);
  total.count += sums.count;
  total.flux = uint[6](red.low, red.high, green.low, green.high, blue.low, blue.high);
  gather_sums[hit] = total;
}
