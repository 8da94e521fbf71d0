// Skins, morph targets and copies: what the variants of one mesh do not show, against what glTF 2.0
// says they mean, worked out by hand; and broken ones.
#include <gtest/gtest.h>

#include <cmath>

#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::Scene;

/// The triangle (0,0,0), (1,0,0), (0,1,0), moved by joints 0 (which stays) and 1 (nodes[2], which
/// is to be posed): its corners by joint 0, half by each, and by joint 1.
GltfDocument with_skin(std::vector<float> weights = {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 1, 0, 0}) {
  GltfDocument document;
  json& attributes = document.triangle()["attributes"];
  attributes["NORMAL"] = document.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  attributes["JOINTS_0"] =
      document.accessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  attributes["WEIGHTS_0"] = document.accessor(weights, "VEC4");
  document.root["nodes"][0]["skin"] = 0;
  document.append("nodes", json::object());
  document.append("nodes", json::object());
  document.append("skins", {{"joints", {1, 2}}});
  return document;
}

TEST(LoadGltfPose, JointsMoveTheirShareOfAVertex) {
  GltfDocument document = with_skin();
  document.root["nodes"][2]["translation"] = {0, 0, 4};
  expect_corners(load(document), 0, {{{0, 0, 0}, {1, 0, 2}, {0, 1, 4}}});
}

TEST(LoadGltfPose, NormalsFollowTheJoints) {
  GltfDocument document = with_skin();
  document.root["nodes"][2]["rotation"] = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // y to z
  const Scene scene = load(document);
  expect_corners(scene, 0, {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}});
  const auto& corners = scene.triangles[0].corners;
  expect_near(corners[0].normal, {0, 0, 1}, 1e-6, "normal");
  expect_near(corners[1].normal, glm::normalize(glm::dvec3(0, -1, 1)), 1e-6, "normal");
  expect_near(corners[2].normal, {0, -1, 0}, 1e-6, "normal");
}

TEST(LoadGltfPose, MirroringJointsTurnTriangles) {
  GltfDocument document = with_skin();
  document.root["nodes"][1]["scale"] = document.root["nodes"][2]["scale"] = {-1, 1, 1};
  const Scene scene = load(document);
  expect_corners(scene, 0, {{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}});
  expect_near(geometric_normal(scene.triangles[0]), {0, 0, 1}, 1e-6, "front");
}

TEST(LoadGltfPose, WeightsAreScaledToAUnitSumWithAWarning) {
  GltfDocument document = with_skin({3, 0, 0, 0, 2, 2, 0, 0, 0, 0, 0, 0});  // the last: joint 0
  document.root["nodes"][2]["translation"] = {0, 0, 4};
  Log log(Verbosity::quiet);
  expect_corners(load(document, log), 0, {{{0, 0, 0}, {1, 0, 2}, {0, 1, 0}}});
  EXPECT_EQ(warnings_with(log, "sum to 1"), 1u);
}

