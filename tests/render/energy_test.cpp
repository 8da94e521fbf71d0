// Where the emitted flux goes: photons themselves, read back after one pass.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "photon_tracer.hpp"
#include "render_harness.hpp"
#include "scene_buffers.hpp"
#include "shared/layout.h"
#include "shared/photon.h"
#include "shared/random.h"

namespace ppm::test {
namespace {

constexpr std::uint32_t kPaths = 20000;
constexpr double kSigmas = 5.0;

// Takes photons but sends none on: surfaces that are entirely black store none.
const nlohmann::json kDark = lambert(glm::dvec3(1e-7));

// What was deposited at each number of scattering events before; flux in units of what all lights
// emit a path, mean over channels.
struct Generation {
  std::uint64_t photons = 0;
  glm::dvec3 flux{0.0};
};

class Energy : public RenderTest {
 protected:
  static std::vector<Generation> deposits(GltfWriter& writer, std::uint32_t max_depth = 0) {
    writer.camera("any", {0.0, 0.0, 0.5}, {0.0, 0.0, 0.0}, 1.0);
    const scene::Scene scene = load(writer);
    render::Settings settings = small_settings(scene);
    settings.max_depth = max_depth;
    const render::SceneBuffers buffers(scene, settings, device(), 2);
    gpu::BindingTable table, photons;
    buffers.bind(table);
    render::PhotonTracer tracer(device(), table, {}, 1u << 18, kPaths);
    tracer.bind_photons(photons);
    const auto result = tracer.trace(PPM_STREAM_PHOTON, 0, 0, kPaths, [] { return false; });
    EXPECT_EQ(result, render::PhotonTracer::Result::done);
    EXPECT_EQ(tracer.counters()[PPM_COUNTER_PATHS_CUT], 0u);
    EXPECT_EQ(tracer.counters()[PPM_COUNTER_NON_FINITE], 0u);
    const std::size_t count = tracer.photon_count();
    const auto positions = photons.get(PPM_BIND_PHOTON_POSITION)->download<glm::uvec4>(count);
    const auto fluxes = photons.get(PPM_BIND_PHOTON_FLUX)->download<glm::uvec4>(count);
    std::vector<Generation> generations(32);
    for (std::size_t i = 0; i < count; ++i) {
      const shared::Photon photon = shared::unpack_photon(positions[i], fluxes[i]);
      Generation& generation = generations.at(std::min<std::size_t>(photon.events, 31));
      ++generation.photons;
      generation.flux += photon.flux;
    }
    return generations;
  }

  static GltfWriter room(nlohmann::json wall) {
    GltfWriter writer;
    writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))), writer.material(wall));
    return writer;
  }

  static void add_lamp(GltfWriter& writer, glm::dvec3 radiance) {
    writer.mesh(quad({-0.25f, 0.9f, -0.25f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.5f}),
                writer.material(with_emission(kDark, radiance)));
  }

  static double mean(glm::dvec3 v) { return (v.x + v.y + v.z) / 3.0; }
};

// Floats add some 1e-7 each; channels are kept to 2^-17 of the largest.
constexpr double kRounding = 1e-5;
constexpr double kRecordRounding = 0x1p-17;

TEST_F(Energy, ClosedRoomKeepsEverything) {
  const glm::dvec3 radiance(3.0, 2.0, 1.0);
  GltfWriter writer = room(kDark);
  add_lamp(writer, radiance);
  const auto generations = deposits(writer);
  EXPECT_EQ(generations[0].photons, kPaths) << "photons slipped through edges";
  for (int channel = 0; channel < 3; ++channel) {
    const double expected = kPaths * radiance[channel] / mean(radiance);
    EXPECT_NEAR(generations[0].flux[channel], expected, kRounding * expected);
  }
  EXPECT_EQ(generations[1].photons, 0u) << "black walls reflect";
}

