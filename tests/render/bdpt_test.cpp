// Bidirectional path tracing: each way in which paths meet, alone, finds the light that all of them
// find together, weighted; and it is the light that is known or that photons find.
//
// The ways share little: emitters that the camera path hits are plain path tracing, the lens is
// light tracing, next event estimation knows of lights what neither does. Where one lacks a factor
// the means of two of them differ.
#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>

#include "shared/bidirectional.h"
#include "small_room.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

constexpr unsigned kEmitters = PPM_BDPT_EMITTERS, kNextEvent = PPM_BDPT_NEXT_EVENT,
                   kConnections = PPM_BDPT_CONNECTIONS, kLens = PPM_BDPT_LENS, kAll = PPM_BDPT_ALL;
constexpr unsigned kSeeds = 8;
// Standard errors of a difference between two means of eight seeds, Student's t with some 14
// degrees of freedom: 5.5 are passed once in 13000 comparisons.
constexpr double kSigmas = 5.5;
constexpr double kFewSigmas = 8.0;  // against what is known: 7 degrees, once in 11000

render::Settings bdpt_settings(const scene::Scene& scene, unsigned ways) {
  render::Settings settings = small_settings(scene, 16, 16);
  settings.integrator = "bdpt";
  settings.bdpt_strategies = ways;
  return settings;
}

/// Means of the sixteen blocks of 4 x 4 pixels, then of the whole.
std::vector<glm::dvec3> blocks_and_whole(const render::Picture& picture) {
  std::vector<glm::dvec3> means = block_means(picture, picture.width / 4);
  means.push_back(window_mean(picture, {0, 0, picture.width, picture.height}));
  return means;
}

std::vector<Estimate> render_blocks(gpu::Device& device, const scene::Scene& scene,
                                    const render::Settings& settings, unsigned passes) {
  return replicate(device, scene, settings, passes, kSeeds, blocks_and_whole);
}

/// Whether all blocks agree within `sigmas` standard errors and `slack` of the value.
void expect_same(const std::vector<Estimate>& a, const std::vector<Estimate>& b, double slack,
                 const std::string& what) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    Estimate difference = a[i];
    difference.standard_error = glm::sqrt(a[i].standard_error * a[i].standard_error +
                                          b[i].standard_error * b[i].standard_error);
    EXPECT_TRUE(agrees(difference, b[i].mean, kSigmas, slack * b[i].mean + 1e-4))
        << what << (i + 1 == a.size() ? ", whole picture" : ", block " + std::to_string(i));
  }
}

json two_sided(json material) {
  material["doubleSided"] = true;
  return material;
}

/// A closed room, the camera inside. `white`: of all its walls but a red one. `roofless`: of those,
/// the ceiling is not there.
GltfWriter room(const json& white, bool roofless = false) {
  GltfWriter writer;
  const auto wall = writer.material(white), red = writer.material(lambert({0.6, 0.2, 0.1}));
  Mesh walls = inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f)));
  Mesh left = walls;
  left.indices.resize(6);
  if (roofless) walls.indices.erase(walls.indices.begin() + 18, walls.indices.begin() + 24);
  walls.indices.erase(walls.indices.begin(), walls.indices.begin() + 6);
  writer.mesh(walls, wall);
  writer.mesh(left, red);
  writer.camera("door", {0.0, 0.1, 0.9}, {0.0, -0.2, -1.0}, 1.1);
  return writer;
}

void add_lamp(GltfWriter& writer) {
  writer.mesh(quad({-0.4f, 0.6f, -0.6f}, {0.8f, 0.0f, 0.0f}, {0.0f, 0.2f, 0.8f}),
              writer.material(two_sided(emitter({4.0, 3.0, 2.0}))));
}

void add_punctual_lights(GltfWriter& writer) {
  writer.point_light({0.4, 0.5, -0.2}, {1.0, 0.8, 0.6}, 0.5);
  writer.spot_light({-0.6, 0.7, 0.4}, {0.6, -1.0, -0.4}, {0.5, 0.7, 1.0}, 3.0, 0.2, 0.6);
}

scene::Environment even_sky() {
  scene::Environment sky;
  sky.name = "even";
  sky.width = 4;
  sky.height = 2;
  sky.texels.assign(8, glm::vec3(0.5f, 0.8f, 1.2f));
  return sky;
}

