// Materials, their extensions and textures, and that whatever is not read is warned of exactly
// once.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "load_gltf.hpp"
#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::Material;
using scene::Scene;

/// A document whose only triangle has this material. Its frame's scale is 2.
GltfDocument with_material(json material) {
  GltfDocument document;
  document.triangle()["material"] = document.append("materials", std::move(material));
  return document;
}

Material material_of(json material) {
  return load(with_material(std::move(material))).materials.at(0);
}

json extension(const char* name, json members) {
  return {{"extensions", {{name, std::move(members)}}}};
}

TEST(LoadGltfMaterials, DefaultsAreThoseOfGltf) {
  for (const Material& material : {material_of(json::object()), load([] {
                                                                  GltfDocument document;
                                                                  document.triangle();
                                                                  return document;
                                                                }())
                                                                    .materials.at(0)}) {
    EXPECT_EQ(material.base_color, glm::vec3(1.0f));
    EXPECT_FALSE(material.base_color_texture.has_value());
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 1.0f);
    EXPECT_EQ(material.specular, 1.0f);
    EXPECT_EQ(material.specular_color, glm::vec3(1.0f));
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_EQ(material.transmission, 0.0f);
    EXPECT_FALSE(material.solid);
    EXPECT_EQ(material.attenuation_color, glm::vec3(1.0f));
    EXPECT_EQ(material.attenuation_distance, std::numeric_limits<float>::infinity());
    EXPECT_EQ(material.emission, glm::vec3(0.0f));
    EXPECT_FALSE(material.double_sided);
  }
}

TEST(LoadGltfMaterials, CoreFactors) {
  const Material material = material_of({{"name", "paint"},
                                         {"alphaMode", "MASK"},
                                         {"alphaCutoff", 0.5},
                                         {"extras", {{"priority", 3}}},
                                         {"doubleSided", true},
                                         {"emissiveFactor", {0.25, 0.5, 1}},
                                         {"pbrMetallicRoughness",
                                          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                                           {"metallicFactor", 0.5},
                                           {"roughnessFactor", 0.25}}}});
  EXPECT_EQ(material.name, "paint");
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.emission, glm::vec3(0.25f, 0.5f, 1.0f));
  EXPECT_EQ(material.base_color, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(material.alpha, 0.4f);
  EXPECT_EQ(material.alpha_mode, scene::AlphaMode::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.5f);
  EXPECT_EQ(material.priority, 3);
  EXPECT_EQ(material.metallic, 0.5f);
  EXPECT_EQ(material.roughness, 0.25f);
}

