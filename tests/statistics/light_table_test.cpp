// host/render/light_table.hpp: every light is chosen as often as its record says.
#include "light_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "chi_squared.hpp"
#include "scene.hpp"
#include "shared/random.h"

namespace ppm::render {
namespace {

constexpr double kWords = 4294967296.0;

// The chance of each index over all pairs of 32-bit words, by counting words.
std::vector<double> chances(const AliasTable& table) {
  const std::size_t n = table.alias.size();
  std::vector<double> words(n, 0.0);
  for (std::size_t bin = 0; bin < n; ++bin) {
    EXPECT_LT(table.alias[bin], n);
    words[bin] += table.threshold[bin];
    words[table.alias[bin]] += kWords - table.threshold[bin];
  }
  for (double& word : words) word /= kWords * static_cast<double>(n);
  return words;
}

// Each of n thresholds is cut off by less than 2 words (a word, and one in 2^32 by the factor). An
// index gets at most what all n bins err by: 2 / 2^32. That, and doubles' rounding of n sums.
void expect_exact(const std::vector<double>& weights, const std::string& what) {
  const AliasTable table = make_alias_table(weights);
  ASSERT_EQ(table.threshold.size(), weights.size());
  const std::vector<double> actual = chances(table);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double tolerance = 2.0 / kWords + 1e-15 * static_cast<double>(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    ASSERT_NEAR(actual[i], weights[i] / sum, tolerance) << what << " at " << i;
  }
}

TEST(AliasTable, ChancesAreTheWeights) {
  expect_exact({3.5}, "one");
  expect_exact({1.0, 1.0}, "two equal");
  expect_exact(std::vector<double>(1000, 0.1), "equal");
  expect_exact({1.0, 1e12}, "extreme");
  expect_exact({1e12, 1.0, 1e-12, 1e6}, "more extreme");
  expect_exact({0.0, 1.0, 0.0, 3.0}, "zeros");
  statistics::Units units(121);
  for (const int n : {2, 3, 10, 1000, 20000}) {
    std::vector<double> weights;
    for (int i = 0; i < n; ++i) weights.push_back(std::exp(10.0 * units.next()));
    expect_exact(weights, std::to_string(n) + " random");
  }
}

TEST(AliasTable, WhatHasNoWeightIsNeverChosen) {
  const std::vector<double> chance = chances(make_alias_table(std::vector<double>{0.0, 1.0, 0.0}));
  EXPECT_EQ(chance[0], 0.0);
  EXPECT_EQ(chance[2], 0.0);
}

// The choice as the kernels make it.
TEST(AliasTable, DrawsFollowTheWeights) {
  const std::vector<double> weights{1.0, 2.0, 0.5, 8.0, 3.0, 0.25, 5.0};
  const AliasTable table = make_alias_table(weights);
  statistics::Units units(122);
  std::vector<double> observed(weights.size(), 0.0), expected = weights;
  for (int i = 0; i < 400000; ++i) {
    const std::uint32_t bin = shared::index_from_word(units.word(), 7u);
    ++observed[units.word() < table.threshold[bin] ? bin : table.alias[bin]];
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& count : expected) count *= 400000.0 / sum;
  statistics::expect_counts(observed, expected, "alias draws");
}

scene::PunctualLight point_light(float intensity) {
  scene::PunctualLight light;
  light.intensity = glm::vec3(intensity);
  return light;
}

// Materials: 0 dark, 1 radiance (1, 2, 6) from the front, 2 the same from both sides.
scene::Scene scene_of(const std::vector<std::uint32_t>& materials) {
  scene::Scene scene;
  scene.materials.resize(3);
  scene.materials[1].emission = scene.materials[2].emission = glm::vec3(1, 2, 6);
  scene.materials[2].double_sided = true;
  for (const std::uint32_t material : materials) {
    scene::Triangle triangle;
    triangle.material = material;
    triangle.corners[1].position = glm::vec3(0.5f, 0, 0);
    triangle.corners[2].position = glm::vec3(0, 0.5f, 0);
    triangle.corners[0].position = glm::vec3(0.0f);
    scene.triangles.push_back(triangle);
  }
  return scene;
}

TEST(LightTable, HoldsWhatGivesOffLight) {
  scene::Scene scene = scene_of({0, 1, 2, 1});
  scene.punctual_lights = {point_light(2.0f), point_light(0.0f)};
  const std::vector<std::uint32_t> order{3, 0, 2, 1};  // slot -> triangle
  const LightTable table = make_light_table(scene, order, glm::vec3(0.0f), 1.0f);
  ASSERT_EQ(table.records.size(), 4u);
  const std::vector<std::uint32_t> slots{0, 2, 3};
  const double one_side = std::numbers::pi * 0.125 * 3.0;  // pi A mean(L)
  const double point = 4.0 * std::numbers::pi * 2.0;
  EXPECT_NEAR(table.total_power, 4.0 * one_side + point, 1e-5);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(table.records[i].kind, PPM_LIGHT_TRIANGLE);
    EXPECT_EQ(table.records[i].triangle, slots[i]);
    const double power = i == 1 ? 2.0 * one_side : one_side;
    const double share = 0.99 * power / table.total_power + 0.01 / 4.0;
    EXPECT_NEAR(table.records[i].probability, share, 1e-6);
  }
  EXPECT_EQ(table.records[3].kind, PPM_LIGHT_POINT);
}

// The even hundredth keeps a candle beside the sun; the records' probabilities are those of the
// alias table, which the photons' weights divide by.
TEST(LightTable, NoLightIsStarvedAndProbabilitiesAreTrue) {
  scene::Scene scene = scene_of({0});
  for (const float power : {1e12f, 1.0f, 1e6f, 1e-3f, 1e12f}) {
    scene.punctual_lights.push_back(point_light(power));
  }
  const std::vector<std::uint32_t> order{0};
  const LightTable table = make_light_table(scene, order, glm::vec3(0.0f), 1.0f);
  ASSERT_EQ(table.records.size(), 5u);
  AliasTable alias;
  double sum = 0.0;
  for (const shared::LightRecord& record : table.records) {
    alias.threshold.push_back(record.alias_threshold);
    alias.alias.push_back(record.alias);
    EXPECT_GE(record.probability, 0.01f / 5.0f * (1.0f - 1e-6f));
    sum += record.probability;
  }
  EXPECT_NEAR(sum, 1.0, 5.0 * 0x1p-24);
  const std::vector<double> actual = chances(alias);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(actual[i] / table.records[i].probability, 1.0, 0x1p-23 + 2.0 / kWords / 0.002);
  }
}

