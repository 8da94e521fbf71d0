// Layers beside the picture against closed forms, against the picture and against each other.
#include "layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "failure.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

using render::LayerKind;

constexpr LayerKind kSurface[] = {LayerKind::albedo, LayerKind::normal, LayerKind::geometric_normal,
                                  LayerKind::depth, LayerKind::position};
constexpr LayerKind kAll[] = {LayerKind::albedo,  LayerKind::normal,   LayerKind::geometric_normal,
                              LayerKind::depth,   LayerKind::position, LayerKind::radius,
                              LayerKind::photons, LayerKind::density,  LayerKind::direct_emission};

const auto never = [] { return false; };

class Layers : public RenderTest {
 protected:
  /// After so many passes; without any, layers of surfaces need no preparation.
  struct Result {
    std::vector<image::Layer> layers;
    render::Picture picture;
    std::unique_ptr<render::Integrator> integrator;

    const image::Layer& operator[](LayerKind kind) const {
      const auto found =
          std::ranges::find(layers, std::string(render::facts_of(kind).name), &image::Layer::name);
      if (found == layers.end()) throw std::out_of_range("no such layer");
      return *found;
    }
    glm::dvec3 at(LayerKind kind, std::uint32_t x, std::uint32_t y) const {
      const image::Layer& layer = (*this)[kind];
      const std::size_t channels = layer.channels.size();
      const std::size_t first = channels * (std::size_t{y} * picture.width + x);
      glm::dvec3 value(static_cast<double>(layer.values.at(first)));
      for (std::size_t i = 1; i < channels; ++i) {
        value[static_cast<int>(i)] = static_cast<double>(layer.values.at(first + i));
      }
      return value;
    }
  };

  static Result make(const scene::Scene& scene, const render::Settings& settings,
                     std::span<const LayerKind> kinds, unsigned passes = 0, bool prepared = false) {
    Log log(Verbosity::quiet);
    Result result;
    result.integrator = render::make_integrator(settings, scene, device(), log, 2);
    if (passes > 0 || prepared) {
      EXPECT_TRUE(result.integrator->prepare(never));
    }
    for (unsigned pass = 0; pass < passes; ++pass) {
      EXPECT_TRUE(result.integrator->advance(never));
    }
    result.layers = render::layers_of(*result.integrator, kinds);
    result.picture = {settings.width, settings.height, {}};
    if (passes > 0 || prepared) result.picture = result.integrator->resolve();
    return result;
  }
};

/// A wall of `half` edge lengths across the z axis at `z`, its front towards +z.
Mesh wall(float z, float half) {
  return quad({-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0});
}

/// The eye looks along -z from the origin; a lamp somewhere, since a scene needs one.
GltfWriter looking_ahead() {
  GltfWriter writer;
  writer.point_light({0.0, 1.0, 0.5}, glm::dvec3(1.0), 1.0);
  writer.camera("ahead", {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 0.4);
  return writer;
}

void expect_near(glm::dvec3 a, glm::dvec3 b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

// With one eye path a pixel nothing is averaged: depth and position belong to one point of the
// wall, and the point to its pixel.
TEST_F(Layers, OfAColouredWallAreItsOwn) {
  GltfWriter writer = looking_ahead();
  const glm::dvec3 left(0.8, 0.4, 0.2), right(0.1, 0.7, 0.3);
  writer.mesh(quad({-5, -5, -4}, {5, 0, 0}, {0, 10, 0}), writer.material(lambert(left)));
  writer.mesh(quad({0, -5, -4}, {5, 0, 0}, {0, 10, 0}), writer.material(lambert(right)));
  const scene::Scene scene = load(writer);
  const render::Settings settings = small_settings(scene);
  const Result result = make(scene, settings, kSurface);
  const double half = 4.0 * std::tan(0.2);  // of the wall that the picture shows
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const glm::dvec3 position = result.at(LayerKind::position, x, y);
      expect_near(result.at(LayerKind::albedo, x, y), x < 8 ? left : right, 1e-6);
      expect_near(result.at(LayerKind::normal, x, y), {0, 0, 1}, 1e-6);
      expect_near(result.at(LayerKind::geometric_normal, x, y), {0, 0, 1}, 1e-6);
      EXPECT_NEAR(position.z, -4.0, 1e-5);
      EXPECT_NEAR((position.x / half + 1.0) * 8.0, x + 0.5, 0.5 + 1e-4);
      EXPECT_NEAR((1.0 - position.y / half) * 8.0, y + 0.5, 0.5 + 1e-4);
      EXPECT_NEAR(result.at(LayerKind::depth, x, y).x, glm::length(position), 1e-5);
    }
  }
}