TEST(LoadGltfMaterials, Extensions) {
  json emissive = extension("KHR_materials_emissive_strength", {{"emissiveStrength", 40}});
  emissive["emissiveFactor"] = {0.5, 0.25, 0};
  EXPECT_EQ(material_of(emissive).emission, glm::vec3(20.0f, 10.0f, 0.0f));

  const Material specular = material_of(extension(
      "KHR_materials_specular", {{"specularFactor", 0}, {"specularColorFactor", {0.5, 2, 0}}}));
  EXPECT_EQ(specular.specular, 0.0f);
  EXPECT_EQ(specular.specular_color, glm::vec3(0.5f, 2.0f, 0.0f));

  EXPECT_EQ(material_of(extension("KHR_materials_ior", {{"ior", 1.33}})).ior, 1.33f);
  EXPECT_EQ(material_of(extension("KHR_materials_ior", {{"ior", 0}})).ior, 0.0f);
  EXPECT_EQ(material_of(extension("KHR_materials_dispersion", {{"dispersion", 0.5}})).dispersion,
            0.5f);
  const Material coated = material_of(extension(
      "KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.125}}));
  EXPECT_EQ(coated.clearcoat, 0.75f);
  EXPECT_EQ(coated.clearcoat_roughness, 0.125f);
  EXPECT_EQ(material_of(extension("KHR_materials_transmission", {{"transmissionFactor", 0.75}}))
                .transmission,
            0.75f);
}

TEST(LoadGltfMaterials, UnlitOnesNeitherGlowNorReflect) {
  json members = extension("KHR_materials_unlit", json::object());
  members["emissiveFactor"] = {1, 1, 1};
  members["pbrMetallicRoughness"] = {{"baseColorFactor", {0.5, 0.25, 1, 1}}};
  const Material material = material_of(members);
  EXPECT_TRUE(material.unlit);
  EXPECT_EQ(material.emission, glm::vec3(0.0f));
  EXPECT_EQ(material.metallic, 0.0f);
  EXPECT_EQ(material.specular, 0.0f);
  EXPECT_EQ(material.base_color, glm::vec3(0.5f, 0.25f, 1.0f));
}

TEST(LoadGltfMaterials, VolumesAreSolidAndTheirDistanceIsInTheWorkingFrame) {
  const Material thin =
      material_of(extension("KHR_materials_volume", {{"attenuationDistance", 3}}));
  EXPECT_FALSE(thin.solid);
  const Material solid =
      material_of(extension("KHR_materials_volume", {{"thicknessFactor", 0.1},
                                                     {"attenuationDistance", 3},
                                                     {"attenuationColor", {0.5, 1, 0.25}}}));
  EXPECT_TRUE(solid.solid);
  EXPECT_EQ(solid.attenuation_distance, 6.0f);
  EXPECT_EQ(solid.attenuation_color, glm::vec3(0.5f, 1.0f, 0.25f));
  const Material clear = material_of(extension("KHR_materials_volume", {{"thicknessFactor", 1}}));
  EXPECT_EQ(clear.attenuation_distance, std::numeric_limits<float>::infinity());
}

TEST(LoadGltfMaterials, OnlyUsedOnesAreKeptInOrderOfUse) {
  GltfDocument document;
  for (const char* name : {"a", "b", "c"}) document.append("materials", {{"name", name}});
  document.triangle()["material"] = 2;
  document.triangle();
  document.triangle()["material"] = 0;
  document.triangle()["material"] = 2;
  const Scene scene = load(document);
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(scene.materials[0].name, "c");
  EXPECT_EQ(scene.materials[2].name, "a");
  EXPECT_EQ(scene.triangles[0].material, 0u);
  EXPECT_EQ(scene.triangles[1].material, 1u);
  EXPECT_EQ(scene.triangles[2].material, 2u);
  EXPECT_EQ(scene.triangles[3].material, 0u);
}

TEST(LoadGltfMaterials, FactorsOutOfRangeAreClampedWithOneWarningEach) {
  GltfDocument document = with_material(
      {{"emissiveFactor", {-1, 0, 7}},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {2, -1, 0.5, 1}},
         {"metallicFactor", -0.5},
         {"roughnessFactor", 1e300}}},
       {"extensions",
        {{"KHR_materials_ior", {{"ior", 0.5}}},
         {"KHR_materials_volume", {{"thicknessFactor", 1}, {"attenuationDistance", -2}}}}}});
  document.triangle()["material"] = document.append("materials", document.root["materials"][0]);
  Log log(Verbosity::quiet);
  const Scene scene = load(document, log);
  for (const Material& material : scene.materials) {
    EXPECT_EQ(material.emission, glm::vec3(0, 0, 1));
    EXPECT_EQ(material.base_color, glm::vec3(1.0f, 0.0f, 0.5f));
    EXPECT_EQ(material.metallic, 0.0f);
    EXPECT_EQ(material.roughness, 1.0f);
    EXPECT_EQ(material.ior, 1.0f);
    EXPECT_EQ(material.attenuation_distance, std::numeric_limits<float>::infinity());
  }
  EXPECT_EQ(log.warnings().size(), 6u);
  EXPECT_EQ(warnings_with(log, "materials[0].pbrMetallicRoughness.metallicFactor"), 1u);
}

// ---- Warnings

struct Unread {
  const char* name;
  std::function<void(GltfDocument&)> add;  // to a document of two triangles with a material each
  const char* fragment;
};

