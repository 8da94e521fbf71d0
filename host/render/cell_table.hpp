// A table of grid cells over a box: dense where it is small enough, else with its rows hashed.
#pragma once

#include <cstdint>

#include "shared/layout.h"

namespace ppm::render {

struct CellTable {
  shared::GridConstants constants;
  std::uint32_t entries;
};

/// Cells of about `cell` working units over [bounds_min, bounds_max]; rows are hashed into
/// `hashed_entries` (a power of two) where there would be more than dense_entries() cells.
CellTable cell_table(glm::vec3 bounds_min, glm::vec3 bounds_max, float cell,
                     std::uint32_t hashed_entries);

/// Entries of a table for that many items when its rows are hashed, a power of two.
std::uint32_t hashed_entries_for(std::uint64_t items);

/// Entries of the largest table that cell_table makes with up to `hashed_entries`.
std::uint64_t max_entries(std::uint32_t hashed_entries);

/// What such a table takes on the device: counts, starts, and what scanning them takes.
std::uint64_t table_bytes(std::uint64_t entries);

}  // namespace ppm::render
