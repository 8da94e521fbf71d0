// Mutations of a chain's words: as many to either side, and the sizes that they are meant to have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shared/markov_chain.h"

namespace ppm::test {
namespace {

constexpr unsigned kDraws = 1u << 16;

// 65536 mutations, whose standard deviations are a share of 0.2 % of all.
TEST(MarkovChain, WordsMoveToEitherSideAlike) {
  const shared::RandomStream stream{3, 1, 0, 0};
  double up = 0.0, octaves[4] = {};
  for (unsigned i = 0; i < kDraws; ++i) {
    const glm::uvec4 words = shared::random_words(stream, i);
    const std::uint32_t moved = shared::mutate_word(words.x, words.y);
    const auto distance = static_cast<std::int32_t>(moved - words.x);
    const double size = std::abs(static_cast<double>(distance)) / 4294967296.0;
    ASSERT_GE(size, std::exp2(-10) * 0.999);
    ASSERT_LE(size, std::exp2(-6));
    up += distance > 0 ? 1.0 / kDraws : 0.0;
    octaves[std::clamp(static_cast<int>(std::log2(size) + 10.0), 0, 3)] += 1.0 / kDraws;
  }
  EXPECT_NEAR(up, 0.5, 0.01);
  for (const double share : octaves) EXPECT_NEAR(share, 0.25, 0.01);
}

// A proposal of four times the luminance is always accepted, one of a quarter in a quarter of all
// cases; expectations of both sides' weights balance.
TEST(MarkovChain, WeightsBalance) {
  EXPECT_EQ(shared::chain_acceptance(0.0f, 0.5f), 1.0f);
  EXPECT_EQ(shared::chain_acceptance(1.0f, 4.0f), 1.0f);
  EXPECT_EQ(shared::chain_acceptance(4.0f, 1.0f), 0.25f);
  EXPECT_EQ(shared::chain_weight(1.0f, 1.0f, 0.0f, 1.0f), 0.0f);
  // In equilibrium a state u of luminance I is the chain's with density I / b; of the mutations a
  // share p are large and propose it with density 1. Both count: I / b + p = 1 / weight.
  const double b = 0.7, luminance = 2.1;
  const double weight = static_cast<double>(
      shared::chain_weight(1.0f, 0.0f, static_cast<float>(luminance), static_cast<float>(b)));
  EXPECT_NEAR(weight * (luminance / b + 0.3), 1.0, 1e-6);
}

}  // namespace
}  // namespace ppm::test