void for_all_materials(GltfDocument& document, const std::function<void(json&)>& change) {
  for (json& material : document.root["materials"]) change(material);
}

std::vector<Unread> unread_features() {
  const auto member = [](const char* name, json value) {
    return [=](GltfDocument& d) { for_all_materials(d, [&](json& m) { m[name] = value; }); };
  };
  const auto in_extension = [](const char* name, json value) {
    return [=](GltfDocument& d) {
      for_all_materials(d, [&](json& m) { m["extensions"][name] = value; });
    };
  };
  const json texture = {{"index", 0}};
  return {
      {"occlusion", member("occlusionTexture", texture), "occlusionTexture"},
      {"alpha", member("alphaMode", "DITHER"), "alphaMode"},
      {"third texcoords",
       member("pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 2}}}}),
       "TEXCOORD_1"},
      {"no source", member("pbrMetallicRoughness", {{"baseColorTexture", texture}}), "source"},
      {"thickness texture", in_extension("KHR_materials_volume", {{"thicknessTexture", texture}}),
       "thicknessTexture"},
      {"unknown extension", in_extension("KHR_materials_sheen", json::object()),
       "KHR_materials_sheen"},
      {"declared extension",
       [](GltfDocument& d) {
         d.root["extensionsUsed"] = {"EXT_b", "KHR_materials_ior", "EXT_a"};
       },
       "EXT_a, EXT_b"},
      {"animations",
       [](GltfDocument& d) {
         d.root["animations"] = {json::object(), json::object()};
       },
       "animations"},
      {"lines",
       [](GltfDocument& d) {
         for (int i = 0; i < 2; ++i) d.triangle()["mode"] = i;
       },
       "points and lines"},
      {"no positions",
       [](GltfDocument& d) {
         for (int i = 0; i < 2; ++i) d.mesh(json::object());
       },
       "POSITION"},
  };
}

TEST(LoadGltfMaterials, WhatIsNotReadIsWarnedOfOnce) {
  for (const Unread& feature : unread_features()) {
    GltfDocument document = with_material(json::object());
    document.triangle()["material"] = document.append("materials", json::object());
    document.append("textures", json::object());
    feature.add(document);
    Log log(Verbosity::quiet);
    EXPECT_EQ(load(document, log).triangles.size(), 2u) << feature.name;
    EXPECT_EQ(log.warnings().size(), 1u) << feature.name;
    EXPECT_EQ(warnings_with(log, feature.fragment), 1u) << feature.name;
  }
}

TEST(LoadGltfMaterials, WhatIsReadIsNotWarnedOf) {
  GltfDocument document =
      with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  document.append("samplers", {{"wrapS", 10497}, {"minFilter", 9987}});
  document.append("textures", {{"source", 0}, {"sampler", 0}});
  const Bytes image = png_of(1, 1, std::vector<std::uint8_t>{9, 9, 9, 255});
  document.append("images", {{"bufferView", document.view(image)}, {"mimeType", "image/png"}});
  json& material = document.root["materials"][0];
  material["alphaMode"] = "OPAQUE";
  material["extras"] = {{"extensions", {{"note", 1}}}};
  material["pbrMetallicRoughness"]["roughnessFactor"] = 0;
  material["extensions"] = {{"KHR_materials_specular", {{"specularFactor", 0.5}}},
                            {"KHR_materials_ior", {{"ior", 1.4}}},
                            {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                            {"KHR_materials_volume", {{"thicknessFactor", 1}}},
                            {"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}}};
  document.root["extensionsUsed"] = document.root["extensionsRequired"] = {
      "KHR_materials_specular", "KHR_materials_ior", "KHR_materials_transmission",
      "KHR_materials_volume", "KHR_materials_emissive_strength"};
  Log log(Verbosity::quiet);
  load(document, log);
  EXPECT_TRUE(log.warnings().empty()) << log.warnings().front();
}

}  // namespace
}  // namespace ppm::test
