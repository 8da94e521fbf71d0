// Hit points as the searches read them, and the box of grid cells that a disc touches.
#ifndef PPM_LIB_SEARCH_GLSL
#define PPM_LIB_SEARCH_GLSL

#include "lib/scene_kinds.glsl"
#include "lib/texels.glsl"
#include "shared/bsdf.h"
#include "shared/grid.h"
#include "shared/photon.h"

PPM_TEXELS(PPM_BIND_HITS_0, hits_0);
PPM_TEXELS(PPM_BIND_HITS_1, hits_1);
PPM_TEXELS(PPM_BIND_SORTED_POSITION, sorted_position);
PPM_TEXELS(PPM_BIND_SORTED_FLUX, sorted_flux);
PPM_TEXELS(PPM_BIND_CELL_START, cell_starts);

uint cell_start(uint index) { return PPM_FETCH(cell_starts, index >> 2u)[index & 3u]; }

// The cells that a disc's bounding cube touches.
struct CellBox {
  uvec3 low, high;  // both inclusive
};

CellBox cells_within(GridConstants grid, vec3 position, float radius2) {
  // Square root and division are not rounded correctly everywhere: a little more never hurts.
  float radius = sqrt(radius2) * (1.0 + 9.5367431640625e-7) + 1.2e-7;
  return CellBox(grid_cell(grid, position - vec3(radius)), grid_cell(grid, position + vec3(radius)));
}

uint row_count(CellBox box) { return (box.high.y - box.low.y + 1u) * (box.high.z - box.low.z + 1u); }

// One row of a box: its cells' photons.
struct CellRow {
  uint y, z;
  uint begin, end;  // in sorted order
};

CellRow cell_row_at(GridConstants grid, CellBox box, uint y, uint z) {
  uint base = grid_row(grid, y, z);
  return CellRow(y, z, cell_start(base + box.low.x), cell_start(base + box.high.x + 1u));
}

CellRow cell_row(GridConstants grid, CellBox box, uint row) {
  uint rows_y = box.high.y - box.low.y + 1u;
  return cell_row_at(grid, box, box.low.y + row % rows_y, box.low.z + row / rows_y);
}

// The same for rows below 2^20: lavapipe divides integers lane by lane. Halfway between two row numbers the quotient's
// rounding error cannot reach the next integer.
CellRow cell_row_of_few(GridConstants grid, CellBox box, uint row) {
  uint rows_y = box.high.y - box.low.y + 1u;
  uint z = uint((float(row) + 0.5) / float(rows_y));
  return cell_row_at(grid, box, box.low.y + row - z * rows_y, box.low.z + z);
}

// Without contraction: all kernels must find the same, and so must the host in tests.
float squared_distance(vec3 a, vec3 b) {
  precise vec3 offset = a - b;
  precise float distance2 = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
  return distance2;
}

// Whether a photon lies in the disc's ball, counted in the one row that its own position names: rows of a
// hashed table may overlap.
bool within(GridConstants grid, CellRow row, vec3 position, vec3 photon_position, float radius2) {
  if (squared_distance(photon_position, position) > radius2) return false;
  if (grid.table_mask == PPM_GRID_DENSE) return true;
  uvec3 cell = grid_cell(grid, photon_position);
  return cell.y == row.y && cell.z == row.z;
}

// Which of up to 32 photons lie in the disc, a bit each. Finding is cheap and adding dear, and invocations in step
// take as long as the one with most to do: apart, neither waits for the other.
uint photons_within(GridConstants grid, CellRow row, vec3 position, float radius2, uint first, uint last) {
  uint found = 0u;
  uint i = first;
  do {  // tested at its end, as all loops of searches: lavapipe runs the body of another once more, with no lane in it
    bool valid = i < last;
    vec3 photon_position = uintBitsToFloat(PPM_FETCH(sorted_position, valid ? i : 0u).xyz);
    bool found_it = valid && within(grid, row, position, photon_position, radius2);
    found |= found_it ? 1u << (i - first) : 0u;
  } while (++i < last);
  return found;
}

// Whether a photon of a hit point's disc counts there. packed: two words of the photon's plane SORTED_FLUX.
bool accepts(vec3 hit_normal, uint hit_flags, uint packed_incident, uint packed_normal) {
  if (kLayers) return accepts_packed_photon_of_layers(hit_normal, hit_flags, packed_incident, packed_normal);
  return accepts_packed_photon(hit_normal, packed_incident, packed_normal);
}

// Scattering events that a photon may have had to count at a hit point with these flags. max_depth: of SceneConstants.
int most_photon_events(uint max_depth, uint hit_flags) {
  return max_depth == 0u ? 0x7fffffff : int(max_depth) - int((hit_flags >> 8u) & 0xffu) - 1;
}

#endif