// As many texels as pixels, each of a colour of its own: no two rows, columns or channels may be
// mistaken for each other.
TEST_F(Layers, OfATexturedWallShowItsTexels) {
  GltfWriter writer = looking_ahead();
  const auto half = static_cast<float>(4.0 * std::tan(0.2));
  writer.mesh(wall(-4.0f, half), writer.material(lambert({0.8, 0.5, 1.0})));
  scene::Scene scene = load(writer);
  scene::Texture texture;
  texture.width = texture.height = 16;
  texture.nearest = true;
  for (unsigned row = 0; row < 16; ++row) {
    for (unsigned column = 0; column < 16; ++column) {
      texture.rgba8.emplace_back(15 * column, 15 * row, (37 * row + 11 * column) % 251, 255);
    }
  }
  scene.textures = {texture};
  const std::uint32_t painted = scene.triangles.front().material;
  scene.materials[painted].base_color_texture = scene::TextureUse{};
  const Result result = make(scene, small_settings(scene), kSurface);
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const glm::dvec3 texel(texture.rgba8[(15 - y) * 16 + x]);  // the wall's v runs upwards
      expect_near(result.at(LayerKind::albedo, x, y), glm::dvec3(0.8, 0.5, 1.0) * texel / 255.0,
                  1e-6);
    }
  }
}

// Nothing there: zero in all layers.
TEST_F(Layers, OfNothingAreZero) {
  GltfWriter writer = looking_ahead();
  writer.mesh(wall(2.0f, 1.0f), writer.material(lambert(glm::dvec3(0.5))));  // behind the eye
  const scene::Scene scene = load(writer);
  const Result result = make(scene, small_settings(scene), kAll, 1);
  for (const image::Layer& layer : result.layers) {
    EXPECT_TRUE(std::ranges::all_of(layer.values, [](float v) { return v == 0.0f; })) << layer.name;
  }
}

// A lamp and a black wall have no lobes at all, but a place.
TEST_F(Layers, OfBlackSurfacesTellWhereTheyAre) {
  GltfWriter writer = looking_ahead();
  writer.mesh(wall(-4.0f, 5.0f), writer.material(emitter(glm::dvec3(1.0))));
  const scene::Scene scene = load(writer);
  const Result result = make(scene, small_settings(scene), kSurface);
  expect_near(result.at(LayerKind::albedo, 7, 7), {0, 0, 0}, 0.0);
  expect_near(result.at(LayerKind::normal, 7, 7), {0, 0, 1}, 1e-6);
  EXPECT_NEAR(result.at(LayerKind::position, 7, 7).z, -4.0, 1e-5);
}

// The eye at 0 looks at a mirror 2 ahead of it, and in that at a wall 3 behind it: the path unfolds
// to a line of length 7 along the axis.
TEST_F(Layers, ThroughAMirrorAreOfWhatItShows) {
  GltfWriter writer = looking_ahead();
  const glm::dvec3 tint(0.9, 0.8, 0.7), colour(0.6, 0.3, 0.5);
  writer.mesh(wall(-2.0f, 3.0f), writer.material(metal(tint)));
  writer.mesh(quad({-6, -6, 3}, {0, 12, 0}, {12, 0, 0}), writer.material(lambert(colour)));
  const scene::Scene scene = load(writer);
  const Result result = make(scene, small_settings(scene), kSurface);
  for (std::uint32_t y = 0; y < 16; y += 5) {
    for (std::uint32_t x = 0; x < 16; x += 5) {
      // Schlick's term (1 - cos)^5 stays below 1e-5 here.
      expect_near(result.at(LayerKind::albedo, x, y), tint * colour, 2e-5);
      expect_near(result.at(LayerKind::normal, x, y), {0, 0, -1}, 1e-6);
      const glm::dvec3 position = result.at(LayerKind::position, x, y);
      EXPECT_NEAR(position.z, 3.0, 1e-5);
      EXPECT_NEAR(result.at(LayerKind::depth, x, y).x, std::hypot(position.x, position.y, 7.0),
                  1e-4);
    }
  }
}

// A thin sheet of index 1.5 lets 1 - 2F / (1 + F) through, F = 0.04; what it reflects sees nothing.
TEST_F(Layers, ThroughAPaneAreOfWhatIsBehindIt) {
  GltfWriter writer = looking_ahead();
  const glm::dvec3 tint(1.0, 0.5, 0.25), colour(0.6, 0.3, 0.5);
  writer.mesh(wall(-2.0f, 3.0f), writer.material(thin_glass(1.5, tint)));
  writer.mesh(wall(-4.0f, 5.0f), writer.material(lambert(colour)));
  const scene::Scene scene = load(writer);
  const Result result = make(scene, small_settings(scene), kSurface);
  const double through = 1.0 - 0.08 / 1.04;
  for (std::uint32_t i = 0; i < 16; i += 5) {
    expect_near(result.at(LayerKind::albedo, i, i), through * tint * colour, 2e-3);
    expect_near(result.at(LayerKind::normal, i, i), {0, 0, 1}, 1e-6);
    const glm::dvec3 position = result.at(LayerKind::position, i, i);
    EXPECT_NEAR(position.z, -4.0, 1e-5);
    EXPECT_NEAR(result.at(LayerKind::depth, i, i).x, glm::length(position), 1e-4);
  }
}