// Texture coordinates of a triangle: the lower left half of the texture, v down.
void lay_out(scene::Triangle& triangle, glm::vec2 a, glm::vec2 b, glm::vec2 c) {
  triangle.corners[0].texcoord = a;
  triangle.corners[1].texcoord = b;
  triangle.corners[2].texcoord = c;
}

scene::Texture texture_of(std::uint32_t size, glm::u8vec4 all) {
  scene::Texture texture;
  texture.width = texture.height = size;
  texture.nearest = true;
  texture.rgba8.assign(std::size_t{size} * size, all);
  return texture;
}

// Half of the texture's red, a quarter of its green: the triangle below the diagonal has one texel
// of four whole and halves of two others.
TEST(LightTable, PowersAreWhatTexturesSay) {
  scene::Scene scene = scene_of({1});
  scene::Texture texture = texture_of(2, {0, 0, 0, 255});
  texture.rgba8[2] = {255, 0, 0, 255};  // lower left
  texture.rgba8[3] = {0, 255, 0, 127};  // lower right
  scene.textures.push_back(texture);
  scene.materials[1].emissive_texture.emplace();
  lay_out(scene.triangles[0], {0, 0}, {0, 1}, {1, 1});
  const std::vector<std::uint32_t> order{0};
  const auto power = [&] {
    return make_light_table(scene, order, glm::vec3(0.0f), 1.0f).total_power;
  };
  // Radiance (1, 2, 6), area 1/8. By midpoints, 16 of which lie on each side of no edge.
  const double unit = std::numbers::pi * 0.125;
  EXPECT_NEAR(power(), unit * (0.5 * 1.0 + 0.25 * 2.0) / 3.0, 0.02 * unit);
  // The material's base colour shows the same texture, and covers by its alpha.
  scene.materials[1].base_color_texture.emplace();
  scene.materials[1].alpha_mode = scene::AlphaMode::mask;
  EXPECT_NEAR(power(), unit * (0.5 * 1.0) / 3.0, 0.02 * unit);
  scene.materials[1].alpha_mode = scene::AlphaMode::blend;
  EXPECT_NEAR(power(), unit * (0.5 * 1.0 + 127 / 255.0 * 0.25 * 2.0) / 3.0, 0.02 * unit);
  scene.materials[1].alpha = 0.5f;
  EXPECT_NEAR(power(), unit * 0.5 * (0.5 * 1.0 + 127 / 255.0 * 0.25 * 2.0) / 3.0, 0.02 * unit);
}

