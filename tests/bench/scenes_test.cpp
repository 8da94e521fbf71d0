// The built-in scenes: that they are what they are said to be, by closed forms of their geometry
// and, for the dark and the uneven one, by what the photons make of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "builtin_scenes.hpp"
#include "dark_room.hpp"
#include "device_fixture.hpp"
#include "integrator.hpp"
#include "room.hpp"
#include "uneven_room.hpp"

namespace ppm::bench {
namespace {

using Names = std::set<std::string>;
using Point = std::array<long, 3>;

/// To a hundred-thousandth: corners computed along different edges differ in rounding, which the
/// offset keeps from mattering where they are round numbers.
Point rounded(glm::vec3 position) {
  const auto whole = [](float x) { return std::lround(1e5 * static_cast<double>(x) + 0.2137); };
  return {whole(position.x), whole(position.y), whole(position.z)};
}

struct Shape {
  double volume = 0.0;  ///< signed, by the divergence theorem; positive: fronts look outwards
  int open_edges = 0;   ///< directed edges without a partner the other way
  std::size_t triangles = 0;
};

/// Of all triangles whose material has one of these names.
Shape shape_of(const scene::Scene& scene, const Names& materials) {
  Shape shape;
  std::map<std::pair<Point, Point>, int> edges;
  for (const scene::Triangle& triangle : scene.triangles) {
    if (!materials.contains(scene.materials[triangle.material].name)) continue;
    ++shape.triangles;
    const std::array<glm::dvec3, 3> corners = {
        triangle.corners[0].position, triangle.corners[1].position, triangle.corners[2].position};
    shape.volume += glm::dot(corners[0], glm::cross(corners[1], corners[2])) / 6.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point from = rounded(corners[i]), to = rounded(corners[(i + 1) % 3]);
      ++edges[{from, to}];
      --edges[{to, from}];
    }
  }
  for (const auto& [edge, surplus] : edges) shape.open_edges += std::max(surplus, 0);
  return shape;
}

TEST(BenchScenes, RoomsMeetTheirTriangleCounts) {
  for (const std::size_t wanted : {kRoomTriangles, std::size_t{700000}, std::size_t{1500000}}) {
    const double count = static_cast<double>(make_room(wanted).triangles.size());
    EXPECT_NEAR(count, static_cast<double>(wanted), 0.02 * static_cast<double>(wanted));
  }
}

TEST(BenchScenes, RoomIsClosedAndSoIsWhatStandsInIt) {
  const scene::Scene room = make_room();
  const Shape walls = shape_of(room, {"white", "red", "green", "blue"});
  EXPECT_EQ(walls.open_edges, 0);
  EXPECT_NEAR(walls.volume, -8.0 * kRoom.x * kRoom.y * kRoom.z, 1e-5);  // seen from within
  // A ball of n rows is smaller than the sphere by a share of about (pi / n)^2 / 2, n > 70.
  const auto sphere = [](double radius) {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  };
  const Shape glass = shape_of(room, {"glass"}), mirror = shape_of(room, {"mirror"});
  EXPECT_EQ(glass.open_edges, 0);
  EXPECT_NEAR(glass.volume, sphere(0.25), 2e-3 * sphere(0.25));
  EXPECT_EQ(mirror.open_edges, 0);
  EXPECT_NEAR(mirror.volume, sphere(0.31), 2e-3 * sphere(0.31));
  const Shape ring = shape_of(room, {"clay"});
  EXPECT_EQ(ring.open_edges, 0);
  const double torus = 2.0 * std::numbers::pi * std::numbers::pi * 0.2 * 0.07 * 0.07;
  EXPECT_NEAR(ring.volume, torus, 1e-2 * torus);
}

TEST(BenchScenes, AllLieInTheWorkingFrameWithTheirBounds) {
  for (const BuiltinScene& builtin : builtin_scenes()) {
    if (builtin.group == "big") continue;  // the room again
    const scene::Scene scene = builtin.make();
    ASSERT_EQ(scene.cameras.size(), 1u) << builtin.name;
    EXPECT_EQ(scene.bounds_min, -kRoom) << builtin.name;
    EXPECT_EQ(scene.bounds_max, kRoom) << builtin.name;
    for (const scene::Triangle& triangle : scene.triangles) {
      ASSERT_LT(triangle.material, scene.materials.size()) << builtin.name;
    }
  }
}

TEST(BenchScenes, NamesAndGroupsAreFound) {
  EXPECT_EQ(find_builtin_scenes("room").size(), 1u);
  EXPECT_EQ(find_builtin_scenes("big").size(), 2u);
  EXPECT_EQ(find_builtin_scenes("big-700k").size(), 1u);
  EXPECT_TRUE(find_builtin_scenes("").empty());
  EXPECT_TRUE(find_builtin_scenes("Room").empty());
  EXPECT_EQ(builtin_scene_names(), "room, big (big-700k, big-1500k), dark, uneven");
}

TEST(BenchScenes, LanternIsOpenAtItsMouthAlone) {
  const Shape lantern = shape_of(make_dark_room(), {"paper", "soot"});
  EXPECT_EQ(lantern.open_edges, 4 * 8);  // four sides of eight edges
}

class LitScenes : public tests::DeviceTest {
 protected:
  std::unique_ptr<render::Integrator> prepared(const scene::Scene& scene,
                                               render::Settings settings) {
    settings.camera = scene.cameras.front();
    settings.samples_per_pixel = 1;
    auto integrator = render::make_integrator(settings, scene, device(), log_, 2);
    integrator->prepare([] { return false; });
    return integrator;
  }

