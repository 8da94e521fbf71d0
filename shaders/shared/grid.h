// The photon hash grid: which cell a position lies in, and where the cell's photons are listed.
//
// Photons are sorted by table index (a counting sort). Rows of cells along x are contiguous in the
// table, dense or hashed, so that a search reads one range of photons a row. In a hashed table two
// rows of one search may overlap: a photon counts only in the row that its own position names.
#ifndef PPM_SHARED_GRID_H
#define PPM_SHARED_GRID_H

#include "shared/layout.h"

PPM_NAMESPACE_BEGIN

#define PPM_GRID_DENSE 0xffffffffu

// Cell coordinate along one axis, clamped to the grid.
PPM_FN uint grid_coordinate(float position, float origin, float inverse_cell, uint size) {
  PPM_PRECISE float cell = (position - origin) * inverse_cell;
  return uint(clamp(floor(cell), 0.0f, float(size - 1u)));
}

PPM_FN uvec3 grid_cell(GridConstants grid, vec3 position) {
  return uvec3(grid_coordinate(position.x, grid.origin.x, grid.inverse_cell, grid.size.x),
               grid_coordinate(position.y, grid.origin.y, grid.inverse_cell, grid.size.y),
               grid_coordinate(position.z, grid.origin.z, grid.inverse_cell, grid.size.z));
}

// Table index of the cell (0, y, z); the cell x of that row is x further on. A hashed table has
// table_mask + 1 + size.x entries, so that no row wraps around.
PPM_FN uint grid_row(GridConstants grid, uint y, uint z) {
  if (grid.table_mask == PPM_GRID_DENSE) {
    return grid.table_first + grid.size.x * (y + grid.size.y * z);
  }
  uint hash = (y * 0x9E3779B1u) ^ (z * 0x85EBCA77u);
  hash ^= hash >> 15u;
  hash *= 0x2C1B3C6Du;
  hash ^= hash >> 13u;
  return grid.table_first + (hash & grid.table_mask);
}

PPM_FN uint grid_table_index(GridConstants grid, uvec3 cell) {
  return grid_row(grid, cell.y, cell.z) + cell.x;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_GRID_H
