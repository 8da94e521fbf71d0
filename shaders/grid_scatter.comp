// Photon grid, step 3 of 3: photons copied to their cell's place.
//
// One invocation a photon, one row of workgroups a pass of the batch. CELL_COUNT counts down to zero, which both hands
// out places (in arbitrary order within a cell: sums do not mind) and leaves it cleared for the next batch.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texels.glsl"
#include "shared/grid.h"

layout(push_constant, scalar) uniform PushBlock { GridPush push; };
layout(binding = PPM_BIND_BATCH, scalar) readonly buffer Batch { BatchWords batch; };
PPM_TEXELS(PPM_BIND_PHOTON_POSITION, photon_position);
PPM_TEXELS(PPM_BIND_PHOTON_FLUX, photon_flux);
layout(binding = PPM_BIND_CELL_COUNT, scalar) buffer CellCounts { uint cell_count[]; };
layout(binding = PPM_BIND_CELL_START, scalar) readonly buffer CellStarts { uint cell_start[]; };
layout(binding = PPM_BIND_SORTED_POSITION, scalar) writeonly buffer SortedPositions { uvec4 sorted_position[]; };
layout(binding = PPM_BIND_SORTED_FLUX, scalar) writeonly buffer SortedFluxes { uvec4 sorted_flux[]; };

void main() {
  uint pass = gl_WorkGroupID.y;
  uint item = item_of_invocation(push.first);
  if (item >= batch.sortable[pass]) return;
  uint photon = pass * push.photon_share + item;
  uvec4 position = PPM_FETCH(photon_position, photon);
  uint index = pass * push.entries + grid_table_index(push.grid, grid_cell(push.grid, uintBitsToFloat(position.xyz)));
  uint slot = cell_start[index] + atomicAdd(cell_count[index], 0xffffffffu) - 1u;
  sorted_position[slot] = position;
  sorted_flux[slot] = PPM_FETCH(photon_flux, photon);
}
