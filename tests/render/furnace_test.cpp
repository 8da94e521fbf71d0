// Closed scenes in which radiance is the same everywhere: whatever shows is an error.
//
// In a closed room whose walls all emit e and reflect a share rho of what arrives, without regard
// to direction, L = e + rho L, hence L = e / (1 - rho). Nothing put into it that loses no energy
// changes that, whether it reflects, refracts or scatters.
//
// Bias of the estimate. A ball of radius R about a point of a sphere cuts pi R^2 from it for every
// R (Archimedes), so that progressive photon mapping is unbiased there but for two things. The
// walls are an icosphere of four subdivisions: its facets are tilted by up to their circumradius d
// = 0.046 against the sphere, and lie up to d^2 / 2 below it, so that areas and with them estimates
// of reflected radiance err by at most 2 d^2 = 0.4 %. And photons that come from below the hit
// point's own horizon do not count: where the surface turns by t within the disc, a share of (1 -
// cos t) / 2, at most R^2 / 4 on a unit sphere.
#include <glm/gtc/matrix_transform.hpp>
#include <ostream>
#include <string>

#include "render_harness.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

constexpr double kRadius = 0.05;         // first search radius; the furnaces have radius 1
constexpr double kTessellation = 0.004;  // 2 d^2, see above
constexpr double kWallBias = kTessellation + kRadius * kRadius / 4.0;
// Of a ball inside the furnace, of radius 0.35 or 0.2: R is larger beside it.
constexpr double kBallBias = kTessellation + kRadius * kRadius / (4.0 * 0.35 * 0.35);
constexpr double kSmallBallBias = kTessellation + kRadius * kRadius / (4.0 * 0.2 * 0.2);
constexpr double kSigmas = 5.0;  // of 8 seeds: Student's t with 7 degrees, 0.16 %
constexpr unsigned kPasses = 3, kSeeds = 8;

glm::dvec3 furnace_radiance(glm::dvec3 emission, glm::dvec3 albedo) {
  return emission / (1.0 - albedo);
}

// A round furnace of radius 1 about the origin.
void add_furnace(GltfWriter& writer, glm::dvec3 emission, glm::dvec3 albedo) {
  writer.mesh(inside_out(icosphere(4, Shading::flat)),
              writer.material(with_emission(lambert(albedo), emission)));
}

render::Settings furnace_settings(const scene::Scene& scene, std::uint64_t photons = 20000) {
  render::Settings settings = small_settings(scene, 16, 16, photons);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = kRadius;
  return settings;
}

struct Walls {
  const char* name;
  glm::dvec3 emission, albedo;
};
void PrintTo(const Walls& walls, std::ostream* stream) {
  *stream << walls.name;
}

class Furnace : public RenderTest, public ::testing::WithParamInterface<Walls> {};

TEST_P(Furnace, SphereShinesAlikeEverywhere) {
  const auto& [name, emission, albedo] = GetParam();
  GltfWriter writer;
  add_furnace(writer, emission, albedo);
  writer.camera("inside", {0.1, 0.0, 0.2}, {0.3, 0.2, -1.0}, 2.0);
  const scene::Scene scene = load(writer);
  const auto settings = furnace_settings(scene);
  const Estimate estimate = replicate(device(), scene, settings, kPasses, kSeeds, whole(settings));
  const glm::dvec3 expected = furnace_radiance(emission, albedo);
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, kWallBias * (expected - emission)));
}

TEST_P(Furnace, BoxShinesAlikeFarFromItsEdges) {
  // The camera looks at [-0.55, 0.55]^2 of a wall [-1, 1]^2: no disc of radius 0.05 reaches an
  // edge, so that there is no bias at all but rounding.
  const auto& [name, emission, albedo] = GetParam();
  GltfWriter writer;
  writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))),
              writer.material(with_emission(lambert(albedo), emission)));
  writer.camera("inside", {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 1.0);
  const scene::Scene scene = load(writer);
  const auto settings = furnace_settings(scene);
  const Estimate estimate = replicate(device(), scene, settings, kPasses, kSeeds, whole(settings));
  const glm::dvec3 expected = furnace_radiance(emission, albedo);
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, 1e-4 * expected));
}

INSTANTIATE_TEST_SUITE_P(Albedos, Furnace,
                         ::testing::Values(Walls{"grey", glm::dvec3(1.0), glm::dvec3(0.5)},
                                           Walls{"coloured", {0.5, 1.0, 0.25}, {0.3, 0.8, 0.1}},
                                           Walls{"bright", {0.1, 0.05, 20.0}, {0.9, 0.85, 0.02}},
                                           Walls{"black", {1.0, 2.0, 3.0}, glm::dvec3(0.0)}),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- What must not show

json white_metal() {
  return metal(glm::dvec3(1.0));
}

json opaque_smooth_dielectric() {
  return {{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.0}}}};
}