// A black texture but for one texel, on a strip of triangles each some texels wide: no triangle
// that shows any of it is left out, and those far from it are.
TEST(LightTable, ASingleTexelIsEnough) {
  for (const bool nearest : {true, false}) {
    scene::Texture texture = texture_of(256, {0, 0, 0, 255});
    texture.nearest = nearest;
    texture.rgba8[256 * 10 + 100] = {1, 0, 0, 255};
    scene::Scene scene = scene_of(std::vector<std::uint32_t>(2000, 1));
    scene.textures.push_back(texture);
    scene.materials[1].emissive_texture.emplace();
    std::vector<std::uint32_t> order;
    const auto edge = [](std::uint32_t i) { return static_cast<float>(i / 2) / 1000.0f; };
    for (std::uint32_t i = 0; i < 2000; ++i) {  // 1000 columns of a quarter of a texel, two each
      const float left = edge(i), right = edge(i + 2);
      if (i % 2 == 0) {
        lay_out(scene.triangles[i], {left, 0}, {right, 0}, {left, 1});
      } else {
        lay_out(scene.triangles[i], {right, 0}, {right, 1}, {left, 1});
      }
      order.push_back(i);
    }
    const LightTable table = make_light_table(scene, order, glm::vec3(0.0f), 1.0f);
    std::vector<bool> found(2000, false);
    for (const shared::LightRecord& record : table.records) found[record.triangle] = true;
    // Filtered, a texel reaches half a texel further; and a box may be lit beside its triangle.
    const double reach = nearest ? 0.0 : 0.5, slack = 1.5 - reach;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const double left = edge(i) * 256.0, right = edge(i + 2) * 256.0;
      const bool is_near_top = i % 2 == 0;  // texel row 10 of 256: most of an even triangle's width
      const bool must = right > 100 - reach + 0.02 && left + 0.04 < 101 + reach && is_near_top;
      const bool must_not = right < 100 - reach - slack || left > 101 + reach + slack;
      EXPECT_TRUE(found[i] || !must) << i << ": " << left << " to " << right;
      EXPECT_FALSE(found[i] && must_not) << i << ": " << left << " to " << right;
    }
  }
}

TEST(LightTable, IsEmptyInTheDark) {
  scene::Scene scene = scene_of({0, 0});
  scene.punctual_lights = {point_light(0.0f)};
  const std::vector<std::uint32_t> order{1, 0};
  const LightTable table = make_light_table(scene, order, glm::vec3(0.0f), 1.0f);
  EXPECT_TRUE(table.records.empty());
  EXPECT_EQ(table.total_power, 0.0);
}

