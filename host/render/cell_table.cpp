#include "cell_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "shared/grid.h"

namespace ppm::render {
namespace {

// Cells along one axis at most: a hashed table is that much longer than its power of two.
constexpr std::uint32_t kMaxAxis = 65536;
// A dense table may have this many entries: scanning a million costs some 10 ms on lavapipe.
constexpr std::uint64_t kDenseEntries = 1u << 20;

}  // namespace

CellTable cell_table(glm::vec3 bounds_min, glm::vec3 bounds_max, float cell,
                     std::uint32_t hashed_entries) {
  const glm::vec3 extent = bounds_max - bounds_min;
  const float largest = std::max({extent.x, extent.y, extent.z});
  cell = std::clamp(cell, largest / static_cast<float>(kMaxAxis - 1), std::max(largest, 1e-30f));
  const auto cells = [&](float length) {
    return static_cast<std::uint32_t>(
        std::clamp(std::floor(length / cell) + 1.0f, 1.0f, static_cast<float>(kMaxAxis)));
  };
  CellTable table{};
  table.constants.origin = bounds_min;
  table.constants.inverse_cell = 1.0f / cell;
  table.constants.size = {cells(extent.x), cells(extent.y), cells(extent.z)};
  const std::uint64_t dense =
      std::uint64_t{table.constants.size.x} * table.constants.size.y * table.constants.size.z;
  if (dense <= kDenseEntries) {
    table.constants.table_mask = PPM_GRID_DENSE;
    table.entries = static_cast<std::uint32_t>(dense);
  } else {
    table.constants.table_mask = hashed_entries - 1;
    table.entries = hashed_entries + table.constants.size.x;
  }
  return table;
}

std::uint32_t hashed_entries_for(std::uint64_t items) {
  return static_cast<std::uint32_t>(
      std::bit_ceil(std::clamp<std::uint64_t>(2 * items, 1u << 16, 1u << 22)));
}

std::uint64_t max_entries(std::uint32_t hashed_entries) {
  return std::max<std::uint64_t>(kDenseEntries, std::uint64_t{hashed_entries} + kMaxAxis);
}

std::uint64_t table_bytes(std::uint64_t entries) {
  const std::uint64_t chunks = entries / PPM_SCAN_CHUNK + 2;
  return sizeof(std::uint32_t) * (2 * entries + 2 + 2 * chunks);
}

}  // namespace ppm::render
