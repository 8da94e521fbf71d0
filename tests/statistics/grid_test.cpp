// shared/grid.h: cells and table indices stay where they belong.
#include "shared/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "chi_squared.hpp"

namespace ppm::shared {
namespace {

using glm::dvec3;
using statistics::Units;

GridConstants grid_of(uvec3 size, uint table_mask) {
  GridConstants grid{};
  grid.origin = vec3(-0.75f, -0.5f, 0.125f);
  grid.inverse_cell = 16.0f;
  grid.size = size;
  grid.table_mask = table_mask;
  return grid;
}

// A power of two as cell edge: the cell is exact unless the subtraction rounds, and positions
// within a rounding of a plane may go either way.
TEST(GridCell, HoldsItsPositions) {
  const GridConstants grid = grid_of({20, 13, 7}, PPM_GRID_DENSE);
  Units units(71);
  for (int i = 0; i < 100000; ++i) {
    const vec3 unit = units.next3();
    const vec3 position = grid.origin + unit * vec3(grid.size) / grid.inverse_cell;
    const uvec3 cell = grid_cell(grid, position);
    const dvec3 exact = (dvec3(position) - dvec3(grid.origin)) * double(grid.inverse_cell);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LT(cell[axis], grid.size[axis]);
      if (exact[axis] >= grid.size[axis]) continue;
      ASSERT_GE(exact[axis], cell[axis] - 1e-5);
      ASSERT_LE(exact[axis], cell[axis] + 1.0 + 1e-5);
    }
  }
}

// A disc may reach beyond the grid, and a position may be anywhere.
TEST(GridCell, ClampsWhatLiesOutside) {
  const GridConstants grid = grid_of({20, 13, 7}, PPM_GRID_DENSE);
  for (const float far : {1e-3f, 1.0f, 1e10f, std::numeric_limits<float>::max()}) {
    EXPECT_EQ(grid_cell(grid, grid.origin - vec3(far)), uvec3(0u));
    EXPECT_EQ(grid_cell(grid, grid.origin + vec3(2.0f + far)), grid.size - uvec3(1u));
  }
  EXPECT_EQ(grid_cell(grid, grid.origin), uvec3(0u));
  const GridConstants single = grid_of({1, 1, 1}, PPM_GRID_DENSE);
  EXPECT_EQ(grid_cell(single, vec3(0.3f)), uvec3(0u));
}

// A cell's neighbour in position is never further than its neighbour in number: a search that takes
// all cells between two clamped corners misses none.
TEST(GridCell, IsMonotonic) {
  const GridConstants grid = grid_of({300, 1, 1}, PPM_GRID_DENSE);
  uint previous = 0;
  for (int i = -1000; i < 30000; ++i) {
    const vec3 position = grid.origin + vec3(static_cast<float>(i) * 1e-3f, 0.0f, 0.0f);
    const uint cell = grid_cell(grid, position).x;
    ASSERT_GE(cell, previous);
    ASSERT_LE(cell, previous + 1u);
    previous = cell;
  }
  EXPECT_EQ(previous, 299u);
}

TEST(GridTable, DenseIndexIsABijection) {
  const GridConstants grid = grid_of({5, 3, 4}, PPM_GRID_DENSE);
  std::vector<int> hits(60, 0);
  for (uint z = 0; z < 4; ++z) {
    for (uint y = 0; y < 3; ++y) {
      for (uint x = 0; x < 5; ++x) {
        const uint index = grid_table_index(grid, {x, y, z});
        ASSERT_LT(index, 60u);
        ++hits[index];
        EXPECT_EQ(index, grid_row(grid, y, z) + x);
      }
    }
  }
  for (const int hit : hits) EXPECT_EQ(hit, 1);
}

// A hashed row starts within the table; its cells run on, at most to table_mask + size.x.
TEST(GridTable, HashedIndexStaysWithinTheTable) {
  for (const uint mask : {0u, 1u, 15u, 1023u, (1u << 22u) - 1u}) {
    const GridConstants grid = grid_of({1000, 4000, 4000}, mask);
    Units units(72);
    for (int i = 0; i < 20000; ++i) {
      const uvec3 cell = units.next3() * vec3(grid.size);
      ASSERT_LE(grid_row(grid, cell.y, cell.z), mask);
      ASSERT_EQ(grid_table_index(grid, cell), grid_row(grid, cell.y, cell.z) + cell.x);
      ASSERT_LE(grid_table_index(grid, cell), mask + grid.size.x - 1u);
    }
  }
}

// Rows of flat and of upright walls alike spread over the table: by chance they would take
// 1 - 1/e = 63% of as many places; far fewer would make searches slow.
TEST(GridTable, HashSpreadsTheRows) {
  const uint rows = 1u << 14u;
  const GridConstants grid = grid_of({8, rows, rows}, rows - 1u);
  for (const uint shape : {0u, 7u, 14u}) {  // rows x 1, 128 x 128, 1 x rows
    std::vector<char> taken(rows, 0);
    for (uint i = 0; i < rows; ++i) taken[grid_row(grid, i & ((1u << shape) - 1u), i >> shape)] = 1;
    double places = 0.0;
    for (const char place : taken) places += place;
    EXPECT_GT(places, 0.55 * rows) << shape;
  }
}

}  // namespace
}  // namespace ppm::shared