json rough_glass(double roughness) {
  json material = glass(1.5, {0.7, 0.9, 0.8}, 0.15);
  material["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
  return material;
}

json coated(json material, double roughness) {
  material["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1.0},
                                                       {"clearcoatRoughnessFactor", roughness}};
  return material;
}

struct Case {
  const char* name;
  std::function<void(GltfWriter&)> furnish;
  std::vector<unsigned> ways;  // each alone
  unsigned passes;
  double slack;  // relative
  std::function<void(scene::Scene&, render::Settings&)> adjust = {};
  bool roofless = false;
};
void PrintTo(const Case& c, std::ostream* stream) {
  *stream << c.name;
}

class BdptWays : public RenderTest, public ::testing::WithParamInterface<Case> {};

TEST_P(BdptWays, HaveOneMean) {
  const Case& c = GetParam();
  GltfWriter writer = room(lambert(glm::dvec3(0.6)), c.roofless);
  c.furnish(writer);
  scene::Scene scene = load(writer);
  render::Settings settings = bdpt_settings(scene, kAll);
  if (c.adjust) c.adjust(scene, settings);
  const auto all = render_blocks(device(), scene, settings, c.passes);
  for (const unsigned ways : c.ways) {
    settings.bdpt_strategies = ways;
    const auto alone = render_blocks(device(), scene, settings, 2 * c.passes);
    expect_same(alone, all, c.slack, "ways " + std::to_string(ways));
  }
}

const Case kCases[] = {
    {"Lamp",
     [](GltfWriter& writer) {
       add_lamp(writer);
       writer.mesh(box({-0.7f, -1.0f, -0.6f}, {-0.2f, -0.3f, -0.2f}),
                   writer.material(metal({0.8, 0.7, 0.5}, 0.5)));
     },
     {kEmitters, kNextEvent, kLens},
     16,
     0.0},
    {"PunctualLights", add_punctual_lights, {kNextEvent, kLens}, 6, 0.0},
    // Between two events factors above 10 are clamped on the light's side: too few to show.
    {"InterpolatedNormals",
     [](GltfWriter& writer) {
       add_lamp(writer);
       writer.mesh(icosphere(1), writer.material(lambert(glm::dvec3(0.8))),
                   placed({0.2, -0.5, -0.3}, 0.45));
     },
     {kNextEvent, kLens},
     16,
     0.0},
    // Where the eye, or the light, is above the facet but below its normal, what they see differs.
    {"SpotOnACoarseBall",
     [](GltfWriter& writer) {
       writer.mesh(icosphere(0), writer.material(lambert(glm::dvec3(0.8))),
                   placed({0.0, -0.1, -0.2}, 0.7));
       writer.spot_light({0.9, 0.6, 0.5}, {-0.9, -0.7, -0.7}, {1.0, 0.8, 0.6}, 10.0, 0.5, 0.7);
     },
     {kNextEvent, kLens},
     64,
     0.0,
     [](scene::Scene&, render::Settings& settings) { settings.max_depth = 1; }},
    // All that is seen left a plate whose normals lean by 0.35, away from the camera.
    {"LitByALeaningPlate",
     [](GltfWriter& writer) {
       Mesh plate = quad({-0.5f, -0.8f, -0.7f}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f});
       plate.normals.assign(plate.positions.size(), {0.0f, std::cos(0.35f), -std::sin(0.35f)});
       writer.mesh(plate, writer.material(lambert(glm::dvec3(0.9))));
       writer.spot_light({0.0, 0.5, -0.2}, {0.0, -1.0, 0.0}, {1.0, 0.8, 0.6}, 10.0, 0.1, 0.3);
     },
     {kNextEvent, kLens},
     16,
     0.0,
     [](scene::Scene&, render::Settings& settings) { settings.max_depth = 2; }},
    {"SmoothGlassAndMirror",
     [](GltfWriter& writer) {
       add_lamp(writer);
       writer.mesh(icosphere(2), writer.material(glass(1.5, {0.7, 0.9, 0.8}, 0.5)),
                   placed({0.35, -0.6, -0.1}, 0.4));
       writer.mesh(icosphere(2), writer.material(coated(lambert({0.8, 0.5, 0.2}), 0.0)),
                   placed({-0.5, -0.6, -0.4}, 0.35));
     },
     {kEmitters},
     16,
     0.0},
    // Light that scatters twice within glass: refraction on the way in has no counterpart.
    {"CornerInGlass",
     [](GltfWriter& writer) {
       writer.mesh(quad({-0.9f, 0.9f, -0.9f}, {1.8f, 0, 0}, {0, 0, 1.8f}),
                   writer.material(emitter({1.0, 0.8, 0.6})));
       const auto white = writer.material(two_sided(lambert(glm::dvec3(0.9))));
       writer.mesh(box({-0.7f, -0.95f, -0.8f}, {0.7f, 0.2f, 0.2f}), writer.material(glass(2.0)));
       writer.mesh(quad({-0.6f, -0.9f, 0.1f}, {1.2f, 0, 0}, {0, 0, -0.8f}), white);
       writer.mesh(quad({-0.6f, -0.9f, -0.7f}, {1.2f, 0, 0}, {0, 1.0f, 0}), white);
     },
     {kEmitters},
     32,
     0.0},
    {"RoughGlassAndCoat",
     [](GltfWriter& writer) {
       add_lamp(writer);
       writer.mesh(icosphere(3), writer.material(rough_glass(0.5)),
                   placed({0.35, -0.6, -0.1}, 0.4));
       writer.mesh(box({-0.7f, -1.0f, -0.6f}, {-0.2f, -0.3f, -0.2f}),
                   writer.material(coated(lambert({0.8, 0.5, 0.2}), 0.4)));
     },
     {kEmitters, kLens},
     16,
     0.0},
    // Overlapping solids, of which light notices only the outer surfaces' share; a veil.
    {"VeilAndOverlap",
     [](GltfWriter& writer) {
       add_lamp(writer);
       json veil = lambert({0.5, 0.8, 0.5});
       veil["alphaMode"] = "BLEND";
       veil["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.8, 0.5, 0.4};
       writer.mesh(quad({-1, -0.2f, -1}, {0, 0, 2}, {2, 0, 0}), writer.material(two_sided(veil)));
       const auto solid = writer.material(rough_glass(0.6));
       writer.mesh(box({0.0f, -0.9f, -0.5f}, {0.4f, -0.5f, 0.0f}), solid);
       writer.mesh(box({0.2f, -0.8f, -0.4f}, {0.6f, -0.4f, 0.1f}), solid);
     },
     {kEmitters},
     16,
     0.0},
    {"Dispersion",
     [](GltfWriter& writer) {
       add_lamp(writer);
       writer.mesh(icosphere(2), writer.material(glass(1.5)), placed({0.2, -0.4, -0.1}, 0.5));
     },
     {kEmitters},
     16,
     0.0,
     [](scene::Scene& scene, render::Settings&) {
       for (auto& material : scene.materials) material.dispersion = material.solid ? 6.0f : 0.0f;
     }},
    // Glass that hangs out of sight, since the lens sees no light by way of it.
    {"ThroughGlassUnseen",
     [](GltfWriter& writer) {
       writer.mesh(quad({-0.25f, 0.97f, -0.15f}, {0.3f, 0, 0}, {0, 0, 0.3f}),
                   writer.material(emitter({30.0, 25.0, 20.0})));
       writer.mesh(icosphere(2), writer.material(glass(1.5, {0.3, 0.8, 0.5}, 0.2)),
                   placed({-0.1, 0.75, 0.0}, 0.2));
     },
     {kLens},
     16,
     0.0,
     [](scene::Scene& scene, render::Settings&) {
       for (auto& material : scene.materials) material.dispersion = material.solid ? 6.0f : 0.0f;
     }},
    // What is infinitely far away has densities of its own, which must not meet distances.
    {"SkyAndSun",
     [](GltfWriter& writer) {
       writer.directional_light({0.5, -1.0, -0.4}, {1.0, 0.8, 0.5}, 2.0);
     },
     {kNextEvent, kLens},
     16,
     0.0,
     [](scene::Scene& scene, render::Settings&) { scene.environment = even_sky(); },
     true},
    {"Gaussian",
     add_punctual_lights,
     {kNextEvent, kLens},
     16,
     0.0,
     [](scene::Scene&, render::Settings& settings) { settings.filter = render::Filter::gaussian; }},
    {"TentAndDepth",
     add_lamp,
     {kEmitters, kNextEvent, kLens},
     16,
     0.0,
     [](scene::Scene&, render::Settings& settings) {
       settings.filter = render::Filter::tent;
       settings.max_depth = 2;
     }},
};

std::string name_of(const ::testing::TestParamInfo<Case>& tested) {
  return tested.param.name;
}
INSTANTIATE_TEST_SUITE_P(Scenes, BdptWays, ::testing::ValuesIn(kCases), name_of);

class Bdpt : public RenderTest {};

// Connections of two vertices cannot bring light after one event, but all of the rest.
TEST_F(Bdpt, ConnectionsBringWhatDirectLightLacks) {
  GltfWriter writer = room(lambert(glm::dvec3(0.6)));
  add_lamp(writer);
  add_punctual_lights(writer);
  const scene::Scene scene = load(writer);
  render::Settings settings = bdpt_settings(scene, kConnections);
  auto connections = render_blocks(device(), scene, settings, 8);
  settings.bdpt_strategies = kAll;
  const auto all = render_blocks(device(), scene, settings, 6);
  settings.max_depth = 1;
  const auto direct = render_blocks(device(), scene, settings, 6);
  // Emitters that are seen directly are in all three: what a black room shows.
  GltfWriter dark = room(lambert(glm::dvec3(0.0)));
  add_lamp(dark);
  const scene::Scene black = load(dark);
  const auto seen = render_blocks(device(), black, bdpt_settings(black, kEmitters), 2);
  for (std::size_t i = 0; i < all.size(); ++i) {
    connections[i].mean += direct[i].mean - seen[i].mean;
    connections[i].standard_error += direct[i].standard_error + seen[i].standard_error;
  }
  expect_same(connections, all, 0.003, "connections and direct light");
}

// A closed diffuse vessel that glows all over: e / (1 - albedo), wherever one looks.
TEST_F(Bdpt, FurnaceIsEven) {
  const glm::dvec3 albedo(0.7, 0.5, 0.2), emission(0.5, 1.0, 2.0);
  const struct { unsigned ways, passes; } kRuns[] = {{kAll, 24}, {kLens, 320}};
  for (const auto& run : kRuns) {
    GltfWriter writer;
    writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))),
                writer.material(with_emission(lambert(albedo), emission)));
    writer.camera("inside", {0.3, 0.1, 0.5}, {0.0, -0.3, -1.0}, 1.2);
    const scene::Scene scene = load(writer);
    const auto blocks = render_blocks(device(), scene, bdpt_settings(scene, run.ways), run.passes);
    for (const Estimate& block : blocks)
      EXPECT_TRUE(agrees(block, emission / (1.0 - albedo), kFewSigmas, 1e-3)) << run.ways;
    // What is off by 3 % shows.
    const glm::dvec3 noise = blocks.back().standard_error * (1.0 - albedo) / emission;
    EXPECT_LT(std::max({noise.x, noise.y, noise.z}), 0.0035) << run.ways;
  }
}

