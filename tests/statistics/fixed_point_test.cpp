// shared/ppm.h: sums that do not depend on their order, and the bins of radii.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "chi_squared.hpp"
#include "shared/ppm.h"

namespace ppm::shared {
namespace {

using statistics::Units;

std::uint64_t bits(Fixed64 x) {
  return (std::uint64_t{x.high} << 32u) | x.low;
}
Fixed64 from_bits(std::uint64_t x) {
  return {static_cast<uint>(x), static_cast<uint>(x >> 32u)};
}

// From 2^-8 on all of a float's 24 bits fit above 2^-32; below, half a unit may be lost.
TEST(ToFixed, RoundsToTheNearest) {
  Units units(51);
  for (int i = 0; i < 2000000; ++i) {
    const float x = std::ldexp(1.0f + units.next(), static_cast<int>(units.between(-40.0, 31.0)));
    if (!(x < PPM_FIXED_LIMIT)) continue;
    const double error =
        std::abs(std::ldexp(static_cast<double>(x), 32) - static_cast<double>(bits(to_fixed(x))));
    // The difference is exact: both numbers have at most 53 bits.
    ASSERT_LE(error, x >= 0x1p-9f ? 0.0 : 0.5) << x;
  }
}

TEST(ToFixed, KeepsItsLimits) {
  EXPECT_EQ(bits(to_fixed(0.0f)), 0u);
  EXPECT_EQ(bits(to_fixed(1.0f)), std::uint64_t{1} << 32u);
  EXPECT_EQ(bits(to_fixed(0x1p-32f)), 1u);
  EXPECT_EQ(bits(to_fixed(0x1p-33f * 0.99f)), 0u);
  EXPECT_EQ(bits(to_fixed(0x1p-40f)), 0u);
  EXPECT_EQ(bits(to_fixed(1.0f - 0x1p-24f)), (std::uint64_t{1} << 32u) - 256u);
  const float last = std::nextafter(PPM_FIXED_LIMIT, 0.0f);
  EXPECT_EQ(bits(to_fixed(last)), std::uint64_t{2147483520} << 32u);
  // Odd units where a float's steps are whole units: nothing to round.
  EXPECT_EQ(bits(to_fixed(8388609.0f * 0x1p-32f)), 8388609u);
  EXPECT_EQ(bits(to_fixed(16777215.0f * 0x1p-32f)), 16777215u);
}

TEST(FromFixed, UndoesToFixed) {
  Units units(52);
  for (int i = 0; i < 1000000; ++i) {
    const float x = std::ldexp(1.0f + units.next(), static_cast<int>(units.between(-8.0, 31.0)));
    if (!(x < PPM_FIXED_LIMIT)) continue;
    ASSERT_EQ(from_fixed(to_fixed(x)), x);
  }
}

// Both words are rounded to floats, and so is their sum: three roundings at most.
TEST(FromFixed, IsNearestToThreeRoundings) {
  std::mt19937_64 random(53);
  for (int i = 0; i < 1000000; ++i) {
    const std::uint64_t value = random() >> (random() % 64u);
    const double exact = std::ldexp(static_cast<double>(value), -32);
    ASSERT_NEAR(from_fixed(from_bits(value)), exact, exact * 3.0 * 0x1p-24);
  }
}

TEST(AddFixed, CarriesAndTellsOfOverflow) {
  std::mt19937_64 random(54);
  std::vector<std::uint64_t> edges{0u,
                                   1u,
                                   0xffffffffu,
                                   0x100000000u,
                                   0xffffffff00000000u,
                                   0xfffffffeffffffffu,
                                   0xffffffffffffffffu};
  for (int i = 0; i < 1000; ++i) edges.push_back(random() >> (random() % 64u));
  for (const std::uint64_t a : edges) {
    for (const std::uint64_t b : edges) {
      uint carry = 7u;
      const Fixed64 sum = add_fixed(from_bits(a), from_bits(b), carry);
      ASSERT_EQ(bits(sum), a + b) << a << " + " << b;
      ASSERT_EQ(carry, a + b < a ? 1u : 0u) << a << " + " << b;
    }
  }
}

// However the photons are ordered or shared out among partial sums.
TEST(AddFixed, SumsDoNotDependOnOrderOrPartition) {
  Units units(55);
  std::vector<float> terms;
  double exact = 0.0;
  for (int i = 0; i < 20000; ++i) {
    terms.push_back(units.next() * std::exp2(-30.0f * units.next()));
    exact += terms.back();
  }
  const auto sum = [](const std::vector<float>& values, std::size_t parts) {
    std::vector<Fixed64> partial(parts, Fixed64{0u, 0u});
    uint carry;
    for (std::size_t i = 0; i < values.size(); ++i) {
      Fixed64& part = partial[i % parts];
      part = add_fixed(part, to_fixed(values[i]), carry);
    }
    Fixed64 whole{0u, 0u};
    for (const Fixed64& part : partial) whole = add_fixed(whole, part, carry);
    return bits(whole);
  };
  const std::uint64_t first = sum(terms, 1);
  EXPECT_NEAR(std::ldexp(static_cast<double>(first), -32), exact, 20000 * 0x1p-33);
  std::mt19937 shuffler(56);
  for (const std::size_t parts : {1u, 2u, 7u, 64u}) {
    std::shuffle(terms.begin(), terms.end(), shuffler);
    EXPECT_EQ(sum(terms, parts), first) << parts;
  }
}

// Bin b holds R^2 from 2^-64 times 2^(b/2), or times 1.5 where b is odd, to the next one's edge.
TEST(RadiusBin, HasItsEdges) {
  for (int b = 0; b < PPM_RADIUS_BINS; ++b) {
    const float edge = std::ldexp(b % 2 == 0 ? 1.0f : 1.5f, b / 2 - 64);
    EXPECT_EQ(radius_bin(edge), static_cast<uint>(b));
    const float below = std::nextafter(edge, 0.0f);
    EXPECT_EQ(radius_bin(below), static_cast<uint>(std::max(b - 1, 0)));
  }
  EXPECT_EQ(radius_bin(0.0f), 0u);
  EXPECT_EQ(radius_bin(std::numeric_limits<float>::denorm_min()), 0u);
  EXPECT_EQ(radius_bin(std::numeric_limits<float>::max()), uint{PPM_RADIUS_BINS} - 1u);
}

}  // namespace
}  // namespace ppm::shared
