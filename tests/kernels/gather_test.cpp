// The photon grid and the gather against brute force: as sets, to the bit.
//
// What a search finds shows in its sums: M counts photons, and S adds terms f_r * flux that are
// random numbers, so that another set with the same sum is next to impossible. f_r is learnt from
// the device itself (one photon of flux 2^20) and compared with 1 / pi; the product with a flux is
// one rounded multiplication, which the host repeats exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "device_fixture.hpp"
#include "photon_grid.hpp"
#include "randoms.hpp"
#include "shared/grid.h"
#include "shared/ppm.h"
#include "synthetic_photons.hpp"

namespace ppm::tests {
namespace {

using glm::vec3;
using shared::GatherSum;
using shared::Photon;

// A stored photon keeps 16 bits under one exponent (shared/photon.h).
vec3 random_flux(Randoms& random) {
  const auto channel = [&] { return static_cast<float>(random.below(65536)) * 0x1p-16f; };
  return {channel(), channel(), channel()};
}

struct Sums {
  std::uint64_t count = 0;
  std::array<std::uint64_t, 3> flux{};
  bool operator==(const Sums&) const = default;
};

Sums words_of(const GatherSum& sum) {
  const auto join = [&](int i) {
    return std::uint64_t{sum.flux[2 * i + 1]} << 32 | sum.flux[2 * i];
  };
  return {sum.count, {join(0), join(1), join(2)}};
}

// 32.32 fixed point of a non-negative float, rounded to nearest, in double.
std::uint64_t fixed(float x) {
  return static_cast<std::uint64_t>(std::nearbyint(static_cast<double>(x) * 4294967296.0));
}

bool counts(const Photon& photon) {
  return photon.normal.z > 0.0f && photon.incident.z > 0.0f;
}

// Exactly the kernel's distance, which is computed without contraction.
bool in_disc(const SyntheticHit& hit, const Photon& photon) {
  const vec3 d = photon.position - hit.position;
  return d.x * d.x + d.y * d.y + d.z * d.z <= hit.radius2;
}

std::vector<Sums> brute_force(std::span<const SyntheticHit> hits, std::span<const Photon> photons,
                              float f) {
  std::vector<Sums> sums(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    for (const Photon& photon : photons) {
      if (!counts(photon) || !in_disc(hits[i], photon)) continue;
      sums[i].count += 1;
      for (int c = 0; c < 3; ++c)
        sums[i].flux[static_cast<std::size_t>(c)] += fixed(f * photon.flux[c]);
    }
  }
  return sums;
}

struct Search {
  float cell = 0.05f;
  vec3 bounds_min{-1.0f}, bounds_max{1.0f};
  std::uint32_t hashed_entries = 0;
  std::size_t chunks = 1;
};

class Gather : public DeviceTest {
 protected:
  std::vector<Sums> gather(std::span<const SyntheticHit> hits, std::span<const Photon> photons,
                           const Search& search) {
    render::HitTile tile = make_tile(device(), hits);
    SyntheticEstimator estimator(device(), hits.size());
    estimator->prepare_searches(std::span(&tile, 1));
    const std::size_t chunk = (photons.size() + search.chunks - 1) / search.chunks;
    render::PhotonGrid grid(device(), search.bounds_min, search.bounds_max, chunk,
                            search.hashed_entries);
    std::size_t first = 0;
    do {
      const auto part = photons.subspan(first, std::min(chunk, photons.size() - first));
      const PhotonBuffers buffers(device(), part);
      grid.build(device(), buffers.table(), static_cast<std::uint32_t>(part.size()), search.cell);
      const render::Estimator::Rejected rejected = estimator->gather(tile, grid);
      EXPECT_EQ(rejected.overflow + rejected.clamped, 0u);
    } while ((first += chunk) < photons.size());
    constants_ = grid.constants();
    std::vector<Sums> sums;
    for (const GatherSum& sum : tile.sums.download<GatherSum>(hits.size()))
      sums.push_back(words_of(sum));
    return sums;
  }

