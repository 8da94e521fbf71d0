// The distance of the n-th nearest photon on the device against brute force: the same float, to the
// bit; and the photons within it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "device_fixture.hpp"
#include "nearest_photons.hpp"
#include "photon_map.hpp"
#include "randoms.hpp"
#include "shared/nearest.h"
#include "synthetic_photons.hpp"

namespace ppm::tests {
namespace {

using glm::vec3;
using shared::Photon;

constexpr float kLargestRadius = 0.7f;

// Exactly the kernel's distance, which is computed without contraction.
std::uint32_t word_between(vec3 a, vec3 b) {
  const vec3 d = a - b;
  return shared::nearest_word(d.x * d.x + d.y * d.y + d.z * d.z);
}

bool counts(const Photon& photon, std::uint32_t max_depth) {
  return photon.normal.z > 0.0f && photon.incident.z > 0.0f &&
         (max_depth == 0 || photon.events + 1 <= max_depth);
}

struct Found {
  std::uint32_t word = 0;     // of R^2
  std::uint32_t photons = 0;  // within R
  bool operator==(const Found&) const = default;
};

std::vector<Found> brute_force(std::span<const SyntheticHit> hits, std::span<const Photon> photons,
                               std::uint32_t wanted, std::uint32_t max_depth) {
  const std::uint32_t most = shared::nearest_word(kLargestRadius * kLargestRadius);
  std::vector<Found> result;
  std::vector<std::uint32_t> words;
  for (const SyntheticHit& hit : hits) {
    words.clear();
    for (const Photon& photon : photons)
      if (counts(photon, max_depth)) words.push_back(word_between(photon.position, hit.position));
    std::uint32_t word = most;
    if (wanted <= words.size()) {
      std::ranges::nth_element(words, words.begin() + (wanted - 1));
      word = std::min(words[wanted - 1], most);
    }
    result.push_back({word, static_cast<std::uint32_t>(std::ranges::count_if(
                                words, [&](std::uint32_t other) { return other <= word; }))});
  }
  return result;
}

struct Way {
  float cell = 0.05f;
  float guess2 = 0.01f, spread = 2.0f;
  std::uint64_t grid_photons = 0;  // 0: one grid for all
  std::uint32_t max_depth = 0;
};

class Nearest : public DeviceTest {
 protected:
  std::vector<Found> find(std::span<const SyntheticHit> hits, std::span<const Photon> photons,
                          std::uint32_t wanted, const Way& way) {
    render::HitTile tile = make_tile(device(), hits);
    SyntheticEstimator estimator(device(), hits.size(), way.max_depth);
    estimator->prepare_searches(std::span(&tile, 1));
    render::Settings settings;
    settings.map_photons = photons.size();
    settings.photon_capacity = way.grid_photons;
    render::PhotonMap map(device(), vec3(-1.0f), vec3(1.0f),
                          render::PhotonMapShape::of(settings, render::PassLimits::of(device())));
    // In portions, as they are traced; sorted in between, as for a picture on the way.
    for (std::size_t first = 0; first < photons.size();) {
      const auto part =
          photons.subspan(first, std::min(photons.size() - first, photons.size() * 3 / 5 + 1));
      map.append(PhotonBuffers(device(), part).table(), part.size());
      map.sort(0.1f);
      first += part.size();
    }
    map.sort(way.cell);
    EXPECT_EQ(map.photons(), photons.size());
    grids_ = map.grids().size();
    render::NearestPhotons nearest(device(), {}, hits.size());
    nearest.find(tile, map.grids(),
                 {wanted, way.max_depth, kLargestRadius, way.guess2, way.spread, 1});
    rounds_ = nearest.rounds();
    for (const render::PhotonGrid& grid : map.grids()) estimator->gather(tile, grid);
    const auto statistics = tile.statistics.download<glm::vec4>(hits.size());
    const auto sums = tile.sums.download<shared::GatherSum>(hits.size());
    std::vector<Found> result;
    for (std::size_t i = 0; i < hits.size(); ++i)
      result.push_back({glm::floatBitsToUint(statistics[i].w), sums[i].count});
    return result;
  }

  void check(std::span<const SyntheticHit> hits, std::span<const Photon> photons,
             std::uint32_t wanted, const Way& way = {}) {
    const std::vector<Found> expected = brute_force(hits, photons, wanted, way.max_depth);
    const std::vector<Found> found = find(hits, photons, wanted, way);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (found[i] == expected[i] || wrong++ > 0) continue;
      ADD_FAILURE() << "hit point " << i << ", n = " << wanted << ": "
                    << glm::uintBitsToFloat(found[i].word) << " with " << found[i].photons
                    << " photons instead of " << glm::uintBitsToFloat(expected[i].word) << " with "
                    << expected[i].photons << "; cells of " << way.cell << ", guess " << way.guess2
                    << ", spread " << way.spread << ", " << grids_ << " grids";
    }
    EXPECT_EQ(wrong, 0u) << "of " << hits.size();
    EXPECT_LE(rounds_, 60u);
  }

