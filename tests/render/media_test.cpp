// Solids in solids: what eye paths and photons make of media that nest, touch and overlap, against
// Fresnel's and Beer's laws summed in double precision.
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "angles.hpp"
#include "media_materials.hpp"
#include "pane.hpp"
#include "photon_tracer.hpp"
#include "render_harness.hpp"
#include "scene_buffers.hpp"
#include "shared/photon.h"
#include "shared/random.h"

namespace ppm::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr unsigned kSeeds = 4;
constexpr double kSigmas = 9.0;  // of 4 seeds, for some hundred means: Student's t, 3e-3 each

using Media = RenderTest;

// ---- Liquid in a glass

struct Layer {
  double ior;
  glm::dvec3 attenuation;  // left after a metre
  double thickness;
};

/// Shares of light that a stack of layers in air lets through and throws back, both from above and
/// from below, all orders of reflection summed. `tint` of each transmission by a layer's index.
struct StackShares {
  glm::dvec3 through{1.0}, above{0.0}, below{0.0};
};

double interface_reflectance_between(double sine, double from, double to) {
  const double cosine = std::sqrt(1.0 - sine * sine / (from * from));
  return from < to ? interface_reflectance(cosine, to / from)
                   : interface_reflectance(std::sqrt(1.0 - sine * sine / (to * to)), from / to);
}

StackShares stack_shares(const std::vector<Layer>& layers, double cosine, glm::dvec3 tint) {
  const double sine = std::sqrt(1.0 - cosine * cosine);  // times the index: the same everywhere
  StackShares all;
  double index = 1.0;
  for (std::size_t i = 0; i <= layers.size(); ++i) {
    const double next = i < layers.size() ? layers[i].ior : 1.0;
    const glm::dvec3 r(interface_reflectance_between(sine, index, next));
    const glm::dvec3 t = tint * (1.0 - r);
    const glm::dvec3 between = 1.0 / (1.0 - all.below * r);
    StackShares sum;
    sum.through = all.through * t * between;
    sum.above = all.above + all.through * all.through * r * between;
    sum.below = r + t * t * all.below * between;
    if (i < layers.size()) {
      const double length = layers[i].thickness / std::sqrt(1.0 - sine * sine / (next * next));
      const glm::dvec3 a = glm::pow(layers[i].attenuation, glm::dvec3(length));
      sum.through *= a;
      sum.below *= a * a;
    }
    all = sum;
    index = next;
  }
  return all;
}

struct Vessel {
  const char* name;
  double overlap;  // of liquid and each glass, metres
  int liquid_priority;
  double ior = 1.5, liquid_ior = 1.33;
  glm::dvec3 tint{1.0};
  double dispersion = 0.0;  // of both
};
void PrintTo(const Vessel& vessel, std::ostream* stream) {
  *stream << vessel.name;
}

constexpr double kGlass = 0.4, kLiquid = 0.6;  // thickness
const glm::dvec3 kGlassLeft(0.7, 0.9, 0.8), kLiquidLeft(0.4, 0.6, 0.9);

class VesselTest : public RenderTest, public ::testing::WithParamInterface<Vessel> {
 protected:
  // Two plates of glass and what is between them, from y = 0 upwards.
  static void add_vessel(GltfWriter& writer, double half) {
    const Vessel& vessel = GetParam();
    auto pane = glass(vessel.ior, kGlassLeft, 1.0);
    pane["pbrMetallicRoughness"]["baseColorFactor"] = {vessel.tint.x, vessel.tint.y, vessel.tint.z,
                                                       1.0};
    auto liquid = with_priority(glass(vessel.liquid_ior, kLiquidLeft, 1.0), vessel.liquid_priority);
    liquid["pbrMetallicRoughness"]["baseColorFactor"] =
        pane["pbrMetallicRoughness"]["baseColorFactor"];
    for (nlohmann::json* const material : {&pane, &liquid}) {
      if (vessel.dispersion == 0.0) continue;
      (*material)["extensions"]["KHR_materials_dispersion"]["dispersion"] = vessel.dispersion;
    }
    const std::size_t glass_index = writer.material(pane);
    const auto slab = [&](double low, double high, double reach, std::size_t material) {
      writer.mesh(box(glm::dvec3(-reach, low, -reach), glm::dvec3(reach, high, reach)), material);
    };
    slab(0.0, kGlass, half, glass_index);
    slab(kGlass + kLiquid, 2.0 * kGlass + kLiquid, half, glass_index);
    slab(kGlass - vessel.overlap, kGlass + kLiquid + vessel.overlap, half - 0.01,
         writer.material(liquid));
  }

