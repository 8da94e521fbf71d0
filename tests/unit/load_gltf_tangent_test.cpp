// Tangents, read and computed, and the second texture coordinates: MikkTSpace's convention, worked
// out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_mesh.hpp"
#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::TriangleDetail;
using scene::gltf::Baked;
using scene::gltf::DetailNeeds;
using scene::gltf::needs_of;

constexpr DetailNeeds kTangents{true, 0, false};

/// The triangles and details of the first mesh, placed by `to_world`.
Baked baked(const GltfDocument& document, const DetailNeeds& needs,
            const glm::dmat4& to_world = glm::dmat4(1.0)) {
  const TemporaryFolder folder;
  document.write_gltf(folder / "scene.gltf");
  Log log(Verbosity::quiet);
  scene::gltf::Document read = scene::gltf::read_document(folder / "scene.gltf", log);
  scene::gltf::MaterialUses materials;
  const scene::gltf::Place list(read, "meshes");
  const auto primitives =
      scene::gltf::read_primitives({list.item(0), read.model.meshes.at(0)}, materials);
  scene::gltf::Pose pose;
  pose.to_world = to_world;
  const scene::gltf::PosedPrimitive posed(primitives.at(0), pose);
  scene::gltf::Box box;
  scene::gltf::extend(box, posed);
  Baked result;
  result.with_details = needs.any();
  scene::gltf::bake(posed, {}, needs, result);
  return result;
}

void expect_tangent(const glm::vec4& actual, glm::dvec3 direction, float w, const char* what) {
  expect_near(glm::dvec3(actual), glm::normalize(direction), 1e-6, what);
  EXPECT_EQ(actual.w, w) << what;
}

/// The unit square with normals along z and these texture coordinates.
GltfDocument square(const std::vector<float>& texcoords) {
  GltfDocument document;
  json& primitive = document.mesh(
      {{"POSITION", document.accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3")},
       {"NORMAL", document.accessor<float>({0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
       {"TEXCOORD_0", document.accessor(texcoords, "VEC2")}});
  primitive["indices"] = document.accessor<std::uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
  return document;
}

// v points down in a picture: the bitangent, w cross(n, t), up.
TEST(Tangents, FollowTheTexture) {
  struct Layout {
    const char* name;
    std::vector<float> texcoords;
    glm::dvec3 tangent;
    float w;
  };
  const std::vector<Layout> table{
      {"upright", {0, 1, 1, 1, 1, 0, 0, 0}, {1, 0, 0}, 1},
      {"mirrored", {1, 1, 0, 1, 0, 0, 1, 0}, {-1, 0, 0}, -1},
      {"upside down", {0, 0, 1, 0, 1, 1, 0, 1}, {1, 0, 0}, -1},
      {"turned left", {0, 0, 0, 1, 1, 1, 1, 0}, {0, 1, 0}, 1},
      {"stretched", {0, 9, 0.1f, 9, 0.1f, 2, 0, 2}, {1, 0, 0}, 1},
      {"sheared", {0, 1, 1, 1, 2, 0, 1, 0}, {1, 0, 0}, 1},
  };
  for (const Layout& layout : table) {
    const Baked result = baked(square(layout.texcoords), kTangents);
    ASSERT_EQ(result.details.size(), 2u);
    for (const TriangleDetail& detail : result.details) {
      for (const auto& corner : detail) {
        expect_tangent(corner.tangent, layout.tangent, layout.w, layout.name);
      }
    }
  }
}

// Vertex 0 has 90 degrees of a triangle whose u runs along x, and 45 of one whose u runs along y.
// Equal vertices are one where there are no indices.
TEST(Tangents, OfATriangleCountByItsAngle) {
  for (const bool by_index : {true, false}) {
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, -3, 0, 0, -3, -3, 0};
    const std::vector<float> texcoords{0, 0, 1, 0, 0, -1, 0, 0, 0, -3, -3, -3};
    std::vector<float> normals;
    for (int i = 0; i < 6; ++i) normals.insert(normals.end(), {0, 0, 1});
    GltfDocument document;
    json& primitive = document.mesh({{"POSITION", document.accessor(positions, "VEC3")},
                                     {"NORMAL", document.accessor(normals, "VEC3")},
                                     {"TEXCOORD_0", document.accessor(texcoords, "VEC2")}});
    if (by_index) {
      primitive["indices"] = document.accessor<std::uint8_t>({0, 1, 2, 0, 4, 5}, "SCALAR");
    }
    const Baked result = baked(document, kTangents);
    ASSERT_EQ(result.details.size(), 2u);
    expect_tangent(result.details[0][0].tangent, {2, 1, 0}, 1, "shared");
    expect_tangent(result.details[1][0].tangent, {2, 1, 0}, 1, "shared");
    expect_tangent(result.details[0][1].tangent, {1, 0, 0}, 1, "alone");
    expect_tangent(result.details[1][1].tangent, {0, 1, 0}, 1, "alone");
  }
}

// Two triangles that share an edge, the texture mirrored along it.
TEST(Tangents, OfMirroredTexturesDoNotMix) {
  GltfDocument document = square({0, 1, 1, 1, 1, 0, 0, 0});
  document.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      document.accessor<float>({0, 0, 1, 0, 1, -1, 1, 0}, "VEC2");
  // The first: u = x, v = -y. The second has (0,0), (1,-1), (1,0): u = y, v = -x, mirrored.
  const Baked result = baked(document, kTangents);
  ASSERT_EQ(result.details.size(), 2u);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_tangent(result.details[0][i].tangent, {1, 0, 0}, 1, "upright");
    expect_tangent(result.details[1][i].tangent, {0, 1, 0}, -1, "mirrored");
  }
}

// Across the normal, which leans towards y by half a right angle.
TEST(Tangents, LieAcrossTheNormal) {
  GltfDocument document = square({0, 0, 0, 1, 1, 1, 1, 0});  // u along y
  const float h = std::sqrt(0.5f);
  document.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      document.accessor<float>({0, h, h, 0, h, h, 0, h, h, 0, h, h}, "VEC3");
  for (const TriangleDetail& detail : baked(document, kTangents).details) {
    for (const auto& corner : detail) expect_tangent(corner.tangent, {0, 1, -1}, 1, "leaning");
  }
}

// Where every triangle has its own normal, vertices are not shared.
TEST(Tangents, LieInTheTriangleWhereThereAreNoNormals) {
  GltfDocument document;
  json& primitive = document.mesh(
      {{"POSITION", document.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 1}, "VEC3")},
       {"TEXCOORD_0", document.accessor<float>({0, 0, 1, 0, 0, -1, -1, 0}, "VEC2")}});
  primitive["indices"] = document.accessor<std::uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
  const Baked result = baked(document, kTangents);
  ASSERT_EQ(result.details.size(), 2u);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_tangent(result.details[0][i].tangent, {1, 0, 0}, 1, "flat");
    expect_tangent(result.details[1][i].tangent, {1, 0, -1}, 1, "folded");
  }
}

