// Photon grid, step 1 of 3: how many photons each cell holds.
//
// One invocation a photon; adds to CELL_COUNT (cleared before).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texels.glsl"
#include "shared/grid.h"

layout(push_constant, scalar) uniform PushBlock { GridPush push; };
PPM_TEXELS(PPM_BIND_PHOTON_POSITION, photon_position);
layout(binding = PPM_BIND_CELL_COUNT, scalar) buffer CellCounts { uint cell_count[]; };

void main() {
  uint photon = item_of_invocation(push.first);
  if (photon >= push.first + push.count) return;
  vec3 position = uintBitsToFloat(PPM_FETCH(photon_position, photon).xyz);
  atomicAdd(cell_count[grid_table_index(push.grid, grid_cell(push.grid, position))], 1u);
}