  /// By channel, with the indices of KHR_materials_dispersion's example.
  static glm::dvec3 through(double cosine) {
    const double bend = 0.025 * GetParam().dispersion;
    return {stack_shares(layers(1.0 - bend), cosine, GetParam().tint).through.x,
            stack_shares(layers(1.0), cosine, GetParam().tint).through.y,
            stack_shares(layers(1.0 + bend), cosine, GetParam().tint).through.z};
  }

 private:
  /// `bend` multiplies n - 1.
  static std::vector<Layer> layers(double bend) {
    const Vessel& vessel = GetParam();
    const auto bent = [&](double ior) { return 1.0 + bend * (ior - 1.0); };
    const bool liquid_first = vessel.liquid_priority > 0 ||
                              (vessel.liquid_priority == 0 && vessel.liquid_ior > vessel.ior);
    const double shift = liquid_first ? vessel.overlap : 0.0;
    return {{bent(vessel.ior), kGlassLeft, kGlass - shift},
            {bent(vessel.liquid_ior), kLiquidLeft, kLiquid + 2.0 * shift},
            {bent(vessel.ior), kGlassLeft, kGlass - shift}};
  }
};

// As PaneTest.ShowsAPanelBehindIt, whose bias holds for each of three layers; touching surfaces are
// moved by 2^-18 of the frame's 32 units besides, 1.2e-4 of attenuation 0.9 a metre.
constexpr double kBias = 1.5e-3;

TEST_P(VesselTest, ShowsAPanelBehindIt) {
  const glm::dvec3 radiance(2.0, 1.0, 0.5);
  GltfWriter writer;
  add_vessel(writer, 30.0);
  writer.mesh(quad({-30, -1, -30}, {0, 0, 60}, {60, 0, 0}), writer.material(emitter(radiance)));
  writer.camera("down", {0.0, 2.0, 0.0}, {0.0, 0.0, 0.0}, 2.4, 1.0, {0.0, 0.0, -1.0});
  const scene::Scene scene = load(writer);
  const render::Settings settings = small_settings(scene, 48, 48, 1);
  const auto blocks =
      replicate(device(), scene, settings, 1, kSeeds,
                [](const render::Picture& picture) { return block_means(picture, 8); });
  const auto expected =
      expected_blocks(settings, 8, [&](double cosine) { return radiance * through(cosine); });
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_TRUE(agrees(blocks[i], expected[i], kSigmas, kBias * expected[i])) << "block " << i;
}

// Photons on the other side: a dark floor below the vessel, parallel light from above, and a camera
// between the two. The floor sends back 1/50, of which the vessel reflects less than a third. Light
// that enters by the vessel's sides is totally reflected at its bottom, since n^2 > 1 + cos^2 tilt.
TEST_P(VesselTest, LetsPhotonsThrough) {
  const glm::dvec3 irradiance(3.0, 2.0, 5.0), albedo(0.02);
  const double tilt = 0.65;
  GltfWriter writer;
  add_vessel(writer, 2.0);
  writer.mesh(quad({-1, -0.6, -1}, {0, 0, 2}, {2, 0, 0}), writer.material(lambert(albedo)));
  writer.directional_light({std::sin(tilt), -std::cos(tilt), 0.0}, irradiance / 5.0, 5.0);
  writer.camera("down", {0.0, -0.1, 0.0}, {0.0, -1.0, 0.0}, 1.0, 1.0, {0.0, 0.0, -1.0});
  const scene::Scene scene = load(writer);
  render::Settings settings = small_settings(scene, 8, 8, 100000);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.4;
  const Estimate estimate = replicate(device(), scene, settings, 1, kSeeds, whole(settings));
  const glm::dvec3 expected = albedo / kPi * irradiance * std::cos(tilt) * through(std::cos(tilt));
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, (kBias + 0.02 / 3.0) * expected));
}

