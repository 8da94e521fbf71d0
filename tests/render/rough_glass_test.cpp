// Rough glass: what it shows of light on either side, and what it lets fall on a floor, against
// quadrature over its facets; what is left of a furnace's light around it.
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "facets.hpp"
#include "photon_tracer.hpp"
#include "render_harness.hpp"
#include "scene_buffers.hpp"
#include "shared/layout.h"
#include "shared/photon.h"
#include "shared/random.h"

namespace ppm::test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;
constexpr double kSigmas = 5.0;  // of 8 seeds: Student's t with 7 degrees, 0.16 %
constexpr unsigned kPasses = 4, kSeeds = 8;

json rough(json glass_material, double roughness, glm::dvec3 tint = glm::dvec3(1.0)) {
  glass_material["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
  glass_material["pbrMetallicRoughness"]["baseColorFactor"] = {tint.x, tint.y, tint.z, 1.0};
  return glass_material;
}

Mesh sheet(float half, float height = 0.0f) {
  return quad({-half, height, -half}, {0, 0, 2 * half}, {2 * half, 0, 0});
}

// Half of a black shell of radius 1 that emits to its inside, down to the plane y = 0.
Mesh half_shell(bool upper) {
  const Mesh whole = inside_out(icosphere(3, Shading::flat));
  Mesh half;
  for (std::size_t i = 0; i < whole.indices.size(); i += 3) {
    glm::vec3 corners[3];
    float most = 0.0f;
    for (std::size_t j = 0; j < 3; ++j) {
      corners[j] = whole.positions[whole.indices[i + j]];
      most = std::max(most, upper ? corners[j].y : -corners[j].y);
      // The half ends at the sheet's plane: corners beyond are drawn to it.
      corners[j].y = upper ? std::max(corners[j].y, 0.0f) : std::min(corners[j].y, 0.0f);
    }
    if (most < 1e-4f) continue;
    for (const glm::vec3& corner : corners) {
      half.indices.push_back(static_cast<std::uint32_t>(half.positions.size()));
      half.positions.push_back(corner);
    }
  }
  return half;
}

struct Interface {
  const char* name;
  double ior, roughness, cosine;  // of the view
  bool thin, from_inside;
};
void PrintTo(const Interface& interface, std::ostream* stream) {
  *stream << interface.name;
}

class RoughInterface : public RenderTest, public ::testing::WithParamInterface<Interface> {};

// A sheet between two halves of a shell that shine with L1 on the eye's side and L2 beyond shows
// R L1 + T L2 / eta^2: a share T of the light that comes along the view from the eye would get
// through, and radiance changes with the square of the index. Nothing comes back: the shell is
// black. All discs lie within the sheet, where irradiance is constant. Bias: 16-bit directions and
// parameters move the lobe's argument by 1e-4, which its slope multiplies by up to 1 / alpha, on
// one side of it as on the other; 0.3 % are granted.
TEST_P(RoughInterface, ShowsBothSides) {
  const Interface& p = GetParam();
  const glm::dvec3 here(1.0, 0.2, 2.0), beyond(0.3, 3.0, 1.0), tint(0.9, 0.8, 0.4);
  GltfWriter writer;
  writer.mesh(half_shell(!p.from_inside), writer.material(emitter(here)));
  writer.mesh(half_shell(p.from_inside), writer.material(emitter(beyond)));
  writer.mesh(sheet(0.62f),
              writer.material(rough(p.thin ? thin_glass(p.ior) : glass(p.ior), p.roughness, tint)));
  const double sine = std::sqrt(1.0 - p.cosine * p.cosine), side = p.from_inside ? -1.0 : 1.0;
  writer.camera("oblique", {0.6 * sine, 0.6 * p.cosine * side, 0.0}, {0, 0, 0}, 0.1);
  const scene::Scene scene = load(writer);
  render::Settings settings = small_settings(scene, 4, 4, 10000);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.5;
  const Estimate estimate = replicate(device(), scene, settings, 2, kSeeds, whole(settings));
  const double eta = p.from_inside && !p.thin ? 1.0 / p.ior : p.ior;
  const FacetShares shares = facet_shares(p.roughness * p.roughness, eta, p.cosine, p.thin);
  const double scale = p.thin ? 1.0 : 1.0 / (eta * eta);
  const glm::dvec3 expected = shares.reflected * here + shares.transmitted * scale * tint * beyond;
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, 0.003 * expected));
}