  // f_r as the device computes it.
  float device_f() {
    const SyntheticHit hit{vec3(0.0f), 0.01f};
    const Photon photon = photon_at(vec3(0.0f), vec3(0x1p20f));
    const Sums sums = gather(std::span(&hit, 1), std::span(&photon, 1), {})[0];
    EXPECT_EQ(sums.count, 1u);
    const double f = static_cast<double>(sums.flux[0]) * 0x1p-52;
    // Albedo 1 over pi; the albedo passes through 16 bits and some five roundings.
    EXPECT_NEAR(f, 0.318309886183790672, 5 * 0x1p-24);
    return static_cast<float>(f);
  }

  void check(std::span<const SyntheticHit> hits, std::span<const Photon> photons,
             const Search& search) {
    const std::vector<Sums> expected = brute_force(hits, photons, f());
    const std::vector<Sums> found = gather(hits, photons, search);
    std::size_t wrong = 0, any = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      any += expected[i].count > 0 ? 1 : 0;
      if (found[i] == expected[i]) continue;
      if (wrong++ == 0) {
        ADD_FAILURE() << "hit point " << i << ": " << found[i].count << " photons instead of "
                      << expected[i].count << ", or others";
      }
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(any, hits.size() / 6);
  }

  float f() {
    if (f_ == 0.0f) f_ = device_f();
    return f_;
  }

  bool hashed() const { return constants_.table_mask != PPM_GRID_DENSE; }

  shared::GridConstants constants_{};  // of the last search
  float f_ = 0.0f;
};

std::vector<Photon> cloud(std::size_t count, std::uint32_t seed, float half = 1.0f) {
  Randoms random(seed);
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < count; ++i) {
    photons.push_back(photon_at(random.in_cube(half), random_flux(random)));
    if (i % 7 == 0) photons.back().normal.z = -1.0f;  // arrived on the other side of a thin wall
    if (i % 11 == 0) photons.back().incident.z = -1.0f;
  }
  return photons;
}

// Radii that differ a hundredfold.
std::vector<SyntheticHit> uneven_hits(std::size_t count, std::uint32_t seed, float largest = 0.5f) {
  Randoms random(seed);
  std::vector<SyntheticHit> hits;
  for (std::size_t i = 0; i < count; ++i) {
    const float radius = largest * std::exp2(-random.in(0.0f, 6.65f));
    hits.push_back({random.in_cube(1.0f), radius * radius});
  }
  return hits;
}

TEST_F(Gather, DenseGridFindsWhatBruteForceFinds) {
  check(uneven_hits(1000, 1), cloud(8000, 2), {.cell = 0.04f});
  EXPECT_FALSE(hashed());
}

TEST_F(Gather, HashedGridFindsWhatBruteForceFinds) {
  check(uneven_hits(600, 3), cloud(8000, 4), {.cell = 0.012f});
  EXPECT_TRUE(hashed());
}

TEST_F(Gather, CollidingRowsCountNoPhotonTwice) {
  for (const std::uint32_t entries : {1u, 2u, 64u}) {
    check(uneven_hits(60, 5, 0.3f), cloud(1000, 6), {.cell = 0.019f, .hashed_entries = entries});
    EXPECT_TRUE(hashed());
    EXPECT_EQ(constants_.table_mask, entries - 1);
  }
}

TEST_F(Gather, CellBordersAndRims) {
  // Cells of 1/16, everything at multiples of 1/32: on borders, and in pairs exactly a radius
  // apart.
  Randoms random(7);
  const auto lattice = [&] {
    const vec3 p = random.in_cube(1.0f);
    return vec3(std::round(p.x * 32.0f), std::round(p.y * 32.0f), std::round(p.z * 32.0f)) / 32.0f;
  };
  std::vector<SyntheticHit> hits;
  std::vector<Photon> photons;
  for (int i = 0; i < 500; ++i) {
    const float radius = 0.03125f * static_cast<float>(1 + i % 8);
    hits.push_back({lattice(), radius * radius});
    for (int axis = 0; axis < 3; ++axis) {
      vec3 rim = hits.back().position;
      rim[axis] += i % 2 == 0 ? radius : -radius;
      photons.push_back(photon_at(rim, random_flux(random)));
      rim[axis] = std::nextafter(rim[axis], i % 2 == 0 ? 2.0f : -2.0f);
      photons.push_back(photon_at(rim, random_flux(random)));
    }
  }
  for (int i = 0; i < 3000; ++i) photons.push_back(photon_at(lattice(), random_flux(random)));
  check(hits, photons, {.cell = 0.0625f});
  check(hits, photons, {.cell = 0.0078125f, .hashed_entries = 4096});
  EXPECT_TRUE(hashed());
}

TEST_F(Gather, PositionsOutsideTheBoundsAreClamped) {
  const vec3 half(0.4f, 0.3f, 0.2f);
  check(uneven_hits(500, 8), cloud(4000, 9),
        {.cell = 0.03f, .bounds_min = -half, .bounds_max = half});
  check(uneven_hits(200, 8), cloud(4000, 9),
        {.cell = 0.005f, .bounds_min = -half, .bounds_max = half});
  EXPECT_TRUE(hashed());
}

TEST_F(Gather, FlatBounds) {
  std::vector<Photon> photons = cloud(4000, 10);
  std::vector<SyntheticHit> hits = uneven_hits(400, 11);
  for (Photon& photon : photons) photon.position.y = 0.25f;
  for (SyntheticHit& hit : hits) hit.position.y = 0.25f;
  check(hits, photons, {.cell = 0.02f, .bounds_min = {-1, 0.25f, -1}, .bounds_max = {1, 0.25f, 1}});
}

TEST_F(Gather, ADiscOfManyPhotonsIsCountedWhole) {
  // More than the 65535 iterations that all loops of an invocation share on some drivers.
  constexpr std::size_t kPhotons = 200000;
  Randoms random(12);
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < kPhotons; ++i)
    photons.push_back(photon_at(0.1f * random.in_cube(0.5f), random_flux(random)));
  const SyntheticHit hits[] = {{vec3(0.0f), 0.01f}, {vec3(0.5f), 0.01f}, {vec3(0.0f), 0.0004f}};
  const std::vector<Sums> expected = brute_force(hits, photons, f());
  ASSERT_EQ(expected[0].count, kPhotons);
  ASSERT_EQ(expected[1].count, 0u);
  ASSERT_GT(expected[2].count, 1000u);
  // In one cell, in a few, and in rows of many.
  for (const float cell : {2.0f, 0.06f, 0.004f}) {
    EXPECT_TRUE(gather(hits, photons, {.cell = cell}) == expected) << "cells of " << cell;
  }
}