INSTANTIATE_TEST_SUITE_P(Vessels, VesselTest,
                         ::testing::Values(Vessel{"overlapping", 0.02, 0},
                                           Vessel{"touching", 0.0, 0},
                                           Vessel{"liquid_first", 0.05, 1},
                                           Vessel{"touching_liquid_first", 0.0, 7},
                                           Vessel{"dense_liquid", 0.02, -1, 1.3, 1.7},
                                           Vessel{"tinted", 0.02, 0, 1.6, 1.4, {0.9, 0.7, 0.8}},
                                           Vessel{"dispersive", 0.02, 0, 1.5, 1.33, {1, 1, 1}, 6}),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- Cameras and lamps in media

// Down through the lower face of a slab that the camera stands in: radiance in a medium is n^2
// times that in air, and what the lower face reflects comes back from the upper one.
TEST_F(Media, CameraInGlassSeesNSquaredOfTheAir) {
  const double ior = 1.4, height = 0.5, thickness = 1.2;
  const glm::dvec3 left(0.8, 0.6, 0.9), radiance(1.0, 2.0, 3.0);
  GltfWriter writer;
  writer.mesh(box({-30, -0.5, -30}, {30, 0.7, 30}), writer.material(glass(ior, left, 1.0)));
  writer.mesh(quad({-30, -2, -30}, {0, 0, 60}, {60, 0, 0}), writer.material(emitter(radiance)));
  writer.camera("in", {0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 0.8, 1.0, {0.0, 0.0, -1.0});
  const scene::Scene scene = load(writer);
  const render::Settings settings = small_settings(scene, 32, 32, 1);
  const auto blocks =
      replicate(device(), scene, settings, 1, kSeeds,
                [](const render::Picture& picture) { return block_means(picture, 8); });
  const auto expected = expected_blocks(settings, 8, [&](double cosine) {
    const double outside = std::sqrt(1.0 - ior * ior * (1.0 - cosine * cosine));
    const double r = interface_reflectance(outside, ior);
    const glm::dvec3 once = glm::pow(left, glm::dvec3(thickness / cosine));
    return ior * ior * radiance * (1.0 - r) * glm::pow(left, glm::dvec3(height / cosine)) /
           (1.0 - r * r * once * once);
  });
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_TRUE(agrees(blocks[i], expected[i], kSigmas, kBias * expected[i])) << "block " << i;
}

enum class LampKind { point, spot, triangles, glowing_glass };
class LampTest : public RenderTest, public ::testing::WithParamInterface<LampKind> {};

// A lamp in the middle of a ball of glass within a larger one of liquid: whatever it sends out
// meets both surfaces at a right angle, and what they reflect comes back through the middle. With r
// and a = 1 - r of the inner surface, R of the outer, absorption b and c once through each shell:
//   up through the inner surface and out, all orders summed as for a stack.
// The balls are icospheres of four subdivisions with smooth normals: light meets the facets up to
// 0.046 away from the right angle, where Fresnel's reflectance is constant to 1e-4, and ways within
// are shorter by up to 0.1 %, in a medium of optical depth 1 at most. Light that comes back misses
// the middle by less than a tenth of the radius, which makes its next way longer by 0.5 % at most.
TEST_P(LampTest, ShinesOutOfNestedBalls) {
  constexpr std::uint32_t kPaths = 20000;
  const double inner = 0.4, outer = 0.8;
  const glm::dvec3 glass_left(0.5, 0.8, 0.3), liquid_left(0.6, 0.3, 0.9);
  const nlohmann::json dark = lambert(glm::dvec3(1e-7));
  GltfWriter writer;
  writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))), writer.material(dark));
  writer.mesh(icosphere(4), writer.material(glass(1.6, glass_left, 1.0)), placed({0, 0, 0}, inner));
  writer.mesh(icosphere(4), writer.material(glass(1.3, liquid_left, 1.0)),
              placed({0, 0, 0}, outer));
  const glm::dvec3 color(1.0, 0.8, 0.6);
  if (GetParam() == LampKind::point) writer.point_light({0, 0, 0}, color, 1.0);
  if (GetParam() == LampKind::spot)
    writer.spot_light({0, 0, 0}, {0.3, 1, 0.2}, color, 1.0, 0.5, 1.0);
  if (GetParam() == LampKind::triangles) {
    auto material = with_emission(dark, color);
    material["doubleSided"] = true;
    writer.mesh(quad({-0.002, 0, -0.002}, {0, 0, 0.004}, {0.004, 0, 0}), writer.material(material));
  }
  // Of the glass around it, so that its light goes out and through it as if it were not there; but
  // it must know on which side of its surface it begins.
  if (GetParam() == LampKind::glowing_glass) {
    auto material = with_emission(glass(1.6, glass_left, 1.0), color);
    material["doubleSided"] = true;
    writer.mesh(box(glm::vec3(-0.002f), glm::vec3(0.002f)), writer.material(material));
  }
  writer.camera("any", {0.0, 0.0, 0.9}, {0.0, 0.0, 0.0}, 1.0);
  const scene::Scene scene = load(writer);
  const render::SceneBuffers buffers(scene, small_settings(scene), device(), 2);
  gpu::BindingTable table, photons;
  buffers.bind(table);
  render::PhotonTracer tracer(device(), table, {}, 1u << 18, kPaths);
  tracer.bind_photons(photons);
  ASSERT_EQ(tracer.trace(PPM_STREAM_PHOTON, 0, 0, kPaths, [] { return false; }),
            render::PhotonTracer::Result::done);
  const std::size_t count = tracer.photon_count();
  const auto positions = photons.get(PPM_BIND_PHOTON_POSITION)->download<glm::uvec4>(count);
  const auto fluxes = photons.get(PPM_BIND_PHOTON_FLUX)->download<glm::uvec4>(count);
  glm::dvec3 arrived(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const shared::Photon photon = shared::unpack_photon(positions[i], fluxes[i]);
    // On the walls, not on the lamp.
    if (glm::length(photon.position) > 0.5f) arrived += glm::dvec3(photon.flux);
  }
  // Outwards through half a stack, from the middle, where light that comes back only passes.
  const auto reflectance = [](double from, double to) {
    return glm::dvec3(std::pow((from - to) / (from + to), 2.0));
  };
  const glm::dvec3 r = reflectance(1.6, 1.3), R = reflectance(1.3, 1.0), one(1.0);
  const glm::dvec3 b = glm::pow(glass_left, glm::dvec3(inner));
  const glm::dvec3 c = glm::pow(liquid_left, glm::dvec3(outer - inner));
  const glm::dvec3 shell = one / (one - r * c * c * R);
  const glm::dvec3 out = (one - r) * c * (one - R) * shell;
  const glm::dvec3 back = r + (one - r) * (one - r) * c * c * R * shell;
  const glm::dvec3 escapes = b * out / (one - back * b * b);
  const double mean = (color.x + color.y + color.z) / 3.0;
  for (int channel = 0; channel < 3; ++channel) {
    const double expected = kPaths * color[channel] / mean * escapes[channel];
    // Lossy light is roulette: at most a deviation of 1 a path.
    EXPECT_NEAR(arrived[channel], expected, 5.0 * std::sqrt(kPaths) * 0.6 + 0.006 * expected);
  }
}
std::string lamp_name(const ::testing::TestParamInfo<LampKind>& test) {
  constexpr const char* kNames[] = {"point", "spot", "triangles", "glowing_glass"};
  return kNames[static_cast<int>(test.param)];
}
INSTANTIATE_TEST_SUITE_P(Kinds, LampTest,
                         ::testing::Values(LampKind::point, LampKind::spot, LampKind::triangles,
                                           LampKind::glowing_glass),
                         lamp_name);