INSTANTIATE_TEST_SUITE_P(
    Interfaces, RoughInterface,
    ::testing::Values(Interface{"entering", 1.5, 0.6, 0.8, false, false},
                      Interface{"leaving", 1.5, 0.6, 0.9, false, true},
                      Interface{"leaving_totally_reflected", 1.5, 0.5, 0.5, false, true},
                      Interface{"thin", 1.5, 0.6, 0.6, true, false},
                      Interface{"thin_from_behind", 1.7, 0.5, 0.8, true, true}),
    [](const auto& test) { return std::string(test.param.name); });

struct Ceiling {
  const char* name;
  double ior, roughness, tilt;  // of the light, from the vertical
  bool thin, from_inside;
};
void PrintTo(const Ceiling& ceiling, std::ostream* stream) {
  *stream << ceiling.name;
}

class RoughCeiling : public RenderTest, public ::testing::WithParamInterface<Ceiling> {};

// A narrow beam falls on a rough sheet that divides a black room. Of its flux a share T, tinted,
// goes on below the sheet, and a share R above it. Both are sums over photons whose weights, by
// sampling visible facets, lie between 0 and 1: deviations are below 0.5 a photon. The beam's width
// of 0.02 moves the shares by less than 0.002.
TEST_P(RoughCeiling, SharesOutABeam) {
  const Ceiling& p = GetParam();
  constexpr std::uint32_t kPaths = 20000;
  const glm::dvec3 tint(1.0, 0.8, 0.5);
  GltfWriter writer;
  const json material = rough(p.thin ? thin_glass(p.ior) : glass(p.ior), p.roughness, tint);
  writer.mesh(p.from_inside ? inside_out(sheet(1.0f)) : sheet(1.0f), writer.material(material));
  writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))),
              writer.material(lambert(glm::dvec3(1e-7))));
  const glm::dvec3 way(std::sin(p.tilt), -std::cos(p.tilt), 0.0);
  writer.spot_light(-0.9 * way, way, glm::dvec3(1.0), 1.0, 0.01, 0.02);
  writer.camera("any", {0.0, 0.5, 0.5}, {0.0, 0.0, 0.0}, 1.0);
  const scene::Scene scene = load(writer);
  const render::SceneBuffers buffers(scene, small_settings(scene), device(), 2);
  gpu::BindingTable table, stored;
  buffers.bind(table);
  render::PhotonTracer tracer(device(), table, render::traits_of(scene), 4 * kPaths, kPaths);
  tracer.bind_photons(stored);
  ASSERT_EQ(tracer.trace(PPM_STREAM_PHOTON, 0, 0, kPaths, [] { return false; }),
            render::PhotonTracer::Result::done);
  const std::size_t count = tracer.photon_count();
  const auto positions = stored.get(PPM_BIND_PHOTON_POSITION)->download<glm::uvec4>(count);
  const auto fluxes = stored.get(PPM_BIND_PHOTON_FLUX)->download<glm::uvec4>(count);
  glm::dvec3 above(0.0), beneath(0.0);
  double arrived = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const shared::Photon photon = shared::unpack_photon(positions[i], fluxes[i]);
    const double y = scene.frame.to_world(photon.position).y;
    if (photon.events == 0) {
      EXPECT_NEAR(y, 0.0, 1e-5);
      // The normal that is kept is that of the sheet's front.
      EXPECT_EQ(photon.normal.y, p.from_inside ? -1.0f : 1.0f);
      arrived += photon.flux.x;
    } else {
      ASSERT_EQ(photon.events, 1u);
      (y < 0.0 ? beneath : above) += glm::dvec3(photon.flux);
    }
  }
  EXPECT_GT(arrived, 0.0);
  const double eta = p.from_inside && !p.thin ? 1.0 / p.ior : p.ior;
  const FacetShares shares = facet_shares(p.roughness * p.roughness, eta, std::cos(p.tilt), p.thin);
  const double chance = kSigmas * 0.5 / std::sqrt(kPaths) + 0.002;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(beneath[c] / arrived, tint[c] * shares.transmitted, chance) << c;
    EXPECT_NEAR(above[c] / arrived, shares.reflected, chance) << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Ceilings, RoughCeiling,
                         ::testing::Values(Ceiling{"entering", 1.5, 0.6, 0.7, false, false},
                                           Ceiling{"leaving", 1.5, 0.4, 0.65, false, true},
                                           Ceiling{"thin", 1.5, 0.5, 1.2, true, false}),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- Coats