  Log log_{Verbosity::quiet};
};

TEST_F(LitScenes, DarkRoomLightsOneHitPointInTwenty) {
  const scene::Scene scene = make_dark_room(20000);
  render::Settings settings;
  settings.width = 160;
  settings.height = 120;
  settings.photons_per_pass = 20000;
  const auto integrator = prepared(scene, settings);
  for (int pass = 0; pass < 2; ++pass) integrator->advance([] { return false; });
  const render::Picture picture = integrator->resolve();
  // The mouth: tangents of 0.3 +- 0.14 up and +- 0.14 sideways, of 0.546 and 0.728 to the edges.
  std::size_t lit = 0, lit_outside = 0;
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      if (picture.rgb[3 * (std::size_t{y} * picture.width + x)] <= 0.0f) continue;
      const bool inside = x >= 64 && x < 96 && y >= 11 && y < 43;
      ++(inside ? lit : lit_outside);
    }
  }
  // Each of these pixels sees one hit point.
  const double share =
      static_cast<double>(lit) / static_cast<double>(integrator->statistics().hit_points);
  EXPECT_LE(share, 0.05);
  EXPECT_GE(share, 0.03);
  // Discs that reach around the lantern's edges, in the mirror ball's rim: some four in 10^5.
  EXPECT_LE(static_cast<double>(lit_outside), 1e-3 * picture.width * picture.height);
}

TEST_F(LitScenes, UnevenRoomSpreadsRadiiOverAHundred) {
  const scene::Scene scene = make_uneven_room();
  const auto integrator = prepared(scene, {});
  const render::Statistics& statistics = integrator->statistics();
  EXPECT_GE(statistics.initial_radius_max / statistics.initial_radius_min, 100.0);

  // Every decade of density has its hit points. A saved state ends with lambda, R^2 and C of each.
  const render::SavedState state = integrator->save_state();
  constexpr std::size_t kRecord = 20, kRadius2 = 12;
  std::array<std::size_t, 4> decades{};
  const std::size_t records = statistics.hit_points;
  ASSERT_GE(state.size(), records * kRecord);
  for (std::size_t i = 0; i < records; ++i) {
    float radius2 = 0.0f;
    std::memcpy(&radius2, &state[state.size() - (records - i) * kRecord + kRadius2],
                sizeof radius2);
    if (radius2 <= 0.0f) continue;  // light seen
    const double largest2 = statistics.initial_radius_max * statistics.initial_radius_max;
    ++decades[static_cast<std::size_t>(
        std::clamp(std::log10(largest2 / static_cast<double>(radius2)), 0.0, 3.0))];
  }
  for (const std::size_t hit_points : decades) {
    EXPECT_GE(static_cast<double>(hit_points), 0.002 * static_cast<double>(records));
  }
}

}  // namespace
}  // namespace ppm::bench