TEST(LoadGltfPose, ASkinWhoseJointsAreElsewhereIsIgnoredWithAWarning) {
  GltfDocument document = with_skin();
  document.root["nodes"][2]["translation"] = {0, 0, 4};
  document.root["scenes"] = {{{"nodes", {0, 1}}}};
  Log log(Verbosity::quiet);
  expect_corners(load(document, log), 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  EXPECT_EQ(warnings_with(log, "skins[0].joints[1]"), 1u);
}

TEST(LoadGltfPose, MeshWeightsServeNodesWithoutTheirOwn) {
  GltfDocument document;
  json& primitive = document.triangle();
  primitive["targets"] = {
      {{"POSITION", document.accessor<float>({0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3")}},
      {{"POSITION",
        document.accessor<std::int8_t>({0, 127, 0, 0, 127, 0, 0, 127, 0}, "VEC3", true)}}};
  document.root["meshes"][0]["weights"] = {0.5, 3};
  document.append("nodes", {{"mesh", 0}, {"weights", {0, -1}}});
  const Scene scene = load(document);
  expect_corners(scene, 0, {{{0, 3, 1}, {1, 3, 1}, {0, 4, 1}}});
  expect_corners(scene, 1, {{{0, -1, 0}, {1, -1, 0}, {0, 0, 0}}});
}

TEST(LoadGltfPose, TargetsWithoutWeightsDoNothing) {
  GltfDocument document;
  json& primitive = document.triangle();
  primitive["targets"] = {
      {{"POSITION", document.accessor<float>({0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3")}}};
  expect_corners(load(document), 0, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
}

// Flat normals are those of the morphed triangle.
TEST(LoadGltfPose, MissingNormalsAreThoseOfTheMorphedShape) {
  GltfDocument document;
  json& primitive = document.triangle();
  primitive["targets"] = {
      {{"POSITION", document.accessor<float>({0, 0, 0, -1, 0, 1, 0, 0, 0}, "VEC3")}}};
  document.root["meshes"][0]["weights"] = {1};
  expect_near(load(document).triangles[0].corners[0].normal, {-1, 0, 0}, 1e-6, "normal");
}

TEST(LoadGltfPose, CopiesNeedNoMoreThanOneAttribute) {
  GltfDocument document;
  document.triangle();
  document.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"SCALE", document.accessor<float>({1, 1, 1, -2, 2, 2, 0, 0, 0}, "VEC3")}, {"_ID", 77}};
  const Scene scene = load(document);
  ASSERT_EQ(scene.triangles.size(), 2u);  // the third has no extent
  expect_corners(scene, 1, {{{0, 0, 0}, {0, 2, 0}, {-2, 0, 0}}});
}

struct Broken {
  const char* name;
  std::function<void(GltfDocument&)> spoil;
  std::vector<std::string> fragments;
};

json& copies_of(GltfDocument& document) {
  return document.root["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

std::vector<Broken> broken_files() {
  const auto attribute = [](GltfDocument& d, const char* name) -> json& {
    return d.root["meshes"][0]["primitives"][0]["attributes"][name];
  };
  return {
      {"joint",
       [=](GltfDocument& d) {
         attribute(d, "JOINTS_0") =
             d.accessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0}, "VEC4");
       },
       {"meshes[0].primitives[0].attributes", "joint 2 of vertex 2", "skin's 2"}},
      {"signed joints",
       [=](GltfDocument& d) {
         attribute(d, "JOINTS_0") =
             d.accessor<std::int8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
       },
       {"attributes.JOINTS_0", "unsigned"}},
      {"no weights",
       [](GltfDocument& d) {
         d.root["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
       },
       {"meshes[0].primitives[0].attributes", "WEIGHTS_0"}},
      {"no joints",
       [](GltfDocument& d) { d.root["skins"][0]["joints"] = json::array(); },
       {"skins[0].joints", "empty"}},
      {"absent joints",
       [](GltfDocument& d) {
         d.root["skins"][0]["joints"] = {1, 9};
       },
       {"skins[0].joints[1]", "nodes[9]"}},
      {"too few matrices",
       [](GltfDocument& d) {
         d.root["skins"][0]["inverseBindMatrices"] =
             d.append("accessors", {{"componentType", 5126}, {"type", "MAT4"}, {"count", 1}});
       },
       {"skins[0].inverseBindMatrices", "2 joints"}},
      {"vectors for matrices",
       [](GltfDocument& d) { d.root["skins"][0]["inverseBindMatrices"] = 0; },
       {"skins[0].inverseBindMatrices", "MAT4"}},
      {"target",
       [](GltfDocument& d) {
         d.root["meshes"][0]["primitives"][0]["targets"] = {
             {{"POSITION", d.accessor<float>({0, 0, 0}, "VEC3")}}};
       },
       {"meshes[0].primitives[0].targets[0].POSITION", "3 positions"}},
      {"target that is absent",
       [](GltfDocument& d) {
         d.root["meshes"][0]["primitives"][0]["targets"] = {{{"NORMAL", 99}}};
       },
       {"targets[0].NORMAL", "accessors[99]"}},
      {"copies that disagree",
       [](GltfDocument& d) {
         copies_of(d) = {{"SCALE", d.accessor<float>({1, 1, 1}, "VEC3")},
                         {"TRANSLATION", d.accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3")}};
       },
       {"nodes[1].extensions.EXT_mesh_gpu_instancing.attributes.TRANSLATION", "beside 1"}},
      {"copies of no rotation",
       [](GltfDocument& d) {
         copies_of(d) = {{"ROTATION", d.accessor<float>({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4")}};
       },
       {"attributes.ROTATION", "element 1"}},
      {"copies that are not finite",
       [](GltfDocument& d) {
         copies_of(d) = {{"TRANSLATION", d.accessor<float>({0, INFINITY, 0}, "VEC3")}};
       },
       {"EXT_mesh_gpu_instancing.attributes", "element 0"}},
      {"no copies",
       [](GltfDocument& d) {
         copies_of(d) = {{"_ID", 0}};
       },
       {"EXT_mesh_gpu_instancing.attributes", "places no copy"}},
      {"scale by pairs",
       [](GltfDocument& d) {
         copies_of(d) = {{"SCALE", d.accessor<float>({1, 1}, "VEC2")}};
       },
       {"attributes.SCALE", "VEC3"}},
      {"too many copies",  // 40 million triangles of 132 000 bytes
       [](GltfDocument& d) {
         copies_of(d) = {{"SCALE", d.accessor(std::vector<float>(3000, 1.0f), "VEC3")}};
         d.root["meshes"][1]["primitives"][0]["indices"] =
             d.accessor(std::vector<std::uint8_t>(120000), "SCALAR");
       },
       {"more than", "triangles"}},
  };
}

TEST(LoadGltfPose, BrokenOnesAreRefusedInOneLine) {
  for (const Broken& broken : broken_files()) {
    GltfDocument document = with_skin();
    document.triangle();
    std::swap(document.root["nodes"][1], document.root["nodes"].back());
    document.root["skins"][0]["joints"] = {3, 2};
    broken.spoil(document);
    const TemporaryFolder folder;
    document.write_gltf(folder / "scene.gltf");
    const std::string message = refusal(folder / "scene.gltf");
    for (const std::string& fragment : broken.fragments) {
      EXPECT_NE(message.find(fragment), std::string::npos)
          << broken.name << ": '" << message << "' lacks '" << fragment << "'";
    }
  }
}

}  // namespace
}  // namespace ppm::test
