// The search for the n-th nearest photon by counting against sorting, on the host.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "shared/nearest.h"

namespace ppm::tests {
namespace {

using shared::NearestSearch;
using Words = std::vector<std::uint32_t>;

// A round as the kernels make it: counts up to the limits, or the list of the nearest.
void count(NearestSearch& search, const Words& sorted, std::uint32_t wanted) {
  const auto first = std::ranges::lower_bound(sorted, search.from);
  if (shared::nearest_lists(search, wanted)) {
    const auto last = std::ranges::upper_bound(sorted, search.upto);
    for (std::uint32_t i = 0; i < PPM_NEAREST_LIST && first + i < last; ++i)
      search.words[i] = first[i];
  } else {
    for (int i = 0; i < 3; ++i) {
      const auto last = std::ranges::upper_bound(sorted, search.words[i]);
      search.words[3 + i] += static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(last - first, 0));
    }
  }
}

struct Found {
  std::uint32_t word = 0, rounds = 0;
};

Found find(const Words& sorted, std::uint32_t wanted, float guess, float spread, float most2) {
  const std::uint32_t most = shared::nearest_word(most2);
  NearestSearch search = shared::nearest_begin(guess, spread, most);
  for (std::uint32_t round = 0; round < 200; ++round) {
    count(search, sorted, wanted);
    const std::uint32_t word = shared::nearest_decide(search, wanted, most, round);
    if (word != 0) return {word, round + 1};
  }
  return {};
}

Words words_of(const std::vector<float>& distances2) {
  Words words;
  for (const float distance2 : distances2) words.push_back(shared::nearest_word(distance2));
  std::ranges::sort(words);
  return words;
}

std::uint32_t expected(const Words& sorted, std::uint32_t wanted, float most2) {
  const std::uint32_t most = shared::nearest_word(most2);
  return wanted <= sorted.size() ? std::min(sorted[wanted - 1], most) : most;
}

struct Spread {
  const char* name;
  float (*distance2)(std::mt19937& engine);
  std::uint32_t rounds;  // that may pass, with any guess
};

float unit(std::mt19937& engine) {
  return static_cast<float>(engine() >> 8) * 0x1p-24f;
}

const Spread kSpreads[] = {
    {"plane", [](std::mt19937& engine) { return 0.3f * unit(engine); }, 20},
    {"volume", [](std::mt19937& engine) { return std::pow(unit(engine), 0.667f); }, 20},
    {"lattice", [](std::mt19937& engine) { return static_cast<float>(engine() % 7) / 64.0f; }, 60},
    {"clustered", [](std::mt19937& engine) { return std::exp2(-40.0f * unit(engine)); }, 60},
    {"ring", [](std::mt19937& engine) { return 0.25f * (1.0f + 1e-6f * unit(engine)); }, 60},
    {"one place", [](std::mt19937&) { return 0.0f; }, 60},
    {"two places", [](std::mt19937& engine) { return engine() % 2 ? 1e-9f : 0.9f; }, 60},
};

TEST(NearestPhoton, IsThatOfASort) {
  std::mt19937 engine(1);
  for (const Spread& spread : kSpreads) {
    for (const std::size_t photons : {0u, 1u, 9u, 300u, 20000u}) {
      std::vector<float> distances2;
      for (std::size_t i = 0; i < photons; ++i) distances2.push_back(spread.distance2(engine));
      const Words sorted = words_of(distances2);
      for (const std::uint32_t wanted : {1u, 2u, 8u, 9u, 50u, 299u, 300u, 1500u}) {
        for (const float guess : {0.0f, 1e-12f, 1e-3f, 0.1f, 1.0f}) {
          for (const float most2 : {1.0f, 0.01f}) {
            const Found found = find(sorted, wanted, std::min(guess, most2), 2.0f, most2);
            EXPECT_EQ(found.word, expected(sorted, wanted, most2))
                << spread.name << ", " << wanted << " of " << photons << ", guess " << guess;
            EXPECT_LE(found.rounds, spread.rounds)
                << spread.name << ", " << wanted << " of " << photons << ", guess " << guess;
          }
        }
      }
    }
  }
}

TEST(NearestPhoton, AFairGuessTakesFewRounds) {
  std::mt19937 engine(2);
  double rounds = 0.0;
  constexpr int kTimes = 200;
  for (int i = 0; i < kTimes; ++i) {
    std::vector<float> distances2;
    for (int photon = 0; photon < 5000; ++photon) distances2.push_back(unit(engine));
    const float guess = 0.1f * std::exp2(2.0f * unit(engine) - 1.0f);
    rounds += find(words_of(distances2), 500, guess, 2.0f, 1.0f).rounds;
  }
  EXPECT_LT(rounds / kTimes, 5.0);
}

}  // namespace
}  // namespace ppm::tests