struct Coating {
  const char* name;
  double cosine, strength, roughness;  // of the coat
};
void PrintTo(const Coating& coating, std::ostream* stream) {
  *stream << coating.name;
}

class CoatedPlate : public RenderTest, public ::testing::WithParamInterface<Coating> {};

// In light that comes alike from everywhere a Lambertian plate under a coat shows e times the
// coat's share F, by quadrature where it is rough, and albedo times what passes it, 1 - F of a
// smooth coat.
TEST_P(CoatedPlate, ShowsItsDirectionalAlbedo) {
  const Coating& p = GetParam();
  const glm::dvec3 emission(1.0, 2.0, 0.5), albedo(0.9, 0.5, 0.2);
  GltfWriter writer;
  writer.mesh(inside_out(icosphere(2, Shading::flat)), writer.material(emitter(emission)));
  const std::size_t plate = writer.material(lambert(albedo));
  writer.mesh(sheet(0.5f), plate);
  const double sine = std::sqrt(1.0 - p.cosine * p.cosine);
  writer.camera("oblique", {0.6 * sine, 0.6 * p.cosine, 0.0}, {0, 0, 0}, 0.1);
  scene::Scene scene = load(writer);
  scene.materials.at(1).clearcoat = static_cast<float>(p.strength);
  scene.materials.at(1).clearcoat_roughness = static_cast<float>(p.roughness);
  render::Settings settings = small_settings(scene, 4, 4, 20000);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.25;
  const Estimate estimate = replicate(device(), scene, settings, 2, kSeeds, whole(settings));
  const double smooth = p.strength * (0.04 + 0.96 * std::pow(1.0 - p.cosine, 5.0));
  const double coat = p.roughness > 0.0 ? coat_share(p.roughness * p.roughness, 0.04 * p.strength,
                                                     p.strength, p.cosine)
                                        : smooth;
  const glm::dvec3 expected = emission * (coat + albedo * (1.0 - smooth));
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, 0.002 * expected));
}

INSTANTIATE_TEST_SUITE_P(Coatings, CoatedPlate,
                         ::testing::Values(Coating{"smooth", 0.8, 1.0, 0.0},
                                           Coating{"smooth_oblique", 0.3, 1.0, 0.0},
                                           Coating{"half_rough", 0.5, 0.5, 0.5},
                                           Coating{"rough", 0.3, 1.0, 0.8}),
                         [](const auto& test) { return std::string(test.param.name); });

class CoatedLamp : public RenderTest {};

// A lamp under a coat is seen by 1 - F of the view, and lights a plate far below it by 1 - F of the
// angle it is seen at from there: here the normal, 0.96.
TEST_F(CoatedLamp, IsDimmedForEyesAndPhotonsAlike) {
  const glm::dvec3 radiance(2.0, 1.0, 0.5);
  GltfWriter writer;
  writer.mesh(inside_out(sheet(0.02f, 1.0f)), writer.material(emitter(radiance)));
  writer.mesh(sheet(0.2f), writer.material(lambert(glm::dvec3(0.5))));
  writer.camera("up", {0.0, 0.5, 0.0}, {0.0, 1.0, 0.0}, 0.05, 1.0, {0.0, 0.0, -1.0});
  writer.camera("down", {0.0, 0.5, 0.0}, {0.0, 0.0, 0.0}, 0.1, 1.0, {0.0, 0.0, -1.0});
  scene::Scene scene = load(writer);
  scene.materials.at(0).clearcoat = 1.0f;
  render::Settings settings = small_settings(scene, 4, 4, 50000);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.05;
  settings.max_depth = 1;
  const auto seen = render_scene(device(), scene, settings, 1).picture;
  // 1e-4: Schlick's term within 0.035 of the normal, to the fifth power, is nothing.
  EXPECT_LT(glm::length(window_mean(seen, whole(settings)) - 0.96 * radiance), 1e-4);
  settings.camera = scene.cameras.at(1);
  const Estimate estimate = replicate(device(), scene, settings, kPasses, kSeeds, whole(settings));
  // A lamp of 0.04 x 0.04 at distance 1 gives L A / d^2, less 0.1 % or so by its extent and the
  // plate's, which reach 0.055 from the axis.
  const glm::dvec3 expected = 0.5 / kPi * 0.96 * radiance * 0.0016;
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, 0.005 * expected));
}

}  // namespace
}  // namespace ppm::test
