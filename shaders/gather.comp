// The sums M(x) and tau_M(x) of [HOJ08 Eq. 11] over the photons in each hit point's disc.
//
// One invocation owns one hit point and adds to its GATHER_SUMS: integers, so that neither the order of photons nor
// their division into chunks matters. Hit points come in SEARCH_ORDER, so that those of a subgroup lie close together
// and search together. A search that is too long for this is left to gather_slices.comp by a cursor in CONTINUE_OUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/receiver.glsl"
#include "lib/shared_search.glsl"

layout(push_constant, scalar) uniform PushBlock { GatherPush push; };
PPM_TEXELS(PPM_BIND_SEARCH_ORDER, search_order);
layout(binding = PPM_BIND_CONTINUE_OUT, scalar) writeonly buffer ContinueOut { GatherCursor continue_out[]; };

Receiver receiver;
Sums sums;

void visit(uint photon, bool found) { add_photon(receiver, PPM_FETCH(sorted_flux, photon), found, sums); }

void main() {
  uint item = item_of_invocation(push.first);
  // Invocations beyond the end stay to help the others.
  bool waiting = item < push.first + push.count;
  uint order = waiting ? item : push.first;
  uint hit = PPM_FETCH(search_order, order >> 2u)[order & 3u];
  receiver = fetch_receiver(hit);
  sums = no_sums();
  if (search_together(push.grid, waiting, receiver.position, fetch_radius2(hit))) {
    sums = no_sums();
    uint slot = atomicAdd(counters[PPM_COUNTER_CONTINUE], 1u);
    if (slot < push.cursor_capacity) continue_out[slot] = GatherCursor(hit, 0u, 0u);
  }
  add_to_hit_point(hit, sums);
}