TEST(Tangents, OfTheFileTurnWithTheNode) {
  GltfDocument document = square({0, 1, 1, 1, 1, 0, 0, 0});
  document.root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
      document.accessor<float>({1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, -1}, "VEC4");
  glm::dmat4 mirrored(1.0);
  mirrored[0][0] = -3.0;
  const Baked plain = baked(document, kTangents), turned = baked(document, kTangents, mirrored);
  expect_tangent(plain.details[0][0].tangent, {1, 1, 0}, 1, "plain");
  expect_tangent(plain.details[1][2].tangent, {1, 1, 0}, -1, "plain");
  // Corners 1 and 2 have changed places.
  expect_tangent(turned.details[0][0].tangent, {-3, 1, 0}, -1, "mirrored");
  expect_tangent(turned.details[1][1].tangent, {-3, 1, 0}, 1, "mirrored");
}

// Where a texture has no area there is no tangent but any.
TEST(Tangents, AreUnitVectorsAcrossTheNormalWhateverTheTexture) {
  const float nan = std::nanf("");
  for (const std::vector<float>& texcoords :
       {std::vector<float>(8, 0.5f), std::vector<float>(8, nan), {0, 0, 1, 1, 2, 2, 3, 3}}) {
    for (const TriangleDetail& detail : baked(square(texcoords), kTangents).details) {
      for (const auto& corner : detail) {
        const glm::dvec3 tangent(corner.tangent);
        EXPECT_NEAR(glm::length(tangent), 1.0, 1e-6);
        EXPECT_NEAR(tangent.z, 0.0, 1e-6);
        EXPECT_EQ(std::abs(corner.tangent.w), 1.0f);
      }
    }
  }
}

TEST(Details, TheSecondSetGoesWithTheCorners) {
  GltfDocument document;
  document.triangle()["attributes"]["TEXCOORD_1"] =
      document.accessor<std::uint8_t>({0, 255, 255, 0, 51, 51}, "VEC2", true);
  glm::dmat4 mirrored(1.0);
  mirrored[2][2] = -1.0;
  const Baked result = baked(document, {false, 0, true}, mirrored);
  ASSERT_EQ(result.details.size(), 1u);
  EXPECT_EQ(result.details[0][0].texcoord1, glm::vec2(0.0f, 1.0f));
  EXPECT_EQ(result.details[0][1].texcoord1, glm::vec2(0.2f, 0.2f));
  EXPECT_EQ(result.details[0][2].texcoord1, glm::vec2(1.0f, 0.0f));
}

TEST(Details, MaterialsNeedWhatTheirTexturesDo) {
  scene::Material material;
  EXPECT_FALSE(needs_of(material).any());
  material.base_color_texture = material.emissive_texture = scene::TextureUse{};
  EXPECT_FALSE(needs_of(material).any());
  material.normal_texture = scene::TextureUse{};
  EXPECT_TRUE(needs_of(material).tangents);
  EXPECT_FALSE(needs_of(material).texcoord1);
  material.normal_texture = scene::TextureUse{.texcoord_set = 1};
  EXPECT_EQ(needs_of(material).tangent_set, 1u);
  EXPECT_TRUE(needs_of(material).texcoord1);
  scene::Material second;
  second.emissive_texture = scene::TextureUse{.texcoord_set = 1};
  EXPECT_TRUE(needs_of(second).texcoord1);
  EXPECT_FALSE(needs_of(second).tangents);
}

}  // namespace
}  // namespace ppm::test
