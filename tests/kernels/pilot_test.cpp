// Initial radii: from the pilot's photons, from the pixel's footprint, and as given.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "device_fixture.hpp"
#include "integrator.hpp"
#include "photon_grid.hpp"
#include "pilot.hpp"
#include "randoms.hpp"
#include "scene_pieces.hpp"
#include "synthetic_photons.hpp"

namespace ppm::tests {
namespace {

using glm::vec3;
using shared::Photon;

constexpr double kPi = 3.14159265358979324;
constexpr double kWanted = 20.0;  // photons in a first disc (DESIGN: n of the n-th nearest)

class Pilot : public DeviceTest {
 protected:
  enum class Photons {
    whole,    // all in the grid, sorted anew for every round
    coarse,   // all in the grid, sorted anew only when a round asks for it
    chunked,  // in three parts
  };
  Photons photons_come = Photons::whole;

  void build(render::PhotonGrid& grid, std::span<const Photon> photons, float cell) {
    const PhotonBuffers buffers(device(), photons);
    grid.build(device(), buffers.table(), static_cast<std::uint32_t>(photons.size()), cell);
  }

  std::uint64_t run_round(render::Pilot& pilot, render::PhotonGrid& grid,
                          std::span<const Photon> photons, const render::Pilot::Round& round) {
    if (photons_come == Photons::chunked) {
      for (std::size_t part = 0; part < 3; ++part) {
        const std::size_t first = photons.size() * part / 3;
        const std::size_t last = photons.size() * (part + 1) / 3;
        build(grid, photons.subspan(first, last - first), round.radius);
        pilot.count(grid, round);
      }
      return pilot.decide(round);
    }
    if (photons_come == Photons::coarse && round.index > 0) {
      if (const auto undecided = pilot.decide(grid, round, true)) return *undecided;
    }
    build(grid, photons, round.radius);
    return pilot.decide(grid, round, false).value();
  }

  // Rounds of halved radii from `largest` on, as the integrator runs them.
  std::vector<double> radii2(std::span<const vec3> positions, std::span<const Photon> photons,
                             float footprint, float largest, std::uint32_t rounds = 12) {
    std::vector<SyntheticHit> hits;
    for (const vec3& position : positions) hits.push_back({position, footprint * footprint});
    const render::HitTile tile = make_tile(device(), hits);
    SyntheticEstimator estimator(device(), hits.size());
    estimator->set_radii(tile, 0.0f, 0.0f);
    render::PhotonGrid grid(device(), vec3(-1.0f), vec3(1.0f), photons.size());
    render::Pilot pilot(device(), {}, std::span(&tile, 1));
    float radius = largest;
    for (std::uint32_t index = 0; index < rounds; ++index, radius *= 0.5f) {
      const render::Pilot::Round round{index, index + 1 == rounds, radius};
      if (run_round(pilot, grid, photons, round) == 0) break;
    }
    std::vector<double> result;
    for (const glm::vec4& statistic : tile.statistics.download<glm::vec4>(hits.size()))
      result.push_back(statistic.w);
    return result;
  }
};

std::vector<Photon> lit_plane(std::size_t count, std::uint32_t seed) {
  Randoms random(seed);
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < count; ++i)
    photons.push_back(photon_at({random.in(-1.0f, 1.0f), random.in(-1.0f, 1.0f), 0.0f}));
  return photons;
}

std::vector<vec3> inner_positions(std::size_t count, std::uint32_t seed) {
  Randoms random(seed);
  std::vector<vec3> positions;
  for (std::size_t i = 0; i < count; ++i)
    positions.push_back({random.in(-0.8f, 0.8f), random.in(-0.8f, 0.8f), 0.0f});
  return positions;
}

double nth_nearest2(vec3 position, std::span<const Photon> photons, std::size_t n) {
  std::vector<double> distances;
  for (const Photon& photon : photons) {
    const glm::dvec3 d = glm::dvec3(photon.position) - glm::dvec3(position);
    distances.push_back(glm::dot(d, d));
  }
  std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(n - 1),
                   distances.end());
  return distances[n - 1];
}

TEST_F(Pilot, UniformLightGivesTheWantedNumberOfPhotons) {
  const std::vector<Photon> photons = lit_plane(40000, 1);
  const std::vector<vec3> positions = inner_positions(400, 2);
  const std::vector<double> found = radii2(positions, photons, 1e-6f, 0.15f);
  const double density = static_cast<double>(photons.size()) / 4.0;
  const double expected = kWanted / (kPi * density);
  double mean = 0.0, nearest = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    mean += found[i] / static_cast<double>(positions.size());
    nearest += nth_nearest2(positions[i], photons, 20) / static_cast<double>(positions.size());
    // A count of 20 to 80 estimates the density to 1 / sqrt(20): six of its deviations.
    EXPECT_GT(found[i], expected / 2.4);
    EXPECT_LT(found[i], expected * 2.4);
  }
  // E[1 / found] exceeds 1 / E[found] by 1 / 20 at most; 400 discs leave an error of 0.011.
  EXPECT_GT(mean, 0.96 * expected);
  EXPECT_LT(mean, 1.1 * expected);
  // The brute-force 20th nearest: mean n / (pi density), deviation 1 / sqrt(20 * 400) = 0.011.
  EXPECT_NEAR(mean / nearest, 1.03, 0.08);
}