// A smooth coat shows the wall behind the eye as well, but the coated surface is what was found.
TEST_F(Layers, OfACoatedSurfaceEndThere) {
  GltfWriter writer = looking_ahead();
  const glm::dvec3 base(0.2, 0.5, 0.3);
  nlohmann::json coated = metal(base);
  coated["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
  writer.mesh(wall(-2.0f, 3.0f), writer.material(coated));
  writer.mesh(quad({-6, -6, 3}, {0, 12, 0}, {12, 0, 0}), writer.material(lambert(glm::dvec3(1.0))));
  const scene::Scene scene = load(writer);
  const Result result = make(scene, small_settings(scene), kSurface);
  // Index 1.5 reflects 4 % and lets the rest in.
  expect_near(result.at(LayerKind::albedo, 8, 8), 0.96 * base, 1e-5);
  expect_near(result.at(LayerKind::normal, 8, 8), {0, 0, 1}, 1e-6);
  EXPECT_NEAR(result.at(LayerKind::position, 8, 8).z, -2.0, 1e-5);
}

// Inside a solid radiance is n^2 times as large; what is seen there has its own colour all the
// same, less the 4 % that the surface reflects.
TEST_F(Layers, InsideGlassAreNotDimmedByItsIndex) {
  GltfWriter writer = looking_ahead();
  const glm::dvec3 colour(0.6, 0.3, 0.5);
  writer.mesh(box({-6, -6, -8}, {6, 6, -2}), writer.material(glass(1.5)));
  writer.mesh(wall(-4.0f, 5.0f), writer.material(lambert(colour)));
  const scene::Scene scene = load(writer);
  const Result result = make(scene, small_settings(scene), kSurface);
  expect_near(result.at(LayerKind::albedo, 8, 8), 0.96 * colour, 2e-3);
  EXPECT_NEAR(result.at(LayerKind::position, 8, 8).z, -4.0, 1e-5);
}

void expect_same_bytes(const std::vector<image::Layer>& a, const std::vector<image::Layer>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].values.size(), b[i].values.size());
    EXPECT_EQ(
        std::memcmp(a[i].values.data(), b[i].values.data(), a[i].values.size() * sizeof(float)), 0)
        << a[i].name;
  }
}

TEST_F(Layers, AreInRangeAndTheSameInTiles) {
  const scene::Scene scene = load(small_room());
  render::Settings settings = room_settings(scene);
  for (const char* method : {"ppm", "pm"}) {
    settings.integrator = method;
    settings.tile_hits = render::Settings{}.tile_hits;
    const Result whole = make(scene, settings, kAll, 2);
    for (std::uint32_t y = 0; y < settings.height; ++y) {
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const glm::dvec3 albedo = whole.at(LayerKind::albedo, x, y);
        const double size = glm::length(whole.at(LayerKind::normal, x, y));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(albedo, glm::dvec3(0.0))));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(albedo, glm::dvec3(1.0))));
        EXPECT_TRUE(size == 0.0 || std::abs(size - 1.0) < 1e-6) << size;
      }
    }
    for (const image::Layer& layer : whole.layers) {
      EXPECT_TRUE(std::ranges::all_of(layer.values, [](float v) { return std::isfinite(v); }))
          << layer.name;
    }
    settings.tile_hits = 700;
    const Result tiled = make(scene, settings, kAll, 2);
    EXPECT_GT(tiled.integrator->statistics().tiles, 2u);
    expect_same_bytes(tiled.layers, whole.layers);
  }
}

// Camera, tracer and random numbers are shared: as many eye paths make the same layers.
TEST_F(Layers, OfSurfacesAreTheSameByAllMethods) {
  const scene::Scene scene = load(small_room());
  render::Settings settings = room_settings(scene);
  settings.samples_per_pixel = 16;
  const Result expected = make(scene, settings, kSurface);
  settings.samples_per_pixel = 1;
  for (const char* method : {"pt", "bdpt", "mlt"}) {
    SCOPED_TRACE(method);
    settings.integrator = method;
    ASSERT_EQ(render::layer_samples(settings), 16u);
    const Result other = make(scene, settings, kSurface);
    expect_same_bytes(other.layers, expected.layers);
    EXPECT_THROW(render::layers_of(*other.integrator, std::array{LayerKind::radius}), Failure);
  }
}

