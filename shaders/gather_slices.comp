// Searches that are too long to be shared (gather.comp), slice by slice: one invocation goes on with one search.
//
// A search that meets more than PPM_GATHER_SLICE rows and photons leaves a cursor in CONTINUE_OUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/receiver.glsl"

layout(push_constant, scalar) uniform PushBlock { GatherPush push; };
layout(binding = PPM_BIND_CONTINUE_IN, scalar) readonly buffer ContinueIn { GatherCursor continue_in[]; };
layout(binding = PPM_BIND_CONTINUE_OUT, scalar) writeonly buffer ContinueOut { GatherCursor continue_out[]; };

void leave_cursor(uint hit, uint row, uint offset) {
  uint slot = atomicAdd(counters[PPM_COUNTER_CONTINUE], 1u);
  if (slot < push.cursor_capacity) continue_out[slot] = GatherCursor(hit, row, offset);
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count || item >= counters[PPM_COUNTER_SEARCHES]) return;
  GatherCursor cursor = continue_in[item];
  Receiver receiver = fetch_receiver(cursor.hit);
  float radius2 = fetch_radius2(cursor.hit);
  CellBox box = cells_within(push.grid, receiver.position, radius2);
  Sums sums = no_sums();
  uint rows = row_count(box);
  uint budget = PPM_GATHER_SLICE;
  uint offset = cursor.offset;
  for (uint row_index = cursor.row; row_index < rows; ++row_index) {
    if (budget == 0u) {
      leave_cursor(cursor.hit, row_index, offset);
      break;
    }
    budget -= 1u;
    CellRow row = cell_row(push.grid, box, row_index);
    uint begin = row.begin + offset;
    uint end = min(row.end, begin + budget);
    uint first = begin;
    do {
      uint found = photons_within(push.grid, row, receiver.position, radius2, first, min(first + 32u, end));
      do {
        bool valid = found != 0u;
        add_photon(receiver, PPM_FETCH(sorted_flux, valid ? first + uint(findLSB(found)) : 0u), valid, sums);
        found &= found - 1u;
      } while (found != 0u);
      first += 32u;
    } while (first < end);
    budget -= end - begin;
    if (end < row.end) {
      leave_cursor(cursor.hit, row_index, end - row.begin);
      break;
    }
    offset = 0u;
  }
  add_to_hit_point(cursor.hit, sums);
}
