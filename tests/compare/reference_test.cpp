// When a picture shows the same light as another.
#include "reference.hpp"

#include <gtest/gtest.h>

namespace ppm::compare {
namespace {

constexpr std::uint32_t kWidth = 20, kHeight = 12;  // 3 x 2 blocks, those at the edges smaller

std::vector<float> grey(float value) {
  return std::vector<float>(3 * kWidth * kHeight, value);
}

void fill(std::vector<float>& rgb, std::uint32_t x0, std::uint32_t y0, std::uint32_t x1,
          std::uint32_t y1, float value) {
  for (std::uint32_t y = y0; y < y1; ++y) {
    for (std::uint32_t x = 3 * x0; x < 3 * x1; ++x) rgb[3 * y * kWidth + x] = value;
  }
}

TEST(CompareReference, BlocksAreComparedByTheirMeans) {
  EXPECT_EQ(share_of_differing_blocks(grey(2.0f), grey(2.0f), kWidth), 0.0);
  EXPECT_EQ(share_of_differing_blocks(grey(2.0f), grey(1.85f), kWidth), 0.0);
  EXPECT_EQ(share_of_differing_blocks(grey(2.0f), grey(1.7f), kWidth), 1.0);
  EXPECT_EQ(share_of_differing_blocks(grey(1.7f), grey(2.0f), kWidth), 1.0);
  EXPECT_EQ(share_of_differing_blocks(grey(0.0f), grey(0.0f), kWidth), 0.0);
  // Noise within a block is none of its mean.
  std::vector<float> noisy = grey(0.0f);
  for (std::uint32_t x = 0; x < kWidth; x += 2) fill(noisy, x, 0, x + 1, kHeight, 2.0f);
  EXPECT_EQ(share_of_differing_blocks(noisy, grey(1.0f), kWidth), 0.0);
  // A caustic that one of them does not see, in the smallest block.
  std::vector<float> lit = grey(1.0f);
  fill(lit, 16, 8, 20, 12, 3.0f);
  EXPECT_DOUBLE_EQ(share_of_differing_blocks(lit, grey(1.0f), kWidth), 1.0 / 6.0);
  std::vector<float> broken = grey(1.0f);
  broken[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_GE(share_of_differing_blocks(broken, grey(1.0f), kWidth), 1.0 / 6.0);
}

}  // namespace
}  // namespace ppm::compare
