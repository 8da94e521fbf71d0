// Searches of nearest.comp that are too long to be shared, slice by slice: one invocation goes on with one search.
//
// A search that meets more than PPM_NEAREST_SLICE rows and photons leaves a cursor in CONTINUE_OUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/nearest.glsl"

layout(binding = PPM_BIND_CONTINUE_IN, scalar) readonly buffer ContinueIn { GatherCursor continue_in[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count || item >= counters[PPM_COUNTER_SEARCHES]) return;
  GatherCursor cursor = continue_in[item];
  begin_search(cursor.hit);
  CellBox box = cells_within(push.grid, hit_position, reach2);
  uint rows = row_count(box);
  uint budget = PPM_NEAREST_SLICE;
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
      uint found = photons_within(push.grid, row, hit_position, reach2, first, min(first + 32u, end));
      do {
        bool valid = found != 0u;
        count_photon(valid ? first + uint(findLSB(found)) : 0u, valid);
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
  add_to_search(cursor.hit);
}
