// What kernels are told of a scene beforehand, trait by trait.
#include "scene_traits.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "shared/bindings.h"

namespace ppm::render {
namespace {

/// A scene of one dull material, and what makes it less plain.
struct Row {
  const char* what;
  std::function<void(scene::Scene&, scene::Material&)> change;
  std::vector<std::string> traits;
};

std::vector<std::string> names_of(const SceneTraits& traits) {
  std::vector<std::string> names;
  const auto add = [&](const char* name, bool is_there) {
    if (is_there) names.emplace_back(name);
  };
  add("rough_gloss", traits.rough_gloss);
  add("textures", traits.textures);
  add("details", traits.details);
  add("coverage", traits.coverage);
  add("layers", traits.layers);
  add("dispersion", traits.dispersion);
  add("media", traits.media);
  add("environment", traits.environment);
  add("textured_lights", traits.textured_lights);
  return names;
}

scene::Scene scene_of(const Row& row) {
  scene::Scene scene;
  scene::Material material;
  material.metallic = material.specular = 0.0f;
  row.change(scene, material);
  scene.materials.push_back(material);
  return scene;
}

void make_glass(scene::Material& material, float roughness) {
  material.transmission = 1.0f;
  material.roughness = roughness;
}

scene::Environment sky(float radiance, float strength) {
  scene::Environment environment;
  environment.width = 2;
  environment.height = 1;
  environment.texels = {glm::vec3(0.0f), glm::vec3(0.0f, radiance, 0.0f)};
  environment.strength = strength;
  return environment;
}

std::vector<Row> rows() {
  using scene::Material;
  using scene::Scene;
  return {
      {"nothing", [](Scene&, Material&) {}, {}},
      {"gloss", [](Scene&, Material& m) { m.specular = 0.1f; }, {"rough_gloss"}},
      {"metal", [](Scene&, Material& m) { m.metallic = 0.1f; }, {"rough_gloss"}},
      {"mirror", [](Scene&, Material& m) { m.metallic = 1.0f, m.roughness = 0.01f; }, {}},
      {"texture", [](Scene& s, Material&) { s.textures.resize(1); }, {"textures"}},
      {"tangents", [](Scene& s, Material&) { s.details.resize(1); }, {"details"}},
      {"mask", [](Scene&, Material& m) { m.alpha_mode = scene::AlphaMode::mask; }, {"coverage"}},
      {"veil", [](Scene&, Material& m) { m.alpha_mode = scene::AlphaMode::blend; }, {"coverage"}},
      {"coat", [](Scene&, Material& m) { m.clearcoat = 0.1f; }, {"layers"}},
      {"sheet", [](Scene&, Material& m) { make_glass(m, 0.01f); }, {}},
      {"frosted sheet", [](Scene&, Material& m) { make_glass(m, 0.5f); }, {"layers"}},
      {"dispersive sheet",
       [](Scene&, Material& m) { make_glass(m, 0.01f), m.dispersion = 1.0f; },
       {}},
      {"solid", [](Scene&, Material& m) { make_glass(m, 0.01f), m.solid = true; }, {"media"}},
      {"prism",
       [](Scene&, Material& m) { make_glass(m, 0.01f), m.solid = true, m.dispersion = 1.0f; },
       {"dispersion", "media"}},
      {"sky", [](Scene& s, Material&) { s.environment = sky(1.0f, 1.0f); }, {"environment"}},
      {"black sky", [](Scene& s, Material&) { s.environment = sky(0.0f, 1.0f); }, {}},
      {"sky put out", [](Scene& s, Material&) { s.environment = sky(1.0f, 0.0f); }, {}},
      {"screen",
       [](Scene& s, Material& m) {
         s.textures.resize(1);
         m.emission = glm::vec3(1.0f);
         m.emissive_texture = scene::TextureUse{};
       },
       {"textures", "textured_lights"}},
  };
}

TEST(SceneTraits, AreWhatTheMaterialsNeed) {
  for (const Row& row : rows())
    EXPECT_EQ(names_of(traits_of(scene_of(row))), row.traits) << row.what;
}

// Kernels for plain scenes have neither of the rest, nor buffers of several segments.
TEST(SceneTraits, OfPlainScenesAreGlossAndMediaAlone) {
  const SceneTraits plain = traits_of(scene_of(rows().front()));
  EXPECT_TRUE(plain.is_plain());
  const std::pair<bool SceneTraits::*, bool> each[] = {
      {&SceneTraits::rough_gloss, true},     {&SceneTraits::media, true},
      {&SceneTraits::textures, false},       {&SceneTraits::details, false},
      {&SceneTraits::coverage, false},       {&SceneTraits::layers, false},
      {&SceneTraits::dispersion, false},     {&SceneTraits::environment, false},
      {&SceneTraits::textured_lights, false}};
  for (const auto& [trait, is_plain] : each) {
    SceneTraits traits = plain;
    traits.*trait = true;
    EXPECT_EQ(traits.is_plain(), is_plain) << names_of(traits).front();
  }
  SceneTraits segmented = plain;
  segmented.segments[PPM_BIND_BVH_NODES] = 2;
  EXPECT_FALSE(segmented.is_plain());
}

}  // namespace
}  // namespace ppm::render