/// A plate lit from a height of 1 above its centre, which the eye beside the lamp looks at.
scene::Scene lit_plate() {
  GltfWriter writer;
  writer.mesh(quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}),
              writer.material(lambert(glm::dvec3(0.8, 0.4, 0.2))));
  writer.point_light({0.0, 1.0, 0.0}, glm::dvec3(1.0), 1.0);
  writer.camera("above", {0.0, 3.0, 0.0}, {0.0, 0.0, 0.0}, 0.4, 1.0, {0.0, 0.0, -1.0});
  return load(writer);
}

// With one eye path a pixel a diffuse plate has one hit point a pixel, which the probe reads apart.
TEST_F(Layers, OfHitPointsAreTheProbesReadings) {
  const scene::Scene scene = lit_plate();
  const render::Settings settings = small_settings(scene);
  const Result result = make(scene, settings, kAll, 3);
  for (std::uint32_t y = 0; y < 16; y += 3) {
    for (std::uint32_t x = 0; x < 16; x += 3) {
      const auto reading = result.integrator->probe(x, y);
      ASSERT_TRUE(reading);
      const double photons = result.at(LayerKind::photons, x, y).x;
      const double radius = result.at(LayerKind::radius, x, y).x;
      EXPECT_NEAR(radius, reading->radius, 1e-6 * reading->radius);
      EXPECT_NEAR(photons, reading->photons, 1e-6 * reading->photons);
      const double density = photons / (std::numbers::pi * radius * radius);
      EXPECT_NEAR(result.at(LayerKind::density, x, y).x, density, 1e-5 * density);
    }
  }
  // Before the first pass radii are those that the statistics tell of.
  const Result before = make(scene, settings, kAll, 0, true);
  const render::Statistics& statistics = before.integrator->statistics();
  const auto [least, most] = std::ranges::minmax(before[LayerKind::radius].values);
  EXPECT_FLOAT_EQ(least, static_cast<float>(statistics.initial_radius_min));
  EXPECT_FLOAT_EQ(most, static_cast<float>(statistics.initial_radius_max));
}

// From a point at height 1 the photons on the plate have density N cos / (4 pi d^2) at distance d.
// The picture shows 1.5 units^2 with some 3e4 of the 4e5 photons: one standard error is 0.6 %, the
// discs' blur (radius 0.1) adds less than 0.5 %.
TEST_F(Layers, DensityIntegratesToThePhotonsThatArrived) {
  const scene::Scene scene = lit_plate();
  render::Settings settings = small_settings(scene, 32, 32, 100000);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.1;
  for (const char* method : {"ppm", "pm"}) {
    settings.integrator = method;
    settings.nearest = 100;
    const Result result = make(scene, settings, kAll, 4);
    double found = 0.0, expected = 0.0;
    for (std::uint32_t y = 0; y < 32; ++y) {
      for (std::uint32_t x = 0; x < 32; ++x) {
        const glm::dvec3 p = result.at(LayerKind::position, x, y);
        found += result.at(LayerKind::density, x, y).x;
        expected += 4e5 / (4.0 * std::numbers::pi) * std::pow(1.0 + p.x * p.x + p.z * p.z, -1.5);
      }
    }
    // Of n nearest photons the density is n / (n - 1) too large in the mean.
    const double excess = method == std::string("pm") ? 100.0 / 99.0 : 1.0;
    EXPECT_NEAR(found / expected, excess, 0.025) << method;
  }
}

// Emission is what the picture shows before any photon is there, and stays so; the rest is what
// photons add.
TEST_F(Layers, DirectEmissionAndTheRestMakeThePicture) {
  const scene::Scene scene = load(small_room());
  const render::Settings settings = room_settings(scene);
  const Result before = make(scene, settings, kAll, 0, true);
  const Result after = make(scene, settings, kAll, 2);
  const std::vector<float>& emission = after[LayerKind::direct_emission].values;
  EXPECT_EQ(before.picture.rgb, emission);
  EXPECT_EQ(before[LayerKind::direct_emission].values, emission);
  EXPECT_GT(std::ranges::max(emission), 1.0f);
  double rest = 0.0;
  for (std::size_t i = 0; i < emission.size(); ++i) {
    EXPECT_GE(after.picture.rgb[i], emission[i]);
    rest += static_cast<double>(after.picture.rgb[i] - emission[i]);
  }
  EXPECT_GT(rest, 1.0);
}

}  // namespace
}  // namespace ppm::test