TEST_F(Pilot, RadiiFollowTheDensity) {
  std::vector<Photon> photons = lit_plane(30000, 3);
  for (Photon& photon : photons) photon.position.x *= photon.position.x > 0.0f ? 1.0f : 0.1f;
  const std::vector<vec3> positions = {{0.5f, 0.0f, 0.0f}, {-0.05f, 0.0f, 0.0f}};
  const std::vector<double> found = radii2(positions, photons, 1e-6f, 0.15f);
  EXPECT_GT(found[0] / found[1], 4.0);  // ten times as dense, two counts of 20 or more
  EXPECT_LT(found[0] / found[1], 25.0);
}

TEST_F(Pilot, TheDarkGetsTheLargestAndTheBrightTheLeast) {
  std::vector<Photon> photons = lit_plane(50, 4);
  for (Photon& photon : photons) photon.position.x = std::abs(photon.position.x);
  Randoms random(5);
  for (int i = 0; i < 20000; ++i)  // a caustic, brighter than a search will look through
    photons.push_back(photon_at(vec3(-0.5f, 0.0f, 0.0f) + random.in_cube(1e-4f)));
  const std::vector<vec3> positions = {{-0.9f, 0.9f, 0.0f}, {-0.5f, 0.0f, 0.0f}};
  const float footprint = 0.004f;
  const std::vector<double> found = radii2(positions, photons, footprint, 0.1f);
  EXPECT_NEAR(found[0], 0.01, 1e-8);
  EXPECT_NEAR(found[1], 0.25 * footprint * footprint, 1e-11);  // half a footprint
}

TEST_F(Pilot, HoweverPhotonsComeTheRadiiAreTheSame) {
  std::vector<Photon> photons = lit_plane(40000, 7);
  Randoms random(8);
  for (int i = 0; i < 12000; ++i)  // some cells have too many to look at, others nearly
    photons.push_back(photon_at(vec3(0.3f, 0.2f, 0.0f) + 0.04f * random.in_cube(1.0f)));
  const std::vector<vec3> positions = inner_positions(2000, 9);
  const std::vector<double> expected = radii2(positions, photons, 1e-4f, 0.3f);
  EXPECT_LT(*std::ranges::min_element(expected), 0.1 * *std::ranges::max_element(expected));
  for (const Photons way : {Photons::coarse, Photons::chunked}) {
    photons_come = way;
    EXPECT_EQ(radii2(positions, photons, 1e-4f, 0.3f), expected);
  }
}

TEST_F(Pilot, PhotonsOfTheOtherSideDoNotCount) {
  std::vector<Photon> photons = lit_plane(40000, 6);
  for (Photon& photon : photons) photon.normal = -photon.normal;
  const vec3 position(0.0f);
  EXPECT_NEAR(radii2(std::span(&position, 1), photons, 1e-6f, 0.15f)[0], 0.0225, 1e-8);
}

// A plate seen straight on from distance 1, through the integrator.
class InitialRadius : public DeviceTest {
 protected:
  render::Statistics prepare(render::RadiusMode mode, double radius) {
    scene::Scene scene;
    scene.frame.scale = 0.5;
    scene.materials.push_back(diffuse_material(0.5f));
    add_plate(scene, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 0);
    scene = finished(scene);
    scene::PunctualLight light;
    light.kind = scene::PunctualKind::point;
    light.intensity = vec3(1.0f);
    scene.punctual_lights.push_back(light);
    render::Settings settings = small_settings(32, 32);
    settings.camera.yfov = 0.1;
    settings.radius_mode = mode;
    settings.radius = radius;
    settings.photons_per_pass = 1000;
    Log log(Verbosity::quiet);
    const auto integrator = render::make_integrator(settings, scene, device(), log, 1);
    EXPECT_TRUE(integrator->prepare([] { return false; }));
    return integrator->statistics();
  }
};

TEST_F(InitialRadius, FixedIsExact) {
  const render::Statistics statistics = prepare(render::RadiusMode::fixed, 0.037);
  for (const double radius : {statistics.initial_radius_min, statistics.initial_radius_median,
                              statistics.initial_radius_max})
    EXPECT_NEAR(radius, 0.037, 0.037 * 0x1p-22);
}

TEST_F(InitialRadius, FootprintsOfThePixel) {
  const render::Statistics statistics = prepare(render::RadiusMode::footprint, 0.0);
  // pi r^2 is the pixel's area on the plate; three times that r; two world units a working one.
  // Off the axis by up to 0.05 radians: squares of that, 0.0025, are left aside.
  const double pixel = 2.0 * std::tan(0.05) / 32.0;
  const double expected = 2.0 * 3.0 * pixel / std::sqrt(kPi);
  EXPECT_NEAR(statistics.initial_radius_min, expected, 0.005 * expected);
  EXPECT_NEAR(statistics.initial_radius_max, expected, 0.005 * expected);
}

}  // namespace
}  // namespace ppm::tests
