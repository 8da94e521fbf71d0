// shared/random.h: the generator's known answers, and what is made of its words.
#include "shared/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "chi_squared.hpp"

namespace ppm::shared {
namespace {

using statistics::expect_counts;
using statistics::expect_plausible;

// File kat_vectors of the authors' library Random123, lines "philox4x32 10".
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox_4x32_10(uvec4(0u), uvec2(0u)),
            uvec4(0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u));
  EXPECT_EQ(philox_4x32_10(uvec4(0xffffffffu), uvec2(0xffffffffu)),
            uvec4(0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu));
  EXPECT_EQ(philox_4x32_10(uvec4(0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u),
                           uvec2(0xa4093822u, 0x299f31d0u)),
            uvec4(0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u));
}

// Every part of a decision's name counts: among 1152 names no word comes twice (by chance once in
// 400 seeds).
TEST(RandomWords, DifferInEveryPartOfTheName) {
  std::set<uint> words;
  for (uint name = 0; name < 1152; ++name) {
    const RandomStream stream{name % 3u, 1u + name / 3u % 3u, name / 9u % 4u, name / 36u % 8u};
    const uvec4 drawn = random_words(stream, name / 288u);
    for (int i = 0; i < 4; ++i) words.insert(drawn[i]);
  }
  EXPECT_EQ(words.size(), 4u * 1152u);
}

TEST(RandomUnit, StaysWithinItsInterval) {
  EXPECT_EQ(unit_from_word(0u), 0.0f);
  EXPECT_EQ(unit_from_word(0x80000000u), 0.5f);
  EXPECT_EQ(unit_from_word(0xffffffffu), 1.0f - 0x1p-24f);
  EXPECT_LT(unit_from_word(0x7fffffffu), unit_from_word(0x80000000u));
  const RandomStream stream{5u, PPM_STREAM_EYE, 2u, 77u};
  const uvec4 words = random_words(stream, 3u);
  const vec4 units = random_units(stream, 3u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(units[i], unit_from_word(words[i]));
}

using NameOf = std::function<RandomStream(uint)>;

struct Walk {
  const char* name;
  NameOf at;
};

// The ways in which a renderer walks through names.
const std::array<Walk, 4> kWalks{{
    {"path",
     [](uint i) {
       return RandomStream{0u, PPM_STREAM_PHOTON, 0u, i};
     }},
    {"pass",
     [](uint i) {
       return RandomStream{0u, PPM_STREAM_PHOTON, i, 0u};
     }},
    {"seed",
     [](uint i) {
       return RandomStream{i, PPM_STREAM_EYE, 0u, 0u};
     }},
    {"path in strides",
     [](uint i) {
       return RandomStream{7u, PPM_STREAM_PILOT, 1u, i << 12u};
     }},
}};
constexpr uint kDraws = 1u << 18u;

TEST(RandomUnits, AreEquidistributedInEveryDimension) {
  for (const Walk& walk : kWalks) {
    std::array<std::vector<double>, 4> observed;
    observed.fill(std::vector<double>(256, 0.0));
    for (uint i = 0; i < kDraws; ++i) {
      const vec4 u = random_units(walk.at(i), 0u);
      for (int k = 0; k < 4; ++k) {
        ++observed[static_cast<std::size_t>(k)][static_cast<std::size_t>(u[k] * 256.0f)];
      }
    }
    for (const std::vector<double>& counts : observed) {
      expect_counts(counts, std::vector<double>(256, kDraws / 256.0), walk.name);
    }
  }
}

// The low bits too, which the units drop or hold in their last digits.
TEST(RandomWords, LowBitsAreEquidistributed) {
  std::vector<double> observed(256, 0.0);
  for (uint i = 0; i < kDraws; ++i) ++observed[random_words(kWalks[0].at(i), 1u).w & 0xffu];
  expect_counts(observed, std::vector<double>(256, kDraws / 256.0), "low byte");
}

struct Pair {
  const char* name;
  std::function<vec2(uint)> at;
};

vec2 pair_of(RandomStream a, RandomStream b, uint block_a = 0u, uint block_b = 0u) {
  return {random_units(a, block_a).x, random_units(b, block_b).x};
}

// Neighbours in name. Correlation of n independent pairs is normal with variance 1 / n; the joint
// counts on 16 x 16 squares see other ties than linear ones.
TEST(RandomUnits, NeighboursAreIndependent) {
  using S = RandomStream;
  const std::vector<Pair> pairs{
      {"dimensions x, y",
       [](uint i) {
         const vec4 u = random_units(S{0u, 1u, 0u, i}, 0u);
         return vec2(u.x, u.y);
       }},
      {"dimensions z, w",
       [](uint i) {
         const vec4 u = random_units(S{0u, 1u, 0u, i}, 0u);
         return vec2(u.z, u.w);
       }},
      {"blocks",
       [](uint i) {
         return pair_of(S{0u, 1u, 0u, i}, S{0u, 1u, 0u, i}, 0u, 1u);
       }},
      {"paths",
       [](uint i) {
         return pair_of(S{0u, 1u, 0u, i}, S{0u, 1u, 0u, i + 1u});
       }},
      {"passes",
       [](uint i) {
         return pair_of(S{0u, 2u, 0u, i}, S{0u, 2u, 1u, i});
       }},
      {"streams",
       [](uint i) {
         return pair_of(S{0u, 1u, 0u, i}, S{0u, 2u, 0u, i});
       }},
      {"seeds",
       [](uint i) {
         return pair_of(S{0u, 2u, 0u, i}, S{1u, 2u, 0u, i});
       }},
      {"seed and stream swapped",
       [](uint i) {
         return pair_of(S{2u, 1u, 0u, i}, S{1u, 2u, 0u, i});
       }},
  };
  for (const Pair& pair : pairs) {
    double correlation = 0.0;
    std::vector<double> observed(256, 0.0);
    for (uint i = 0; i < kDraws; ++i) {
      const vec2 u = pair.at(i);
      correlation += 12.0 * (u.x - 0.5) * (u.y - 0.5);
      ++observed[static_cast<std::size_t>(u.x * 16.0f) * 16u +
                 static_cast<std::size_t>(u.y * 16.0f)];
    }
    expect_plausible(statistics::normal_two_sided(correlation / std::sqrt(double{kDraws})),
                     std::string("correlation of ") + pair.name);
    expect_counts(observed, std::vector<double>(256, kDraws / 256.0), pair.name);
  }
}

// floor(word * count / 2^32): index k owns the words from ceil(k 2^32 / count) on, so that no two
// indices differ by more than one word. Checked at both ends of every index.
TEST(IndexFromWord, SharesTheWordsEvenly) {
  for (const std::uint64_t count : {1ull, 2ull, 3ull, 7ull, 64ull, 1000ull, 65537ull}) {
    const uint n = static_cast<uint>(count);
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::uint64_t first = ((k << 32u) + count - 1u) / count;
      const std::uint64_t end = (((k + 1u) << 32u) + count - 1u) / count;
      ASSERT_EQ(index_from_word(static_cast<uint>(first), n), k) << count;
      ASSERT_EQ(index_from_word(static_cast<uint>(end - 1u), n), k) << count;
    }
  }
}

TEST(IndexFromWord, KeepsItsBounds) {
  for (const uint count : {1u, 2u, 5u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
    EXPECT_EQ(index_from_word(0u, count), 0u);
    EXPECT_EQ(index_from_word(0xffffffffu, count), count - 1u);
  }
}

}  // namespace
}  // namespace ppm::shared