TEST_F(Gather, CrowdsInRowsOfTheirOwnAreCountedWhole) {
  // Long searches in step, each of which meets its photons where the others meet none: what loops
  // of one invocation may take is then shared by all of them.
  constexpr std::uint32_t kSearches = 8, kPhotons = 40000;
  Randoms random(16);
  std::vector<SyntheticHit> hits;
  std::vector<Photon> photons;
  for (std::uint32_t i = 0; i < kSearches; ++i) {
    const vec3 centre(-0.7f + 0.2f * static_cast<float>(i), 0.0f, 0.0f);
    hits.push_back({centre, 0.09f * 0.09f});
    const vec3 crowd = centre + vec3(0.0f, -0.07f + 0.02f * static_cast<float>(i), 0.0f);
    for (std::uint32_t j = 0; j < kPhotons; ++j)
      photons.push_back(photon_at(crowd + 0.001f * random.in_cube(1.0f), random_flux(random)));
  }
  const std::vector<Sums> expected = brute_force(hits, photons, f());
  for (const Sums& sums : expected) ASSERT_EQ(sums.count, kPhotons);
  EXPECT_TRUE(gather(hits, photons, {.cell = 0.02f}) == expected);
}

TEST_F(Gather, EmptyRowsDoNotEndTheSearch) {
  // Up to 512 x 512 rows of cells in the disc's box, nearly all of them empty.
  const SyntheticHit hits[] = {{vec3(0.0f), 1.0f}, {vec3(0.9f), 4.0f}};
  const std::vector<Photon> photons = cloud(3000, 13);
  const std::vector<Sums> expected = brute_force(hits, photons, f());
  ASSERT_GT(expected[0].count, 1000u);
  EXPECT_TRUE(gather(hits, photons, {.cell = 1.0f / 256.0f}) == expected);
  EXPECT_TRUE(hashed());
}

