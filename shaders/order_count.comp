// Search order, step 1: how many hit points each cell of a grid holds.
//
// One invocation a hit point; adds to CELL_COUNT (cleared before). Light seen is no hit point and is left out.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texels.glsl"
#include "shared/grid.h"

layout(push_constant, scalar) uniform PushBlock { GridPush push; };
PPM_TEXELS(PPM_BIND_HITS_0, hits_0);
PPM_TEXELS(PPM_BIND_HITS_1, hits_1);
layout(binding = PPM_BIND_CELL_COUNT, scalar) buffer CellCounts { uint cell_count[]; };

void main() {
  uint hit = item_of_invocation(push.first);
  if (hit >= push.first + push.count) return;
  if ((PPM_FETCH(hits_1, hit).w & PPM_HIT_EMISSION) != 0u) return;
  vec3 position = uintBitsToFloat(PPM_FETCH(hits_0, hit).xyz);
  atomicAdd(cell_count[grid_table_index(push.grid, grid_cell(push.grid, position))], 1u);
}
