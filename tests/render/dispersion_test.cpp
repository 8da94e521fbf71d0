// Dispersion: where each channel goes and how much of it, by Snell's and Fresnel's laws with its
// own index; for eye paths and for photons.
#include <cmath>
#include <numbers>
#include <string>

#include "pane.hpp"
#include "photon_tracer.hpp"
#include "render_harness.hpp"
#include "scene_buffers.hpp"
#include "shared/layout.h"
#include "shared/photon.h"
#include "shared/random.h"

namespace ppm::test {
namespace {

constexpr double kIor = 1.6, kDispersion = 6.0;  // Abbe's number 3.3: to be seen at once
// KHR_materials_dispersion, its own example.
glm::dvec3 indices(double dispersion) {
  const double half_spread = (kIor - 1.0) * 0.025 * dispersion;
  return {kIor - half_spread, kIor, kIor + half_spread};
}

Mesh face(float half) {
  return quad({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0});
}

class Dispersion : public RenderTest {};

// Photons of parallel white light through the face of a solid onto a black floor inside it: each is
// of one channel, which carries what all three did at first, and travels as Snell's law says. Their
// shares: transmittances, times flux.
TEST_F(Dispersion, BendsPhotonsByChannel) {
  constexpr std::uint32_t kPaths = 30000;
  constexpr double kTilt = 0.9;
  const glm::dvec3 color(1.0, 0.6, 0.3);
  GltfWriter writer;
  writer.mesh(face(1.0f), writer.material(glass(kIor)));
  Mesh floor = face(3.0f);
  for (glm::vec3& position : floor.positions) position.y = -1.0f;
  writer.mesh(floor, writer.material(lambert(glm::dvec3(1e-7))));
  writer.directional_light({std::sin(kTilt), -std::cos(kTilt), 0.0}, color, 1.0);
  writer.camera("any", {0.0, 1.0, 0.0}, {0.0, 0.0, 0.1}, 1.0);
  scene::Scene scene = load(writer);
  scene.materials.at(0).dispersion = static_cast<float>(kDispersion);
  const render::SceneBuffers buffers(scene, small_settings(scene), device(), 2);
  gpu::BindingTable table, photons;
  buffers.bind(table);
  render::PhotonTracer tracer(device(), table, render::traits_of(scene), 1u << 17, kPaths);
  tracer.bind_photons(photons);
  ASSERT_EQ(tracer.trace(PPM_STREAM_PHOTON, 0, 0, kPaths, [] { return false; }),
            render::PhotonTracer::Result::done);
  const std::size_t count = tracer.photon_count();
  const auto positions = photons.get(PPM_BIND_PHOTON_POSITION)->download<glm::uvec4>(count);
  const auto fluxes = photons.get(PPM_BIND_PHOTON_FLUX)->download<glm::uvec4>(count);
  glm::dvec3 through(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const shared::Photon photon = shared::unpack_photon(positions[i], fluxes[i]);
    if (photon.events != 1) continue;  // past the face
    int channel = -1;
    for (int c = 0; c < 3; ++c) {
      if (photon.flux[c] == 0.0f) continue;
      ASSERT_EQ(channel, -1) << "of several channels";
      channel = c;
    }
    const double sine = std::sin(kTilt) / indices(kDispersion)[channel];
    // Directions are kept to 7e-5.
    ASSERT_NEAR(-photon.incident.x, sine, 1e-4);
    ASSERT_NEAR(photon.incident.z, 0.0, 1e-4);
    through[channel] += photon.flux[channel];
  }
  // The face catches 4 cos(tilt) of the light's cross-section, a disc around the scene. What comes
  // through, all photons of a channel being alike, is binomial.
  const double disc = std::numbers::pi * std::pow(double(buffers.constants().bounding_radius), 2.0);
  const double scale = scene.frame.scale;
  const double share = 4.0 * scale * scale * std::cos(kTilt) / disc;
  for (int c = 0; c < 3; ++c) {
    const double t = 1.0 - interface_reflectance(std::cos(kTilt), indices(kDispersion)[c]);
    const double mean = (color.x + color.y + color.z) / 3.0;
    const double expected = kPaths * share * t * color[c] / mean;
    const double chance = share * t * color[c] / (3.0 * mean);  // a photon's flux is 3
    EXPECT_NEAR(through[c], expected, 5.0 * 3.0 * std::sqrt(kPaths * chance)) << c;
  }
}

struct Glass {
  const char* name;
  double dispersion;  // as rendered
  double expected;    // as expected
};
void PrintTo(const Glass& glass, std::ostream* stream) {
  *stream << glass.name;
}

class DispersedView : public RenderTest, public ::testing::WithParamInterface<Glass> {};

// The eye above the face of a solid sees an emitter inside, which ends at x = 0.5: each channel by
// what its own index lets through, (1 - R) / n^2, up to its own edge. Eye paths alone, without
// photons: what is left is where in a pixel they start, 16 a pixel, stratified, here beside 32 x
// 32 midpoints. A dispersion next to none is none.
TEST_P(DispersedView, ShowsEachChannelItsOwnEdge) {
  const Glass& p = GetParam();
  const glm::dvec3 radiance(2.0, 1.0, 0.5);
  GltfWriter writer;
  writer.mesh(face(8.0f), writer.material(glass(kIor)));
  writer.mesh(quad({-8, -1, -8}, {0, 0, 16}, {8.5, 0, 0}), writer.material(emitter(radiance)));
  constexpr double kFov = 1.8;
  writer.camera("down", {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, kFov, 1.0, {0.0, 0.0, -1.0});
  scene::Scene scene = load(writer);
  scene.materials.at(0).dispersion = static_cast<float>(p.dispersion);
  render::Settings settings = small_settings(scene, 16, 16, 1);
  settings.samples_per_pixel = 16;
  const auto columns =
      replicate(device(), scene, settings, 1, 4, [](const render::Picture& picture) {
        std::vector<glm::dvec3> means;
        for (std::uint32_t x = 0; x < 16; ++x)
          means.push_back(window_mean(picture, {x, 0, x + 1, 16}));
        return means;
      });
  constexpr int kParts = 32;
  glm::dvec3 seen(0.0), wanted(0.0);
  for (int x = 0; x < 16; ++x) {
    glm::dvec3 expected(0.0);
    for (int i = 0; i < kParts; ++i) {
      for (int y = 0; y < 16 * kParts; ++y) {
        const double half = std::tan(0.5 * kFov);
        const double u = (2.0 * (x + (i + 0.5) / kParts) / 16.0 - 1.0) * half;
        const double v = (2.0 * (y + 0.5) / (16.0 * kParts) - 1.0) * half;
        const double cosine = 1.0 / std::sqrt(1.0 + u * u + v * v);
        for (int c = 0; c < 3; ++c) {
          const double n = indices(p.expected)[c];
          const double below = u + u * cosine / (n * refracted_cosine(cosine, n));
          if (below > 0.5) continue;
          expected[c] += radiance[c] * (1.0 - interface_reflectance(cosine, n)) / (n * n) /
                         (16.0 * kParts * kParts);
        }
      }
    }
    // Strata of 1/4 of a pixel at the edge, on 16 rows and in four pictures: 0.06 / 8 of a pixel's
    // radiance.
    const Estimate& column = columns[static_cast<std::size_t>(x)];
    EXPECT_TRUE(agrees(column, expected, 8.0, 0.01 * radiance)) << "column " << x;
    seen += column.mean;
    wanted += expected;
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / wanted[c], 1.0, 0.003);
}

INSTANTIATE_TEST_SUITE_P(Glasses, DispersedView,
                         ::testing::Values(Glass{"strong", kDispersion, kDispersion},
                                           Glass{"none", 0.0, 0.0}, Glass{"hardly_any", 1e-4, 0.0}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace ppm::test