json rough(json glass_material) {
  glass_material["pbrMetallicRoughness"]["roughnessFactor"] = 0.1;
  return glass_material;
}

json with_extension(json material, const char* extension, json content) {
  material["extensions"][extension] = std::move(content);
  return material;
}

json half_transparent(json glass_material) {
  glass_material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0.5;
  return glass_material;
}

/// alphaMode BLEND.
json half_covering(json material) {
  material["alphaMode"] = "BLEND";
  material["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 1.0, 1.0, 0.5};
  return material;
}

glm::dmat4 turned(double scale) {
  return glm::rotate(placed({0.03, 0.02, -0.1}, scale), 0.6, glm::dvec3(0.3, 1.0, 0.2));
}

Mesh unit_box() {
  return box(glm::vec3(-0.7f), glm::vec3(0.7f));
}

struct Guest {
  const char* name;
  double bias;  // relative, of the whole radiance
  void (*add)(GltfWriter& writer);
};
void PrintTo(const Guest& guest, std::ostream* stream) {
  *stream << guest.name;
}

// Every guest loses no energy. What is flat-shaded and only reflects or refracts is exact. Guests
// that scatter diffusely hold hit points of their own, on a sphere that is as fine as the walls.
const Guest kGuests[] = {
    {"glass_cube", 0.0,
     [](GltfWriter& w) { w.mesh(unit_box(), w.material(glass(1.5)), turned(0.35)); }},
    {"dense_glass_cube", 0.0,
     [](GltfWriter& w) { w.mesh(unit_box(), w.material(glass(2.4)), turned(0.35)); }},
    {"faceted_glass_ball", 0.0,
     [](GltfWriter& w) {
       w.mesh(icosphere(2, Shading::flat), w.material(glass(1.5)), turned(0.35));
     }},
    {"thin_sheet", 0.0,
     [](GltfWriter& w) {
       w.mesh(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), w.material(thin_glass(1.5)), turned(0.3));
     }},
    {"bubble", 0.0,
     [](GltfWriter& w) {
       w.mesh(icosphere(2, Shading::flat), w.material(thin_glass(1.8)), turned(0.35));
     }},
    {"mirror_cube", 0.0,
     [](GltfWriter& w) { w.mesh(unit_box(), w.material(white_metal()), turned(0.35)); }},
    {"faceted_mirror_ball", 0.0,
     [](GltfWriter& w) {
       w.mesh(icosphere(2, Shading::flat), w.material(white_metal()), turned(0.35));
     }},
    {"white_ball", kBallBias,
     [](GltfWriter& w) {
       w.mesh(icosphere(4, Shading::flat), w.material(lambert(glm::dvec3(1.0))), turned(0.35));
     }},
    {"white_ball_in_glass_cube", kSmallBallBias,
     [](GltfWriter& w) {
       w.mesh(unit_box(), w.material(glass(1.5)), turned(0.35));
       w.mesh(icosphere(4, Shading::flat), w.material(lambert(glm::dvec3(1.0))), turned(0.2));
     }},
    {"mirror_in_glass_cube", 0.0,
     [](GltfWriter& w) {
       w.mesh(unit_box(), w.material(glass(1.5)), turned(0.35));
       w.mesh(icosphere(1, Shading::flat), w.material(white_metal()), turned(0.2));
     }},
    // A white base under a smooth coat reflects all that arrives: the coat F, the base 1 - F.
    {"smooth_white_dielectric", kBallBias,
     [](GltfWriter& w) {
       w.mesh(icosphere(4, Shading::flat), w.material(opaque_smooth_dielectric()), turned(0.35));
     }},
    {"half_covering_mirror_cube", 0.0,
     [](GltfWriter& w) {
       w.mesh(unit_box(), w.material(half_covering(white_metal())), turned(0.35));
     }},
    {"half_covering_white_ball", kBallBias,
     [](GltfWriter& w) {
       w.mesh(icosphere(4, Shading::flat), w.material(half_covering(lambert(glm::dvec3(1.0)))),
              turned(0.35));
     }},
    {"half_transparent_bubble", kBallBias,
     [](GltfWriter& w) {
       w.mesh(icosphere(4, Shading::flat), w.material(half_transparent(thin_glass(1.5))),
              turned(0.35));
     }},
    {"half_transparent_solid", kBallBias,
     [](GltfWriter& w) {
       w.mesh(icosphere(4, Shading::flat), w.material(half_transparent(glass(1.5))), turned(0.35));
     }},
    // A coat takes nothing from a white base under it, and colours that part meet again.
    {"coated_white_ball", kBallBias,
     [](GltfWriter& w) {
       const json coated = with_extension(lambert(glm::dvec3(1.0)), "KHR_materials_clearcoat",
                                          {{"clearcoatFactor", 1.0}});
       w.mesh(icosphere(4, Shading::flat), w.material(coated), turned(0.35));
     }},
    {"dispersive_cube", 0.0,
     [](GltfWriter& w) {
       const json prism =
           with_extension(glass(1.6), "KHR_materials_dispersion", {{"dispersion", 5.0}});
       w.mesh(unit_box(), w.material(prism), turned(0.35));
     }},
    // Rough glass loses what would meet a second facet: at this roughness less than 0.5 % of what
    // arrives steeper than 6 degrees, within a ball a few times.
    {"rough_glass_ball", kBallBias + 0.01,
     [](GltfWriter& w) {
       w.mesh(icosphere(4, Shading::flat), w.material(rough(glass(1.5))), turned(0.35));
     }},
    {"rough_bubble", kBallBias + 0.01,
     [](GltfWriter& w) {
       w.mesh(icosphere(4, Shading::flat), w.material(rough(thin_glass(1.5))), turned(0.35));
     }},
};

