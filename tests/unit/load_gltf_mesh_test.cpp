// Topologies, accessors and vertex attributes, against what glTF 2.0 says they mean, worked out by
// hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "load_gltf.hpp"
#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::Scene;

TEST(LoadGltf, NormalsTransformByTheInverseTranspose) {
  GltfDocument document;
  const float h = std::sqrt(0.5f);
  document.mesh({{"POSITION", document.accessor<float>({1, 0, 0, 0, 1, 0, 1, 0, 1}, "VEC3")},
                 {"NORMAL", document.accessor<float>({h, h, 0, h, h, 0, h, h, 0}, "VEC3")}});
  document.root["nodes"][0]["scale"] = {2, 1, 5};
  const Scene scene = load(document);
  const glm::dvec3 expected = glm::normalize(glm::dvec3(0.5, 1.0, 0.0));
  for (const scene::Corner& corner : scene.triangles[0].corners) {
    expect_near(corner.normal, expected, 1e-6, "normal");
  }
  EXPECT_NEAR(std::abs(glm::dot(geometric_normal(scene.triangles[0]), glm::vec3(expected))), 1.0,
              1e-6);
}

TEST(LoadGltf, NormalsAreFlatWhereAbsentZeroOrNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  GltfDocument document;
  document.triangle();
  document.triangle()["attributes"]["NORMAL"] =
      document.accessor<float>({0, 0, 0, nan, 0, 0, 2, 0, 0}, "VEC3");
  Log log(Verbosity::quiet);
  const Scene scene = load(document, log);
  EXPECT_EQ(scene.triangles[0].corners[2].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.triangles[1].corners[0].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.triangles[1].corners[1].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.triangles[1].corners[2].normal, glm::vec3(1, 0, 0));
  EXPECT_EQ(warnings_with(log, "normals"), 1u);
}