// The light of a spot and a point light by way of glass, of mirrors and of everything, as photons
// find it. These are off by what their discs smear: radii of 2 % of the room.
TEST_F(Bdpt, SeesWhatPhotonsSee) {
  const scene::Scene scene = load(small_room());
  render::Settings settings = room_settings(scene);
  settings.width = settings.height = 16;
  settings.samples_per_pixel = 16;
  settings.photons_per_pass = 100000;
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.03;
  const auto photons = replicate(device(), scene, settings, 1, 2, blocks_and_whole);
  settings.integrator = "bdpt";
  const auto paths = render_blocks(device(), scene, settings, 16);
  // Caustics seen in the mirror wall, by way of the ball that they come through, are all but
  // invisible to bdpt: what is left out lacks, and nowhere is there more.
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const double difference = paths[i].mean[channel] - photons[i].mean[channel];
      const double error =
          kSigmas * (paths[i].standard_error[channel] + photons[i].standard_error[channel]);
      EXPECT_LT(difference, error + 0.03 * photons[i].mean[channel]) << i;
      EXPECT_GT(difference, -error - 0.25 * photons[i].mean[channel]) << i;
    }
  }
}

// However it is cut into tiles, and whatever fits.
TEST_F(Bdpt, IsTheSameForAnyTiles) {
  const scene::Scene scene = load(small_room());
  render::Settings settings = room_settings(scene);
  for (const char* method : {"bdpt", "lt"}) {
    settings.integrator = method;
    settings.tile_hits = 1u << 20;
    const auto whole = render_scene(device(), scene, settings, 2).picture;
    EXPECT_TRUE(same_bits(whole, render_scene(device(), scene, settings, 2).picture));
    settings.tile_hits = 37;
    EXPECT_TRUE(same_bits(whole, render_scene(device(), scene, settings, 2).picture));
  }
}

// A pass that is interrupted leaves no trace.
TEST_F(Bdpt, InterruptedPassIsUndone) {
  const scene::Scene scene = load(small_room());
  render::Settings settings = room_settings(scene);
  settings.integrator = "bdpt";
  settings.tile_hits = 100;
  Log log(Verbosity::quiet);
  const auto never = [] { return false; };
  const auto integrator = render::make_integrator(settings, scene, device(), log, 1);
  ASSERT_TRUE(integrator->prepare(never));
  ASSERT_TRUE(integrator->advance(never));
  const auto before = integrator->resolve();
  unsigned polls = 0;
  EXPECT_FALSE(integrator->advance([&] { return ++polls > 8; }));
  EXPECT_TRUE(same_bits(before, integrator->resolve()));
  ASSERT_TRUE(integrator->advance(never));
  EXPECT_TRUE(same_bits(integrator->resolve(), render_scene(device(), scene, settings, 2).picture));
}

}  // namespace
}  // namespace ppm::test