scene::Scene under_sky(float radiance, float strength) {
  scene::Scene scene = scene_of({0});
  scene.environment.emplace();
  scene.environment->width = 2;
  scene.environment->height = 1;
  scene.environment->texels = {glm::vec3(0.0f), glm::vec3(0.0f, radiance, 0.0f)};
  scene.environment->strength = strength;
  return scene;
}

// Without a table, too: what is told beforehand is what the table will hold.
TEST(LightTable, DarknessIsToldBeforehand) {
  scene::Scene lamp = scene_of({0}), lamps_out = scene_of({0, 0}), black = scene_of({1});
  lamp.punctual_lights = {point_light(0.0f), point_light(1.0f)};
  lamps_out.punctual_lights = {point_light(0.0f)};
  black.textures = {texture_of(2, {0, 0, 0, 255})};
  black.materials[1].emissive_texture.emplace();
  scene::Scene lit = black, flat = scene_of({1});
  lit.textures[0].rgba8[2] = {1, 0, 0, 255};
  lay_out(lit.triangles[0], {0, 0}, {0, 1}, {1, 1});
  flat.triangles[0].corners[2].position = flat.triangles[0].corners[1].position;
  const std::pair<scene::Scene, bool> rows[] = {{scene_of({0, 0}), false},
                                                {scene_of({0, 1}), true},
                                                {lamp, true},
                                                {lamps_out, false},
                                                {black, false},
                                                {lit, true},
                                                {flat, false},
                                                {under_sky(1, 1), true},
                                                {under_sky(0, 1), false},
                                                {under_sky(1, 0), false},
                                                {under_sky(1e-30f, 1), true},
                                                {under_sky(1e-38f, 1e-3f), false}};
  std::size_t row = 0;
  for (const auto& [scene, shines] : rows) {
    const std::vector<std::uint32_t> order{0, 1};
    const EnvironmentTable sky =
        scene.environment ? make_environment_table(*scene.environment) : EnvironmentTable{};
    const LightTable table = make_light_table(scene, std::span(order).first(scene.triangles.size()),
                                              glm::vec3(0.0f), 1.0f, sky);
    EXPECT_EQ(gives_off_light(scene), shines) << row;
    EXPECT_EQ(!table.records.empty(), shines) << row;
    ++row;
  }
}

TEST(LightTable, ReadsPunctualLights) {
  scene::Scene scene = scene_of({0});
  scene::PunctualLight spot = point_light(3.0f);
  spot.kind = scene::PunctualKind::spot;
  spot.position = glm::vec3(0.1f, 0.2f, 0.3f);
  spot.direction = glm::vec3(0, -1, 0);
  spot.inner_cone_angle = 0.3f;
  spot.outer_cone_angle = 0.7f;
  scene::PunctualLight sun = point_light(5.0f);
  sun.kind = scene::PunctualKind::directional;
  sun.direction = glm::vec3(0, 0, -1);
  scene.punctual_lights = {spot, sun};
  const std::vector<std::uint32_t> order{0};
  const LightTable table = make_light_table(scene, order, glm::vec3(0.0f), 2.0f);
  ASSERT_EQ(table.records.size(), 2u);
  EXPECT_EQ(table.records[0].kind, PPM_LIGHT_SPOT);
  EXPECT_EQ(table.records[0].position, spot.position);
  EXPECT_EQ(table.records[0].direction, spot.direction);
  EXPECT_NEAR(table.records[0].cos_inner, std::cos(0.3), 1e-7);
  EXPECT_NEAR(table.records[0].cos_outer, std::cos(0.7), 1e-7);
  EXPECT_EQ(table.records[1].kind, PPM_LIGHT_DIRECTIONAL);
  // The spot by the closed form of its ramp, the sun by the disc of radius 2.
  const double cone =
      2.0 * std::numbers::pi * ((1.0 - std::cos(0.3)) + (std::cos(0.3) - std::cos(0.7)) / 3.0);
  EXPECT_NEAR(table.total_power, 3.0 * cone + 5.0 * std::numbers::pi * 4.0, 1e-4);
}

}  // namespace
}  // namespace ppm::render
