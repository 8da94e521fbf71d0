// Geometry, nodes, lights and cameras: small files built here, and what glTF 2.0 says they mean,
// worked out by hand.
#include "load_gltf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "failure.hpp"
#include "gltf_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::PunctualKind;
using scene::Scene;

constexpr double kPi = std::numbers::pi;

// Positions are rounded to float once, in a frame where they are at most 1: half an ulp, 6e-8, of
// the extent.
constexpr double kPositionError = 1e-7;

void expect_near(glm::dvec3 actual, glm::dvec3 expected, double tolerance, const char* what) {
  EXPECT_LE(glm::length(actual - expected), tolerance)
      << what << ": (" << actual.x << ", " << actual.y << ", " << actual.z << ") instead of ("
      << expected.x << ", " << expected.y << ", " << expected.z << ")";
}

void expect_corners(const Scene& scene, std::size_t triangle,
                    const std::array<glm::dvec3, 3>& expected) {
  const std::array<glm::dvec3, 3> actual = world_corners(scene, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_near(actual[i], expected[i], kPositionError / scene.frame.scale, "corner");
  }
}

TEST(LoadGltf, FrameIsCentredAndAPowerOfTwo) {
  GltfDocument document;
  document.triangle();
  const Scene scene = load(document);
  ASSERT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.frame.scale, 2.0);
  EXPECT_EQ(scene.frame.centre, glm::dvec3(0.5, 0.5, 0.0));
  EXPECT_EQ(scene.triangles[0].corners[0].position, glm::vec3(-1, -1, 0));
  EXPECT_EQ(scene.triangles[0].corners[1].position, glm::vec3(1, -1, 0));
  EXPECT_EQ(scene.triangles[0].corners[2].position, glm::vec3(-1, 1, 0));
  EXPECT_EQ(scene.bounds_min, glm::vec3(-1, -1, 0));
  EXPECT_EQ(scene.bounds_max, glm::vec3(1, 1, 0));
}

TEST(LoadGltf, LargestCoordinateLiesBetweenOneHalfAndOne) {
  for (const double size : {1e-9, 0.003, 0.49, 0.5, 1.0, 1.9999, 2.0, 3.0, 1e6, 1e11}) {
    GltfDocument document;
    document.triangle();
    document.root["nodes"][0]["scale"] = {size, size, size};
    const Scene scene = load(document);
    EXPECT_GT(scene.bounds_max.x, 0.5f) << size;
    EXPECT_LE(scene.bounds_max.x, 1.0f) << size;
    EXPECT_EQ(std::exp2(std::round(std::log2(scene.frame.scale))), scene.frame.scale) << size;
  }
}