// ---- A furnace

// In a room that shines alike everywhere nothing lossless can be seen: a ball of glass that a ball
// of liquid overlaps, a bubble of air in it, a denser ball within. Only roulette among faint
// branches leaves noise.
TEST_F(Media, NestIsInvisibleInAFurnace) {
  GltfWriter writer;
  writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))),
              writer.material(emitter({1.0, 1.0, 1.0})));
  const std::size_t crown = writer.material(glass(1.5));
  const std::size_t water = writer.material(glass(1.33));
  const std::size_t dense = writer.material(with_priority(glass(1.9), 5));
  writer.mesh(icosphere(3, Shading::flat), crown, placed({-0.1, 0.0, -0.2}, 0.4));
  writer.mesh(icosphere(3, Shading::flat), water, placed({0.25, 0.1, -0.1}, 0.35));
  writer.mesh(icosphere(2, Shading::flat), dense, placed({0.05, 0.0, 0.0}, 0.15));
  writer.mesh(inside_out(icosphere(2, Shading::flat)), crown, placed({-0.3, 0.0, -0.2}, 0.12));
  writer.camera("any", {0.0, 0.0, 0.9}, {0.0, 0.0, 0.0}, 0.9);
  const scene::Scene scene = load(writer);
  // Enough photons for the few paths that flat facets trap to be no more than the harness allows.
  const render::Settings settings = small_settings(scene, 32, 32, 40000);
  const auto blocks =
      replicate(device(), scene, settings, 1, kSeeds,
                [](const render::Picture& picture) { return block_means(picture, 8); });
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_TRUE(agrees(blocks[i], glm::dvec3(1.0), kSigmas, 2e-3)) << "block " << i;
}

}  // namespace
}  // namespace ppm::test