TEST_F(Gather, OrderAndChunksLeaveNoTrace) {
  const std::vector<SyntheticHit> hits = uneven_hits(500, 14);
  std::vector<Photon> photons = cloud(9000, 15);
  const std::vector<Sums> once = gather(hits, photons, {});
  Randoms random(16);
  for (const std::size_t chunks : {1u, 2u, 7u}) {
    std::shuffle(photons.begin(), photons.end(), random.engine());
    EXPECT_TRUE(gather(hits, photons, {.chunks = chunks}) == once) << chunks << " chunks";
  }
  for (const float cell : {0.3f, 0.01f})
    EXPECT_TRUE(gather(hits, photons, {.cell = cell}) == once) << "cells of " << cell;
}

TEST_F(Gather, NoPhotons) {
  const std::vector<SyntheticHit> hits = uneven_hits(10, 17);
  EXPECT_TRUE(gather(hits, {}, {}) == std::vector<Sums>(hits.size()));
}

TEST_F(Gather, UpdateTakesTheSumsAndClearsThem) {
  const std::vector<SyntheticHit> hits = uneven_hits(300, 18);
  const std::vector<Photon> photons = cloud(5000, 19);
  render::HitTile tile = make_tile(device(), hits);
  SyntheticEstimator estimator(device(), hits.size());
  estimator->prepare_searches(std::span(&tile, 1));
  render::PhotonGrid grid(device(), vec3(-1.0f), vec3(1.0f), photons.size());
  const PhotonBuffers buffers(device(), photons);
  grid.build(device(), buffers.table(), static_cast<std::uint32_t>(photons.size()), 0.05f);
  estimator->gather(tile, grid);
  estimator->update(std::span(&tile, 1), 0.7f);
  const std::vector<Sums> sums = brute_force(hits, photons, f());
  const auto statistics = tile.statistics.download<glm::vec4>(hits.size());
  const auto photon_counts = tile.photon_counts.download<std::uint32_t>(hits.size());
  const auto cleared = tile.sums.download<GatherSum>(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(photon_counts[i], sums[i].count);
    EXPECT_TRUE(words_of(cleared[i]) == Sums{});
    // Eqs. 7, 9, 12 from N = 0: R^2 shrinks by alpha where anything was found.
    const double r2 = hits[i].radius2;
    const double flux = static_cast<double>(sums[i].flux[0]) / 4294967296.0;
    const double lambda = flux / (3.14159265358979324 * r2);
    EXPECT_NEAR(statistics[i].x, lambda, 4e-7 * lambda);
    EXPECT_NEAR(statistics[i].w, sums[i].count > 0 ? 0.7 * r2 : r2, 3e-7 * r2);
  }
}

// The histogram of radii that the update leaves, by the cell size that follows from it: 840 small
// discs together, then 100 large ones among others that have none.
TEST_F(Gather, UpdateCountsEveryRadius) {
  std::vector<SyntheticHit> hits;
  Randoms random(20);
  for (int i = 0; i < 840; ++i) hits.push_back({random.in_cube(1.0f), 1e-4f});
  for (int i = 0; i < 100; ++i) {
    hits.push_back({random.in_cube(1.0f), 0.04f});
    hits.push_back({random.in_cube(1.0f), 0.0f});
  }
  render::HitTile tile = make_tile(device(), hits);
  SyntheticEstimator estimator(device(), hits.size());
  estimator->update(std::span(&tile, 1), 0.7f);
  std::vector<std::uint32_t> histogram(PPM_RADIUS_BINS);
  histogram[shared::radius_bin(1e-4f)] = 840;
  histogram[shared::radius_bin(0.04f)] = 100;
  EXPECT_EQ(estimator->cell_size(), render::cell_from_radii(histogram));
  histogram[shared::radius_bin(1e-4f)] = 105;  // each subgroup of eight once
  EXPECT_NE(estimator->cell_size(), render::cell_from_radii(histogram));
}

}  // namespace
}  // namespace ppm::tests