TEST(LoadGltf, AppliesScaleThenRotationThenTranslation) {
  GltfDocument document;
  document.triangle();
  json& node = document.root["nodes"][0];
  node["translation"] = {1, 2, 3};
  node["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // 90 degrees about z: x to y, y to -x
  node["scale"] = {2, 3, 1};
  expect_corners(load(document), 0, {{{1, 2, 3}, {1, 4, 3}, {-2, 2, 3}}});
}

TEST(LoadGltf, RotationsAgreeWithGlmAndNeedNotBeUnitLength) {
  GltfDocument document;
  document.triangle();
  const glm::dquat q = glm::normalize(glm::dquat(0.3, -0.4, 0.7, 0.2));  // w, x, y, z
  document.root["nodes"][0]["rotation"] = {2 * q.x, 2 * q.y, 2 * q.z, 2 * q.w};
  expect_corners(load(document), 0,
                 {{{0, 0, 0}, q * glm::dvec3(1, 0, 0), q * glm::dvec3(0, 1, 0)}});
}

TEST(LoadGltf, MatricesAreColumnMajorAndParentsComeFirst) {
  GltfDocument document;
  document.triangle();
  // x to y, y to z, z to x, then moved by (10, 20, 30).
  document.append("nodes", {{"children", {0}},
                            {"matrix", {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 10, 20, 30, 1}}});
  document.root["nodes"][0]["translation"] = {5, 0, 0};
  expect_corners(load(document), 0, {{{10, 25, 30}, {10, 26, 30}, {10, 25, 31}}});
}

TEST(LoadGltf, MirroringKeepsTheFrontWhereTheNormalPoints) {
  const std::vector<glm::dvec3> scales{
      {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {-1, -1, -1}, {-2, -3, 1}};
  for (const glm::dvec3 scale : scales) {
    GltfDocument document;
    document.triangle()["attributes"]["NORMAL"] =
        document.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    document.root["nodes"][0]["scale"] = {scale.x, scale.y, scale.z};
    const Scene scene = load(document);
    const glm::vec3 expected(0.0f, 0.0f, scale.z > 0.0 ? 1.0f : -1.0f);
    expect_near(geometric_normal(scene.triangles[0]), expected, 1e-6, "front side");
    expect_near(scene.triangles[0].corners[1].normal, expected, 1e-6, "normal");
  }
}

TEST(LoadGltf, MirroredCornersKeepTheirOwnAttributes) {
  GltfDocument document;
  document.triangle()["attributes"]["TEXCOORD_0"] =
      document.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  document.root["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = load(document);
  for (std::size_t i = 0; i < 3; ++i) {  // here texture coordinates are (-x, y) of the world
    const glm::dvec3 world = world_corners(scene, 0)[i];
    const glm::vec2 uv = scene.triangles[0].corners[i].texcoord;
    expect_near({uv.x, uv.y, 0.0}, {-world.x, world.y, 0.0}, 1e-6, "texcoord");
  }
}

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
  EXPECT_EQ(corners[0].color, glm::vec3(0.0f, 0.2f, 1.0f));
  EXPECT_EQ(corners[1].color, glm::vec3(1.0f, 0.0f, 0.0f));
  EXPECT_EQ(corners[1].texcoord, glm::vec2(1.0f, 0.2f));
  EXPECT_EQ(corners[0].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(corners[1].normal, glm::vec3(-1, 0, 0));
  EXPECT_EQ(corners[2].normal, glm::vec3(0, -1, 0));
}

TEST(LoadGltf, VertexColoursOfEveryType) {
  GltfDocument document;
  document.triangle()["attributes"]["COLOR_0"] =
      document.accessor<float>({0.25f, 0.5f, 1, 0, 0, 0, 0, 1, 1, 1, 1, 1}, "VEC4");
  document.triangle()["attributes"]["COLOR_0"] =
      document.accessor<std::uint16_t>({65535, 0, 13107, 9, 0, 0, 0, 9, 0, 0, 0, 9}, "VEC4", true);
  document.triangle()["attributes"]["COLOR_0"] =
      document.accessor<float>({-1, 2, 0.5f, 0, 0, 0, 0, 0, 0}, "VEC3");
  Log log(Verbosity::quiet);
  const Scene scene = load(document, log);
  EXPECT_EQ(scene.triangles[0].corners[0].color, glm::vec3(0.25f, 0.5f, 1.0f));
  EXPECT_EQ(scene.triangles[1].corners[0].color, glm::vec3(1.0f, 0.0f, 0.2f));
  EXPECT_EQ(scene.triangles[2].corners[0].color, glm::vec3(0.0f, 1.0f, 0.5f));
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

// The same geometry at another scale and place. Factors that are powers of two change the frame
// alone; others may choose another power of two and are compared in world space, relative to the
// extent. One rounding of world coordinates near 1e6 is 1e-10, which is little beside the float's
// 6e-8.
TEST(LoadGltf, ScaleAndOffsetChangeNothingButTheFrame) {
  const auto scaled_and_moved = [](double scale, double offset) {
    GltfDocument document;
    document.mesh({{"POSITION", document.accessor<float>(
                                    {0.1f, 0.2f, 0.3f, 1.7f, 0, 0.9f, 0.3f, 1.1f, 0}, "VEC3")}});
    document.root["nodes"][0]["scale"] = {scale, scale, scale};
    document.root["nodes"][0]["translation"] = {offset, -offset, 2.0 * offset};
    return load(document);
  };
  const Scene plain = scaled_and_moved(1.0, 0.0);
  for (const double scale : {1.0, 1e-3, 1e4, 1024.0}) {
    for (const double offset : {0.0, 1e6 * scale}) {
      const Scene scene = scaled_and_moved(scale, offset);
      const double ratio = scene.frame.scale * scale / plain.frame.scale;
      if (scale == 1.0 || scale == 1024.0) {
        EXPECT_EQ(ratio, 1.0);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        expect_near(glm::dvec3(scene.triangles[0].corners[i].position) / ratio,
                    plain.triangles[0].corners[i].position, 1e-6, "corner");
        expect_near(scene.triangles[0].corners[i].normal, plain.triangles[0].corners[i].normal,
                    1e-6, "normal");
      }
    }
  }
}

TEST(LoadGltf, ChoosesTheDefaultScene) {
  GltfDocument document;
  for (int i = 0; i < 3; ++i) {
    document.triangle();
    document.root["nodes"].back()["translation"] = {0, 0, i};
  }
  const auto depth = [&] { return world_corners(load(document), 0)[0].z; };
  EXPECT_EQ(load(document).triangles.size(), 3u);  // no scene: all root nodes
  document.root["scenes"] = {{{"nodes", {1}}}, {{"nodes", {2}}}};
  EXPECT_EQ(load(document).triangles.size(), 1u);
  EXPECT_EQ(depth(), 1.0);
  document.root["scene"] = 1;
  EXPECT_EQ(depth(), 2.0);
}

TEST(LoadGltf, InstancesShareAMesh) {
  GltfDocument document;
  document.triangle();
  document.append("nodes", {{"mesh", 0}, {"translation", {0, 0, 4}}});
  const Scene scene = load(document);
  ASSERT_EQ(scene.triangles.size(), 2u);
  expect_corners(scene, 1, {{{0, 0, 4}, {1, 0, 4}, {0, 1, 4}}});
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(LoadGltf, DeepHierarchiesDoNotRecurse) {
  GltfDocument document;
  document.triangle();
  constexpr int kDepth = 100000;
  document.root["nodes"] = json::array();
  for (int i = 0; i < kDepth; ++i) document.root["nodes"].push_back({{"children", {i + 1}}});
  document.root["nodes"].push_back({{"mesh", 0}});
  document.root["nodes"][0]["translation"] = {7, 0, 0};
  document.root["scenes"] = {{{"nodes", {0}}}};
  expect_corners(load(document), 0, {{{7, 0, 0}, {8, 0, 0}, {7, 1, 0}}});
}

TEST(LoadGltf, BinaryFilesAndFilesBesideAreTheSame) {
  GltfDocument document;
  document.triangle();
  const TemporaryFolder folder;
  Log log(Verbosity::quiet);
  document.write_glb(folder / "misnamed.gltf");  // told by content, not by name
  expect_corners(scene::load_gltf(folder / "misnamed.gltf", log), 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  std::filesystem::create_directory(folder / "sub dir");
  write_file(folder / "sub dir/b.bin", document.binary);
  document.root["buffers"][0]["uri"] = "sub%20dir/b.bin";
  document.write_gltf(folder / "scene.gltf");
  const Scene scene = scene::load_gltf(folder / "scene.gltf", log);
  expect_corners(scene, 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  EXPECT_EQ(scene.file, (folder / "scene.gltf").string());
  EXPECT_TRUE(log.warnings().empty());
}

// ---- Lights

json with_light(GltfDocument& document, json light) {
  document.root["extensions"]["KHR_lights_punctual"]["lights"].push_back(std::move(light));
  const std::size_t count = document.root["extensions"]["KHR_lights_punctual"]["lights"].size();
  return {{"KHR_lights_punctual", {{"light", count - 1}}}};
}

TEST(LoadGltf, PointLights) {
  GltfDocument document;
  document.triangle();  // frame: centre (0.5, 0.5, 0), scale 2
  document.append(
      "nodes",
      {{"name", "lamp"},
       {"translation", {1, 2, 3}},
       {"scale", {10, 10, 10}},
       {"extensions",
        with_light(document,
                   {{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 6}, {"range", 5}})}});
  Log log(Verbosity::quiet);
  const Scene scene = load(document, log);
  ASSERT_EQ(scene.punctual_lights.size(), 1u);
  const scene::PunctualLight& light = scene.punctual_lights[0];
  EXPECT_EQ(light.name, "lamp");
  EXPECT_EQ(light.kind, PunctualKind::point);
  EXPECT_EQ(light.position, glm::vec3(1, 3, 6));
  EXPECT_EQ(light.intensity, glm::vec3(24, 12, 0));  // times scale^2
  EXPECT_EQ(warnings_with(log, "range"), 1u);
}

TEST(LoadGltf, SpotLights) {
  GltfDocument document;
  document.triangle();
  // 90 degrees about x turns -z to y.
  document.append(
      "nodes",
      {{"rotation", {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
       {"extensions",
        with_light(document, {{"type", "spot"},
                              {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}})}});
  document.append("nodes", {{"extensions", with_light(document, {{"type", "spot"}})}});
  document.append(
      "nodes",
      {{"extensions",
        with_light(document, {{"type", "spot"},
                              {"spot", {{"innerConeAngle", 0.7}, {"outerConeAngle", 0.5}}}})}});
  Log log(Verbosity::quiet);
  const Scene scene = load(document, log);
  ASSERT_EQ(scene.punctual_lights.size(), 3u);
  EXPECT_EQ(scene.punctual_lights[0].kind, PunctualKind::spot);
  expect_near(scene.punctual_lights[0].direction, {0, 1, 0}, 1e-6, "direction");
  EXPECT_FLOAT_EQ(scene.punctual_lights[0].inner_cone_angle, 0.2f);
  EXPECT_FLOAT_EQ(scene.punctual_lights[0].outer_cone_angle, 0.6f);
  EXPECT_EQ(scene.punctual_lights[0].intensity, glm::vec3(4.0f));
  EXPECT_EQ(scene.punctual_lights[1].inner_cone_angle, 0.0f);
  EXPECT_FLOAT_EQ(scene.punctual_lights[1].outer_cone_angle, static_cast<float>(kPi / 4));
  EXPECT_LT(scene.punctual_lights[2].inner_cone_angle, scene.punctual_lights[2].outer_cone_angle);
  EXPECT_EQ(warnings_with(log, "cone"), 1u);
}

TEST(LoadGltf, DirectionalLights) {
  GltfDocument document;
  document.triangle();
  document.append(
      "nodes", {{"scale", {1, 1, -3}},
                {"extensions", with_light(document, {{"type", "directional"}, {"intensity", 6}})}});
  document.append(
      "nodes", {{"extensions", with_light(document, {{"type", "directional"}, {"intensity", 0}})}});
  const Scene scene = load(document);
  ASSERT_EQ(scene.punctual_lights.size(), 1u);  // one without intensity is none
  EXPECT_EQ(scene.punctual_lights[0].kind, PunctualKind::directional);
  EXPECT_EQ(scene.punctual_lights[0].direction, glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.punctual_lights[0].intensity, glm::vec3(6.0f));  // not times scale^2
}

// ---- Cameras

TEST(LoadGltf, PerspectiveCameras) {
  GltfDocument document;
  document.triangle();
  document.append(
      "cameras",
      {{"name", "inner"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 1}}}});
  document.append("cameras",
                  {{"type", "perspective"},
                   {"perspective", {{"yfov", 1.5}, {"znear", 1}, {"aspectRatio", 1.25}}}});
  document.append("cameras", {{"type", "orthographic"}});
  document.append("nodes", {{"camera", 0}, {"translation", {0.5, 0.5, 2}}, {"scale", {3, 3, 3}}});
  // 90 degrees about y: -z to -x, x to -z.
  document.append(
      "nodes",
      {{"name", "side"}, {"camera", 1}, {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
  document.append("nodes", {{"camera", 2}});
  Log log(Verbosity::quiet);
  const Scene scene = load(document, log);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "inner");
  EXPECT_EQ(scene.cameras[0].yfov, 0.8);
  EXPECT_FALSE(scene.cameras[0].aspect.has_value());
  expect_near(scene.cameras[0].position, {0, 0, 4}, 1e-12, "position");
  expect_near(scene.cameras[0].forward, {0, 0, -1}, 1e-12, "forward");
  expect_near(scene.cameras[0].right, {1, 0, 0}, 1e-12, "right");
  expect_near(scene.cameras[0].up, {0, 1, 0}, 1e-12, "up");
  EXPECT_EQ(scene.cameras[1].name, "side");
  EXPECT_EQ(scene.cameras[1].aspect, 1.25);
  expect_near(scene.cameras[1].forward, {-1, 0, 0}, 1e-12, "forward");
  expect_near(scene.cameras[1].right, {0, 0, -1}, 1e-12, "right");
  EXPECT_EQ(warnings_with(log, "perspective"), 1u);
}

TEST(LoadGltf, FramedCameraSeesAllTriangles) {
  GltfDocument document;
  document.mesh(
      {{"POSITION", document.accessor<float>(
                        {0, 0, 0, 10, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 3, 2, -20}, "VEC3")}});
  const Scene scene = load(document);
  const scene::Camera camera = frame_camera(scene);
  EXPECT_EQ(camera.yfov, kPi / 4);
  EXPECT_GT(camera.position.z, 1.0);
  expect_near(glm::cross(camera.right, camera.up), -camera.forward, 1e-12, "orientation");
  const double limit = std::tan(0.5 * camera.yfov);
  for (const scene::Triangle& triangle : scene.triangles) {
    for (const scene::Corner& corner : triangle.corners) {
      const glm::dvec3 to = glm::dvec3(corner.position) - camera.position;
      const double depth = glm::dot(to, camera.forward);
      EXPECT_GT(depth, 0.0);
      EXPECT_LE(std::abs(glm::dot(to, camera.up)), depth * limit);
      EXPECT_LE(std::abs(glm::dot(to, camera.right)), depth * limit);
    }
  }
}

}  // namespace
}  // namespace ppm::test