  std::size_t grids_ = 0;     // of the last search
  std::uint64_t rounds_ = 0;  // idem
};

std::vector<SyntheticHit> hits_at(std::size_t count, std::uint32_t seed,
                                  vec3 (*position)(Randoms&)) {
  Randoms random(seed);
  std::vector<SyntheticHit> hits;
  for (std::size_t i = 0; i < count; ++i) hits.push_back({position(random), 0.0025f});
  return hits;
}

std::vector<Photon> photons_at(std::size_t count, std::uint32_t seed, vec3 (*position)(Randoms&)) {
  Randoms random(seed);
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < count; ++i) {
    photons.push_back(photon_at(position(random)));
    photons.back().events = random.below(4);
    if (i % 7 == 0) photons.back().normal.z = -1.0f;
    if (i % 11 == 0) photons.back().incident.z = -1.0f;
  }
  return photons;
}

vec3 in_cube(Randoms& random) {
  return random.in_cube(1.0f);
}
vec3 in_plane(Randoms& random) {
  return {random.in(-1.0f, 1.0f), random.in(-1.0f, 1.0f), 0.25f};
}
vec3 on_lattice(Randoms& random) {
  const vec3 p = in_plane(random);
  return {std::round(p.x * 16.0f) / 16.0f, std::round(p.y * 16.0f) / 16.0f, p.z};
}
// Nine in ten in a spot, in which density varies a thousandfold.
vec3 clustered(Randoms& random) {
  const vec3 p = in_plane(random);
  if (random.below(10) == 0) return p;
  const float shrink = std::exp2(-random.in(3.0f, 13.0f));
  return {0.3f + shrink * p.x, -0.2f + shrink * p.y, p.z};
}

TEST_F(Nearest, IsThatOfBruteForce) {
  const struct {
    vec3 (*hits)(Randoms&);
    vec3 (*photons)(Randoms&);
  } kScenes[] = {{in_cube, in_cube},
                 {in_plane, in_plane},
                 {on_lattice, on_lattice},
                 {clustered, clustered},
                 {in_plane, clustered}};
  std::uint32_t seed = 0;
  for (const auto& [hit_at, photon_at] : kScenes) {
    const auto hits = hits_at(200, ++seed, hit_at);
    const auto photons = photons_at(6000, ++seed, photon_at);
    for (const std::uint32_t wanted : {1u, 20u, 500u}) {
      SCOPED_TRACE("scene " + std::to_string(seed / 2));
      check(hits, photons, wanted);
    }
  }
}

// None of these may change what is found.
TEST_F(Nearest, HoweverItIsSearched) {
  const auto hits = hits_at(50, 20, clustered);
  const auto photons = photons_at(9000, 21, clustered);
  check(hits, photons, 100, {.cell = 0.4f});
  // Rows enough for searches that are left to others, each with its photons in rows of its own.
  check(std::span(hits).first(48), photons, 100, {.cell = 0.004f});
  for (const float guess : {1e-11f, 1e-6f, 0.4f}) check(hits, photons, 100, {.guess2 = guess});
  check(hits, photons, 100, {.spread = 30.0f});
  for (const std::uint64_t grid_photons : {4000u, 1000u}) {
    check(hits, photons, 100, {.grid_photons = grid_photons});
    EXPECT_EQ(grids_, 9000 / grid_photons + (9000 % grid_photons > 0 ? 1 : 0));
  }
}

TEST_F(Nearest, PhotonsTooDeepDoNotCount) {
  const auto hits = hits_at(100, 30, in_plane);
  const auto photons = photons_at(5000, 31, in_plane);
  for (const std::uint32_t max_depth : {1u, 3u}) check(hits, photons, 60, {.max_depth = max_depth});
}

TEST_F(Nearest, FewerThanWantedAreTakenWithinTheLargestRadius) {
  const auto hits = hits_at(60, 40, in_plane);
  check(hits, photons_at(300, 41, in_plane), 500);
  check(hits, photons_at(1, 42, in_plane), 2);
  check(hits, photons_at(700, 43, in_plane), 200);  // some have them, some do not
}

// More than the 65535 turns that all loops of an invocation share on some drivers: searches that
// are left to others and go on for several dispatches.
TEST_F(Nearest, AmongMany) {
  auto photons = photons_at(80000, 50, clustered);
  const SyntheticHit hits[] = {{{0.3f, -0.2f, 0.25f}, 0.0025f},
                               {{0.31f, -0.2f, 0.25f}, 0.0025f},
                               {{-0.5f, 0.5f, 0.25f}, 0.0025f}};
  for (const std::uint32_t wanted : {500u, 50000u}) check(hits, photons, wanted);
  for (Photon& photon : photons) photon.position = hits[0].position;
  check(hits, photons, 500);
}

}  // namespace
}  // namespace ppm::tests
