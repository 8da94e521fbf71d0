// The working frame, nodes, scenes and containers: small files built here, and what glTF 2.0 says
// they mean, worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "failure.hpp"
#include "load_gltf.hpp"
#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::Scene;

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

TEST(LoadGltf, ReadsTheSceneThatIsAskedFor) {
  GltfDocument document;
  for (int i = 0; i < 3; ++i) {
    document.triangle();
    document.root["nodes"].back()["translation"] = {0, 0, i};
  }
  document.root["scenes"] = {
      {{"nodes", {0}}, {"name", "day"}}, {{"nodes", {1}}}, {{"nodes", {2}}, {"name", "0"}}};
  document.root["scene"] = 1;
  const TemporaryFolder folder;
  document.write_gltf(folder / "scene.gltf");
  Log log(Verbosity::quiet);
  const auto depth = [&](const char* wanted) {
    return world_corners(scene::load_gltf(folder / "scene.gltf", log, {.scene = wanted}), 0)[0].z;
  };
  EXPECT_EQ(depth(""), 1.0);
  EXPECT_EQ(depth("day"), 0.0);
  EXPECT_EQ(depth("1"), 1.0);
  EXPECT_EQ(depth("0"), 2.0);  // names go before indices
  for (const char* absent : {"3", "-1", "Day", "1x"}) {
    try {
      depth(absent);
      ADD_FAILURE() << absent;
    } catch (const Failure& failure) {
      const std::string line = failure.what();
      EXPECT_NE(line.find("--scene: there is no scene '" + std::string(absent)), line.npos) << line;
      EXPECT_NE(line.find("0 \"day\", 1 \"\", 2 \"0\""), line.npos) << line;
    }
  }
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
  expect_corners(scene::load_gltf(folder / "misnamed.gltf", log), 0,
                 {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  std::filesystem::create_directory(folder / "sub dir");
  write_file(folder / "sub dir/b.bin", document.binary);
  document.root["buffers"][0]["uri"] = "sub%20dir/b.bin";
  document.write_gltf(folder / "scene.gltf");
  const Scene scene = scene::load_gltf(folder / "scene.gltf", log);
  expect_corners(scene, 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  EXPECT_EQ(scene.file, (folder / "scene.gltf").string());
  EXPECT_TRUE(log.warnings().empty());
}

}  // namespace
}  // namespace ppm::test
