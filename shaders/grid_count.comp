// Photon grid, step 1 of 3: how many photons each cell holds.
//
// One invocation a photon, one row of workgroups a pass of the batch; adds to CELL_COUNT (cleared before).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texels.glsl"
#include "shared/grid.h"

layout(push_constant, scalar) uniform PushBlock { GridPush push; };
layout(binding = PPM_BIND_BATCH, scalar) readonly buffer Batch { BatchWords batch; };
PPM_TEXELS(PPM_BIND_PHOTON_POSITION, photon_position);
layout(binding = PPM_BIND_CELL_COUNT, scalar) buffer CellCounts { uint cell_count[]; };

void main() {
  uint pass = gl_WorkGroupID.y;
  uint item = item_of_invocation(push.first);
  if (item >= batch.sortable[pass]) return;
  uint photon = pass * push.photon_share + item;
  vec3 position = uintBitsToFloat(PPM_FETCH(photon_position, photon).xyz);
  uint index = grid_table_index(push.grid, grid_cell(push.grid, position));
  atomicAdd(cell_count[pass * push.entries + index], 1u);
}
