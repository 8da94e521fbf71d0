// The cell size that is chosen from a histogram of radii.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "photon_grid.hpp"
#include "shared/ppm.h"

namespace ppm::render {
namespace {

std::vector<std::uint32_t> histogram(std::initializer_list<std::pair<float, std::uint32_t>> radii) {
  std::vector<std::uint32_t> counts(PPM_RADIUS_BINS);
  for (const auto& [radius, count] : radii) counts[shared::radius_bin(radius * radius)] += count;
  return counts;
}

TEST(CellSize, NoneWithoutHitPoints) {
  EXPECT_EQ(cell_from_radii(histogram({})), 0.0f);
}

// A bin is a factor 2^(1/4) wide, so that sizes are right to 1.2.
TEST(CellSize, FollowsTheRadius) {
  const float one = cell_from_radii(histogram({{0.01f, 1000}}));
  EXPECT_GT(one, 0.01f);
  EXPECT_LT(one, 0.04f);
  for (const float scale : {0.001f, 0.1f, 32.0f}) {
    EXPECT_NEAR(cell_from_radii(histogram({{0.01f * scale, 7}})) / (one * scale), 1.0f, 0.2f);
  }
}

// A few large discs do not make everyone else's cells large, nor do a few small ones make them
// small; many of either do.
TEST(CellSize, WeighsFewAgainstMany) {
  const float small = cell_from_radii(histogram({{0.01f, 1000}}));
  const float large = cell_from_radii(histogram({{0.04f, 1000}}));
  const float few_large = cell_from_radii(histogram({{0.01f, 970}, {0.04f, 30}}));
  const float few_small = cell_from_radii(histogram({{0.01f, 5}, {0.04f, 995}}));
  EXPECT_LT(few_large, 1.5f * small);
  EXPECT_GT(few_small, large / 1.5f);
  const float half = cell_from_radii(histogram({{0.01f, 500}, {0.04f, 500}}));
  EXPECT_GE(half, few_large);
  EXPECT_LE(half, few_small);
}

}  // namespace
}  // namespace ppm::render
