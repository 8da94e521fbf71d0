// Search order, step 3 (step 2 is the scan): hit points listed by cell.
//
// One invocation a hit point; writes SEARCH_ORDER. CELL_COUNT counts down to zero. The order within a cell is
// arbitrary: it decides which searches share their work, never what they find.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texels.glsl"
#include "shared/grid.h"

layout(push_constant, scalar) uniform PushBlock { GridPush push; };
PPM_TEXELS(PPM_BIND_HITS_0, hits_0);
PPM_TEXELS(PPM_BIND_HITS_1, hits_1);
layout(binding = PPM_BIND_CELL_COUNT, scalar) buffer CellCounts { uint cell_count[]; };
layout(binding = PPM_BIND_CELL_START, scalar) readonly buffer CellStarts { uint cell_start[]; };
layout(binding = PPM_BIND_SEARCH_ORDER, scalar) writeonly buffer SearchOrder { uint search_order[]; };

void main() {
  uint hit = item_of_invocation(push.first);
  if (hit >= push.first + push.count) return;
  if ((PPM_FETCH(hits_1, hit).w & PPM_HIT_EMISSION) != 0u) return;
  vec3 position = uintBitsToFloat(PPM_FETCH(hits_0, hit).xyz);
  uint index = grid_table_index(push.grid, grid_cell(push.grid, position));
  search_order[cell_start[index] + atomicAdd(cell_count[index], 0xffffffffu) - 1u] = hit;
}