TEST(LoadGltf, FlattenedMeshesKeepWhatAreaIsLeft) {
  GltfDocument document;
  document.mesh(
      {{"POSITION", document.accessor<float>(
                        {0, 0, 0, 1, 0, 7, 0, 1, -4, 0, 0, 0, 0, 0, 1, 0, 0, 2}, "VEC3")}});
  document.root["nodes"][0]["scale"] = {1, 1, 0};
  const Scene scene = load(document);
  ASSERT_EQ(scene.triangles.size(), 1u);
  expect_corners(scene, 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  EXPECT_EQ(scene.triangles[0].corners[0].normal, glm::vec3(0, 0, 1));
}

TEST(LoadGltf, DropsTrianglesWithoutArea) {
  GltfDocument document;
  document.triangle()["indices"] =
      document.accessor<std::uint8_t>({0, 1, 1, 0, 1, 2, 2, 2, 2, 0, 2, 1}, "SCALAR");
  document.mesh(
      {{"POSITION", document.accessor<float>({0, 0, 0, 0.25, 0.25, 0, 0.75, 0.75, 0}, "VEC3")}});
  document.append("nodes", {{"mesh", 0}, {"scale", {0, 0, 0}}});
  const Scene scene = load(document);
  ASSERT_EQ(scene.triangles.size(), 2u);
  expect_corners(scene, 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  expect_corners(scene, 1, {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}});
}

// Their squared area would be below the smallest float; in the file they are sound, unlike those
// without area, of which nobody needs to hear.
TEST(LoadGltf, WarnsOfTrianglesTooSmallBesideTheScene) {
  GltfDocument document;
  document.triangle();
  document.append("nodes", {{"mesh", 0}, {"scale", {1e10, 1e10, 1e10}}});
  document.append("nodes", {{"mesh", 0}, {"scale", {1, 0, 1}}});
  Log log(Verbosity::quiet);
  EXPECT_EQ(load(document, log).triangles.size(), 1u);
  EXPECT_EQ(warnings_with(log, "1 triangles are too small"), 1u);
}

const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::array<glm::dvec3, 3> kLower{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
const std::array<glm::dvec3, 3> kUpper{{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

template <typename Index>
void expect_square_by_indices() {
  GltfDocument document;
  document.mesh({{"POSITION", document.accessor(kSquare, "VEC3")}})["indices"] =
      document.accessor<Index>({0, 1, 2, 0, 2, 3}, "SCALAR");
  const Scene scene = load(document);
  ASSERT_EQ(scene.triangles.size(), 2u);
  expect_corners(scene, 0, kLower);
  expect_corners(scene, 1, kUpper);
}

TEST(LoadGltf, IndicesOfEveryWidth) {
  expect_square_by_indices<std::uint8_t>();
  expect_square_by_indices<std::uint16_t>();
  expect_square_by_indices<std::uint32_t>();
}

TEST(LoadGltf, IndicesBeyondSixteenBits) {
  std::vector<float> positions(3 * 70000, 0.0f);
  const std::vector<float> last{0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::copy(last.begin(), last.end(), positions.end() - 9);
  GltfDocument document;
  document.mesh({{"POSITION", document.accessor(positions, "VEC3")}})["indices"] =
      document.accessor<std::uint32_t>({69997, 69998, 69999}, "SCALAR");
  expect_corners(load(document), 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
}

TEST(LoadGltf, StripsTurnEveryOtherTriangle) {
  GltfDocument document;
  document.mesh(
      {{"POSITION", document.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0},
                                             "VEC3")}})["mode"] = 5;
  const Scene scene = load(document);
  ASSERT_EQ(scene.triangles.size(), 3u);
  expect_corners(scene, 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  expect_corners(scene, 1, {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  expect_corners(scene, 2, {{{0, 1, 0}, {1, 1, 0}, {0, 2, 0}}});
  for (const scene::Triangle& triangle : scene.triangles)
    EXPECT_GT(geometric_normal(triangle).z, 0.99f);
}

TEST(LoadGltf, FansShareTheirFirstVertex) {
  GltfDocument document;
  json& primitive = document.mesh({{"POSITION", document.accessor(kSquare, "VEC3")}});
  primitive["mode"] = 6;
  primitive["indices"] = document.accessor<std::uint16_t>({0, 1, 2, 3}, "SCALAR");
  const Scene scene = load(document);
  ASSERT_EQ(scene.triangles.size(), 2u);
  expect_corners(scene, 0, {{{1, 0, 0}, {1, 1, 0}, {0, 0, 0}}});
  expect_corners(scene, 1, {{{1, 1, 0}, {0, 1, 0}, {0, 0, 0}}});
}

TEST(LoadGltf, InterleavedAttributes) {
  GltfDocument document;
  const std::size_t view = document.view(bytes_of<float>({9, 9,                 // byteOffset 8
                                                          0, 0, 0, 0.0f, 0.0f,  //
                                                          4, 0, 0, 0.5f, 0.0f,  //
                                                          0, 4, 0, 0.0f, 0.25f}));
  document.root["bufferViews"][view]["byteStride"] = 20;
  json item = {{"bufferView", view}, {"componentType", 5126}, {"count", 3}};
  item.update({{"type", "VEC3"}, {"byteOffset", 8}});
  const std::size_t position = document.append("accessors", item);
  item.update({{"type", "VEC2"}, {"byteOffset", 20}});
  document.mesh({{"POSITION", position}, {"TEXCOORD_0", document.append("accessors", item)}});
  const Scene scene = load(document);
  expect_corners(scene, 0, {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}});
  EXPECT_EQ(scene.triangles[0].corners[1].texcoord, glm::vec2(0.5f, 0.0f));
  EXPECT_EQ(scene.triangles[0].corners[2].texcoord, glm::vec2(0.0f, 0.25f));
}

json sparse_of(GltfDocument& document) {
  return {{"count", 2},
          {"indices", {{"bufferView", document.view({0, 2})}, {"componentType", 5121}}},
          {"values", {{"bufferView", document.view(bytes_of<float>({0, 0, 5, 0, 3, 0}))}}}};
}

TEST(LoadGltf, SparseAccessorsReplaceElements) {
  GltfDocument document;
  document.triangle();
  document.root["accessors"][0]["sparse"] = sparse_of(document);
  expect_corners(load(document), 0, {{{0, 0, 5}, {1, 0, 0}, {0, 3, 0}}});
}

TEST(LoadGltf, SparseAccessorsWithoutABufferViewStartFromZeros) {
  GltfDocument document;
  document.mesh({{"POSITION", 0}});
  document.append("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}});
  document.root["accessors"][0]["sparse"] = sparse_of(document);
  document.root["meshes"][0]["primitives"][0]["mode"] = 6;
  const Scene scene =
      load(document);  // (0,0,5), 0, (0,3,0), 0: of the fan's two triangles both have area
  ASSERT_EQ(scene.triangles.size(), 2u);
  expect_corners(scene, 0, {{{0, 0, 0}, {0, 3, 0}, {0, 0, 5}}});
}

TEST(LoadGltf, NormalisedIntegers) {
  GltfDocument document;
  json& attributes = document.triangle()["attributes"];
  attributes["COLOR_0"] =
      document.accessor<std::uint8_t>({0, 51, 255, 255, 0, 0, 0, 255, 0}, "VEC3", true);
  attributes["TEXCOORD_0"] =
      document.accessor<std::uint16_t>({0, 0, 65535, 13107, 0, 0}, "VEC2", true);
  attributes["NORMAL"] =
      document.accessor<std::int8_t>({0, 0, 127, -128, 0, 0, 0, -127, 0}, "VEC3", true);
  const Scene scene = load(document);
  const auto& corners = scene.triangles[0].corners;
  EXPECT_EQ(corners[0].color, glm::vec4(0.0f, 0.2f, 1.0f, 1.0f));
  EXPECT_EQ(corners[1].color, glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
  EXPECT_EQ(corners[1].texcoord, glm::vec2(1.0f, 0.2f));
  EXPECT_EQ(corners[0].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(corners[1].normal, glm::vec3(-1, 0, 0));
  EXPECT_EQ(corners[2].normal, glm::vec3(0, -1, 0));
}

TEST(LoadGltf, VertexColoursOfEveryType) {
  GltfDocument document;
  document.triangle()["attributes"]["COLOR_0"] =
      document.accessor<float>({0.25f, 0.5f, 1, 0.75f, 0, 0, 0, 1, 1, 1, 1, 1}, "VEC4");
  document.triangle()["attributes"]["COLOR_0"] = document.accessor<std::uint16_t>(
      {65535, 0, 13107, 32768, 0, 0, 0, 9, 0, 0, 0, 9}, "VEC4", true);
  document.triangle()["attributes"]["COLOR_0"] =
      document.accessor<float>({-1, 2, 0.5f, 0, 0, 0, 0, 0, 0}, "VEC3");
  Log log(Verbosity::quiet);
  const Scene scene = load(document, log);
  EXPECT_EQ(scene.triangles[0].corners[0].color, glm::vec4(0.25f, 0.5f, 1.0f, 0.75f));
  EXPECT_EQ(scene.triangles[1].corners[0].color, glm::vec4(1.0f, 0.0f, 0.2f, 32768.0f / 65535.0f));
  EXPECT_EQ(scene.triangles[2].corners[0].color, glm::vec4(0.0f, 1.0f, 0.5f, 1.0f));
  EXPECT_EQ(warnings_with(log, "colours"), 1u);
}

TEST(LoadGltf, QuantisedPositions) {
  GltfDocument document;
  document.root["extensionsRequired"] = document.root["extensionsUsed"] = {"KHR_mesh_quantization"};
  document.mesh({{"POSITION", document.accessor<std::int16_t>(
                                  {-32767, 0, 0, 32767, 0, 0, 0, 32767, 0}, "VEC3", true)}});
  document.mesh(
      {{"POSITION", document.accessor<std::uint8_t>({0, 0, 0, 200, 0, 0, 0, 100, 0}, "VEC3")}});
  const Scene scene = load(document);
  expect_corners(scene, 0, {{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  expect_corners(scene, 1, {{{0, 0, 0}, {200, 0, 0}, {0, 100, 0}}});
}

}  // namespace
}  // namespace ppm::test