class FurnaceWithGuest : public RenderTest, public ::testing::WithParamInterface<Guest> {};

TEST_P(FurnaceWithGuest, DoesNotShow) {
  const glm::dvec3 emission(1.0, 0.5, 0.3), albedo(0.5, 0.7, 0.4);
  GltfWriter writer;
  add_furnace(writer, emission, albedo);
  GetParam().add(writer);
  writer.camera("inside", {0.0, 0.0, 0.8}, {0.03, 0.02, -0.1}, 0.9);
  const scene::Scene scene = load(writer);
  const auto settings = furnace_settings(scene, 10000);
  const std::vector<Estimate> windows =
      replicate(device(), scene, settings, kPasses, kSeeds, [](const render::Picture& picture) {
        return std::vector<glm::dvec3>{window_mean(picture, {4, 4, 12, 12}),
                                       window_mean(picture, {0, 0, 16, 2}),
                                       window_mean(picture, {0, 14, 16, 16})};
      });
  const glm::dvec3 expected = furnace_radiance(emission, albedo);
  const glm::dvec3 bias = kWallBias * (expected - emission) + GetParam().bias * expected;
  EXPECT_TRUE(agrees(windows[0], expected, kSigmas, bias)) << "on the guest";
  EXPECT_TRUE(agrees(windows[1], expected, kSigmas, bias)) << "above it";
  EXPECT_TRUE(agrees(windows[2], expected, kSigmas, bias)) << "below it";
}

INSTANTIATE_TEST_SUITE_P(Guests, FurnaceWithGuest, ::testing::ValuesIn(kGuests),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- Smooth normals

// A ball of `subdivisions` with the sphere's own normals. They differ from the facets' by up to
// t = 2 * 0.37 / 2^subdivisions (circumradius of an icosahedron's face: 0.37 after one cut). Where
// the eye meets the ball at less than that above grazing, directions may end on the wrong side and
// are lost: a share of t^2 of its picture, as a disc's points with cos < t are. Twice that is
// granted for entering and leaving. A furnace's photons suffer likewise.
double normals_bias(unsigned subdivisions) {
  const double tilt = 0.74 / static_cast<double>(1u << subdivisions);
  return 2.0 * tilt * tilt;
}

struct Ball {
  const char* name;
  json (*material)();
  unsigned subdivisions;
};
void PrintTo(const Ball& ball, std::ostream* stream) {
  *stream << ball.name;
}

class FurnaceWithSmoothBall : public RenderTest, public ::testing::WithParamInterface<Ball> {};

TEST_P(FurnaceWithSmoothBall, HardlyShows) {
  const glm::dvec3 emission(1.0, 0.5, 0.3), albedo(0.5, 0.7, 0.4);
  const auto& [name, material, subdivisions] = GetParam();
  GltfWriter writer;
  add_furnace(writer, emission, albedo);
  writer.mesh(icosphere(subdivisions), writer.material(material()), turned(0.35));
  writer.camera("inside", {0.0, 0.0, 0.8}, {0.03, 0.02, -0.1}, 0.9);
  const scene::Scene scene = load(writer);
  const auto settings = furnace_settings(scene, 10000);
  const Estimate estimate = replicate(device(), scene, settings, kPasses, kSeeds, whole(settings));
  const glm::dvec3 expected = furnace_radiance(emission, albedo);
  const glm::dvec3 bias = kWallBias * (expected - emission) + normals_bias(subdivisions) * expected;
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, bias));
}

INSTANTIATE_TEST_SUITE_P(Balls, FurnaceWithSmoothBall,
                         ::testing::Values(Ball{"coarse_glass", [] { return glass(1.5); }, 2},
                                           Ball{"fine_glass", [] { return glass(1.5); }, 4},
                                           Ball{"coarse_mirror", white_metal, 2},
                                           Ball{"fine_mirror", white_metal, 4}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace ppm::test
