// Photon map: a round of the search for each hit point's n-th nearest photon (shared/nearest.h), among the photons of
// one grid.
//
// One invocation a hit point of the list in SEARCH_ORDER, in an order that keeps neighbours together, so that those of
// a subgroup search together; adds to its NEAREST. A search that is too long for this is left to nearest_slices.comp
// by a cursor in CONTINUE_OUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/nearest.glsl"

#define PPM_IN_REACH(distance2, radius2) ((distance2) <= (radius2) && (distance2) >= least_distance2)
#include "lib/shared_search.glsl"

PPM_TEXELS(PPM_BIND_SEARCH_ORDER, search_list);

void visit(uint photon, bool found) { count_photon(photon, found); }

void main() {
  uint item = item_of_invocation(push.first);
  // Invocations beyond the end stay to help the others.
  bool present = item < push.first + push.count;
  uint place = present ? item : push.first;
  uint hit = PPM_FETCH(search_list, place >> 2u)[place & 3u];
  begin_search(hit);
  bool too_long = search_together(push.grid, present, hit_position, reach2);
  if (!present) return;
  if (too_long) {
    leave_cursor(hit, 0u, 0u);
  } else {
    add_to_search(hit);
  }
}