// Each reflection leaves the albedo. Roulette keeps the largest channel of the flux as it is, so
// that the number of photons after n reflections is binomial with p = max(color albedo^n) /
// max(color), and the flux of each follows from n.
TEST_F(Energy, ReflectionsLeaveTheAlbedo) {
  const glm::dvec3 albedo(0.8, 0.6, 0.3), color(0.5, 1.0, 0.75);
  GltfWriter writer = room(lambert(albedo));
  writer.point_light({0.2, 0.3, -0.1}, color, 1.0);
  const auto generations = deposits(writer);
  for (int n = 0; n < 10; ++n) {
    glm::dvec3 left = color;
    for (int i = 0; i < n; ++i) left *= albedo;
    const double share = std::max({left.x, left.y, left.z}) / std::max({color.x, color.y, color.z});
    const double deviation = std::sqrt(kPaths * share * (1.0 - share));
    const Generation& generation = generations[static_cast<std::size_t>(n)];
    EXPECT_NEAR(static_cast<double>(generation.photons), kPaths * share, kSigmas * deviation) << n;
    for (int channel = 0; channel < 3; ++channel) {
      const double expected = kPaths * left[channel] / mean(color);
      const double chance = kSigmas * deviation / (kPaths * share) + kRounding;
      const double largest = kPaths * std::max({left.x, left.y, left.z}) / mean(color);
      EXPECT_NEAR(generation.flux[channel], expected, chance * expected + kRecordRounding * largest)
          << n;
    }
  }
}

// Lossless glass in a black room: whatever way photons take through it, all end on the walls.
TEST_F(Energy, GlassLosesNothing) {
  GltfWriter writer = room(kDark);
  writer.mesh(box({-0.5f, -0.6f, -0.4f}, {0.4f, 0.2f, 0.5f}), writer.material(glass(1.5)));
  writer.mesh(quad({-0.9f, 0.4f, -0.9f}, {0.0f, 0.0f, 1.8f}, {1.8f, 0.0f, 0.0f}),
              writer.material(thin_glass(1.7)));
  add_lamp(writer, glm::dvec3(1.0));
  const auto generations = deposits(writer);
  std::uint64_t photons = 0;
  double flux = 0.0;
  for (const Generation& generation : generations) {
    photons += generation.photons;
    flux += mean(generation.flux);
  }
  EXPECT_EQ(photons, kPaths);
  EXPECT_NEAR(flux, kPaths, kRounding * kPaths);
  EXPECT_GT(generations[1].photons + generations[3].photons, kPaths / 4) << "little met glass";
}

// A spot's photons start evenly over its cone and carry its falloff: their mean is what it emits.
// The falloff lies between 0 and 1 with a mean of more than a third, so its relative deviation is
// below 1.5.
TEST_F(Energy, SpotEmitsItsPower) {
  GltfWriter writer = room(kDark);
  writer.spot_light({0.1, 0.2, 0.3}, {1.0, -2.0, 0.5}, glm::dvec3(1.0), 2.0, 0.2, 0.9);
  const auto generations = deposits(writer);
  EXPECT_EQ(generations[0].photons, kPaths);
  EXPECT_NEAR(mean(generations[0].flux) / kPaths, 1.0, kSigmas * 1.5 / std::sqrt(kPaths));
}

// Some flux escapes. Between equal, aligned, parallel squares as far apart as they are wide the
// form factor is 0.19982 (2/pi (ln sqrt(4/3) + sqrt 8 atan(1/sqrt 2) - pi/2)).
TEST_F(Energy, OpenScenesLoseWhatMissesThem) {
  GltfWriter writer;
  writer.mesh(quad({-0.5f, 0.0f, -0.5f}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}),
              writer.material(lambert(glm::dvec3(0.5))));
  writer.mesh(quad({-0.5f, 1.0f, -0.5f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}),
              writer.material(emitter(glm::dvec3(2.0))));
  const double factor = 2.0 / std::numbers::pi *
                        (std::log(std::sqrt(4.0 / 3.0)) +
                         std::sqrt(8.0) * std::atan(std::sqrt(0.5)) - std::numbers::pi / 2.0);
  const auto generations = deposits(writer, 1);
  EXPECT_NEAR(mean(generations[0].flux) / kPaths, factor,
              kSigmas * std::sqrt(factor * (1.0 - factor) / kPaths));
}

// Parallel light comes through the disc around the scene's bounding sphere: of its pi r^2 = 2 pi a
// square of 2 x 2 that faces it catches 4.
TEST_F(Energy, DirectionalLightCoversTheScene) {
  GltfWriter writer;
  writer.mesh(quad({-1.0f, 0.0f, -1.0f}, {0.0f, 0.0f, 2.0f}, {2.0f, 0.0f, 0.0f}),
              writer.material(kDark));
  writer.directional_light({0.0, -1.0, 0.0}, glm::dvec3(1.0), 3.0);
  const double share = 2.0 / std::numbers::pi;
  EXPECT_NEAR(mean(deposits(writer)[0].flux) / kPaths, share,
              kSigmas * std::sqrt(share * (1.0 - share) / kPaths));
}

}  // namespace
}  // namespace ppm::test
