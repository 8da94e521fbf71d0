// Photon paths of many bounces through a large mesh, against the closed form of a corridor of
// mirrors, and the cap that ends paths which nothing else would.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "device_fixture.hpp"
#include "photon_tracer.hpp"
#include "room.hpp"
#include "scene_buffers.hpp"
#include "scene_pieces.hpp"
#include "shared/photon.h"
#include "shared/random.h"

namespace ppm::tests {
namespace {

using glm::vec3;
using shared::Photon;

class PhotonPaths : public DeviceTest {
 protected:
  struct Result {
    std::vector<Photon> photons;
    std::uint32_t cut = 0, rejected = 0;
  };

  Result trace(const scene::Scene& scene, std::uint32_t paths,
               const render::SceneTraits& traits = {}) {
    const render::SceneBuffers buffers(scene, small_settings(), device(), 2);
    gpu::BindingTable table;
    buffers.bind(table);
    render::PhotonTracer tracer(device(), table, traits, 1u << 16, 1u << 14);
    EXPECT_EQ(tracer.trace(PPM_STREAM_PHOTON, 0, 0, paths, [] { return false; }),
              render::PhotonTracer::Result::done);
    gpu::BindingTable photons;
    tracer.bind_photons(photons);
    const std::uint32_t count = tracer.photon_count();
    const auto position = photons.get(PPM_BIND_PHOTON_POSITION)->download<glm::uvec4>(count);
    const auto flux = photons.get(PPM_BIND_PHOTON_FLUX)->download<glm::uvec4>(count);
    Result result;
    for (std::uint32_t i = 0; i < count; ++i)
      result.photons.push_back(shared::unpack_photon(position[i], flux[i]));
    result.cut = tracer.counters()[PPM_COUNTER_PATHS_CUT];
    result.rejected = tracer.counters()[PPM_COUNTER_NON_FINITE];
    return result;
  }
};

constexpr float kGap = 0.025f;      // between the mirrors z = 0 and z = kGap
constexpr float kSource = 0.0125f;  // height of the lamp
constexpr float kLength = 1.9f;     // from the lamp at x = -0.95 to the screen at x = 0.95

// Two mirrors of so many rectangles and a diffuse screen; the lamp shines obliquely between them.
scene::Scene corridor(int columns, int rows) {
  scene::Scene scene;
  scene.materials = {mirror_material(), diffuse_material(0.0f)};
  scene.materials[1].base_color = vec3(1e-3f);  // takes photons, sends next to none on
  add_plate(scene, {-1, -0.5f, 0}, {2, 0, 0}, {0, 1, 0}, 0, columns, rows);
  add_plate(scene, {-1, -0.5f, kGap}, {2, 0, 0}, {0, 1, 0}, 0, columns, rows);
  add_plate(scene, {0.95f, -0.5f, -0.01f}, {0, 1, 0}, {0, 0, 0.05f}, 1);
  scene::PunctualLight lamp;
  lamp.kind = scene::PunctualKind::spot;
  lamp.position = {-0.95f, 0.0f, kSource};
  lamp.direction = glm::normalize(vec3(1.0f, 0.0f, 1.0f));
  lamp.intensity = vec3(1.0f);
  lamp.inner_cone_angle = 0.05f;
  lamp.outer_cone_angle = 0.08f;
  scene.punctual_lights.push_back(lamp);
  return finished(std::move(scene));
}

TEST_F(PhotonPaths, BouncesThroughALargeMeshAsUnfoldedStraightLines) {
  const scene::Scene scene = corridor(320, 160);
  ASSERT_GT(scene.triangles.size(), 100000u);
  for (const std::uint32_t paths : {1000u, 6000u}) {  // few a dispatch follows for longer
    const Result result = trace(scene, paths);
    EXPECT_EQ(result.cut, 0u);
    EXPECT_EQ(result.rejected, 0u);
    std::size_t arrived = 0, checked = 0;
    for (const Photon& photon : result.photons) {
      if (photon.events < 60) continue;  // what the screen sent back
      ++arrived;
      // The incident direction points back; unfolded, the path is one line. Its packed form errs by
      // 4e-5, which the corridor stretches to 1.9 * 2 * 4e-5 = 1.6e-4, two hundredths of the gap.
      const double slope = std::abs(static_cast<double>(photon.incident.z) / photon.incident.x);
      const double height = (kSource + kLength * slope) / kGap;
      const double crossed = std::floor(height);
      const double within = height - crossed;
      if (within < 0.02 || within > 0.98) continue;
      ++checked;
      EXPECT_EQ(static_cast<double>(photon.events), crossed);
      const double folded = static_cast<std::int64_t>(crossed) % 2 == 0 ? within : 1.0 - within;
      EXPECT_NEAR(photon.position.z, folded * kGap, 3e-4);
      if (HasFailure()) return;
    }
    EXPECT_EQ(arrived, paths);
    EXPECT_GT(checked, paths * 9 / 10);
  }
}

// The window of a lamp's range dims the first segment, and none of the sixty that follow, although
// they are longer: photons beside those of a lamp without a limit, path by path.
TEST_F(PhotonPaths, ARangeIsThatOfTheFirstSegment) {
  constexpr float kRange = 0.05f;
  constexpr std::uint32_t kPaths = 1000;  // few: a dispatch follows them for several bounces
  scene::Scene scene = corridor(4, 2);
  const auto arrivals = [&](float range) {
    scene.punctual_lights.front().range = range;
    std::vector<Photon> photons = trace(scene, kPaths).photons;
    std::erase_if(photons, [](const Photon& photon) { return photon.events < 60; });
    std::ranges::sort(photons, {}, [](const Photon& p) {
      return std::array{p.position.y, p.position.z};
    });
    return photons;
  };
  const auto limited = arrivals(kRange);
  const auto unlimited = arrivals(std::numeric_limits<float>::infinity());
  ASSERT_EQ(limited.size(), kPaths);
  ASSERT_EQ(unlimited.size(), kPaths);
  for (std::size_t i = 0; i < kPaths; ++i) {
    ASSERT_EQ(limited[i].position, unlimited[i].position);
    const vec3 way = limited[i].incident;
    const double first = (kGap - kSource) / std::abs(static_cast<double>(way.z));
    const double window = 1.0 - std::pow(first / kRange, 4.0);
    // Directions and fluxes are packed to 4e-5.
    EXPECT_NEAR(limited[i].flux.x / unlimited[i].flux.x, window, 2e-4);
  }
}

TEST_F(PhotonPaths, LightCaughtBetweenMirrorsIsCutAndCounted) {
  scene::Scene scene;
  scene.materials = {mirror_material()};
  const vec3 x(1.8f, 0, 0), y(0, 1.8f, 0), z(0, 0, 1.8f), low(-0.9f);
  for (const auto& [corner, a, b] : {std::tuple{low, x, y},
                                     {low + z, x, y},
                                     {low, y, z},
                                     {low + x, y, z},
                                     {low, z, x},
                                     {low + y, z, x}})
    add_plate(scene, corner, a, b, 0, 4, 4);
  scene::PunctualLight lamp;
  lamp.kind = scene::PunctualKind::point;
  lamp.position = {0.1f, 0.2f, 0.3f};
  lamp.intensity = vec3(1.0f);
  scene.punctual_lights.push_back(lamp);
  const Result result = trace(finished(std::move(scene)), 500);
  EXPECT_EQ(result.cut, 500u);  // none escapes, none is absorbed
  EXPECT_EQ(result.photons.size(), 0u);
  EXPECT_EQ(result.rejected, 0u);
}

// The kernels for plain scenes are compiled apart from those for any scene, and must be the same to
// the bit.
TEST_F(PhotonPaths, PlainScenesAreTracedAsAnyOther) {
  const scene::Scene room = bench::make_room(6000);
  const render::SceneTraits plain = render::traits_of(room);
  render::SceneTraits any = plain;
  any.textures = any.textured_lights = true;
  ASSERT_TRUE(plain.is_plain());
  ASSERT_FALSE(any.is_plain());
  const auto records = [&](const render::SceneTraits& traits) {
    std::vector<std::array<float, 10>> result;
    for (const Photon& p : trace(room, 8000, traits).photons) {
      result.push_back({p.position.x, p.position.y, p.position.z, p.incident.x, p.incident.y,
                        p.incident.z, p.flux.x, p.flux.y, p.flux.z, static_cast<float>(p.events)});
    }
    std::ranges::sort(result);  // their order is arbitrary
    return result;
  };
  const auto expected = records(any);
  EXPECT_GT(expected.size(), 8000u);
  EXPECT_EQ(records(plain), expected);
}

}  // namespace
}  // namespace ppm::tests
