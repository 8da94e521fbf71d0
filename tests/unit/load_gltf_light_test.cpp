// KHR_lights_punctual and cameras, with the working frame worked out by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "failure.hpp"
#include "load_gltf.hpp"
#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::PunctualKind;
using scene::Scene;

constexpr double kPi = std::numbers::pi;

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
  // In the working frame, without regard to the node's scale.
  EXPECT_EQ(light.range, 10.0f);
  EXPECT_TRUE(log.warnings().empty());
}

TEST(LoadGltf, NestedScalesChangeNeitherIntensityNorRange) {
  GltfDocument document;
  document.triangle();
  document.append("nodes", {{"scale", {3, 0.5, 2}}, {"children", {2}}});
  document.append(
      "nodes",
      {{"scale", {0.1, 7, 1}},
       {"translation", {1, 2, 3}},
       {"extensions", with_light(document, {{"type", "point"}, {"intensity", 6}, {"range", 5}})}});
  document.root["scenes"] = {{{"nodes", {0, 1}}}};
  const Scene scene = load(document);
  ASSERT_EQ(scene.punctual_lights.size(), 1u);
  EXPECT_EQ(scene.punctual_lights[0].intensity, glm::vec3(24.0f));
  EXPECT_EQ(scene.punctual_lights[0].range, 10.0f);
  const glm::dvec3 position = scene.frame.to_world(scene.punctual_lights[0].position);
  expect_near(position, {3, 1, 6}, 1e-6, "position");
}

TEST(LoadGltf, LightsWithoutRangeReachEverywhere) {
  GltfDocument document;
  document.triangle();
  for (const double range : {0.0, -1.0}) {
    json light = {{"type", "point"}};
    if (range != 0.0) light["range"] = range;
    document.append("nodes", {{"extensions", with_light(document, light)}});
  }
  Log log(Verbosity::quiet);
  const Scene scene = load(document, log);
  ASSERT_EQ(scene.punctual_lights.size(), 2u);
  for (const auto& light : scene.punctual_lights) EXPECT_TRUE(std::isinf(light.range));
  EXPECT_EQ(warnings_with(log, "range"), 1u);
}

// Candela of every kind of light; emission is radiance whatever the efficacy.
TEST(LoadGltf, LuminousEfficacyTurnsCandelaIntoWatts) {
  const TemporaryFolder folder;
  GltfDocument document;
  document.triangle();
  document.append("materials", {{"emissiveFactor", {1, 0.5, 0.25}}});
  document.root["meshes"][0]["primitives"][0]["material"] = 0;
  for (const char* type : {"point", "spot", "directional"}) {
    json light = {{"type", type}, {"intensity", 1366}};
    if (type == std::string("spot")) light["spot"] = json::object();
    document.append("nodes", {{"extensions", with_light(document, light)}});
  }
  document.write_gltf(folder / "scene.gltf");
  Log log(Verbosity::quiet);
  scene::LoadOptions options;
  options.luminous_efficacy = 683.0;
  const Scene scene = scene::load_gltf(folder / "scene.gltf", log, options);
  ASSERT_EQ(scene.punctual_lights.size(), 3u);
  EXPECT_EQ(scene.punctual_lights[0].intensity, glm::vec3(8.0f));  // times scale^2
  EXPECT_EQ(scene.punctual_lights[1].intensity, glm::vec3(8.0f));
  EXPECT_EQ(scene.punctual_lights[2].intensity, glm::vec3(2.0f));
  EXPECT_EQ(scene.materials[0].emission, glm::vec3(1.0f, 0.5f, 0.25f));
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
  document.append("nodes", {{"extensions",
                             with_light(document, {{"type", "spot"}, {"spot", json::object()}})}});
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

// ---- EXT_lights_image_based

/// A light of six faces of one colour each, the brightest channel of which is divided by `divisor`.
GltfDocument with_cube(const std::array<std::array<std::uint8_t, 4>, 6>& colors, json light) {
  GltfDocument document;
  document.triangle();
  json faces = json::array();
  for (const auto& color : colors) {
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 16; ++i) texels.insert(texels.end(), color.begin(), color.end());
    faces.push_back(document.append("images", {{"bufferView", document.view(png_of(4, 4, texels))},
                                               {"mimeType", "image/png"}}));
  }
  light["specularImages"] = json::array({faces});
  light["specularImageSize"] = 4;
  document.root["extensions"]["EXT_lights_image_based"]["lights"] = json::array({light});
  document.root["scenes"] =
      json::array({{{"nodes", {0}}, {"extensions", {{"EXT_lights_image_based", {{"light", 0}}}}}}});
  document.root["scene"] = 0;
  document.root["extensionsUsed"] = {"EXT_lights_image_based"};
  return document;
}

/// The texel in whose middle the direction lies, or the one before.
glm::vec3 texel_towards(const scene::Environment& sky, glm::dvec3 d) {
  const double column = (std::atan2(d.z, d.x) / (2.0 * kPi) + 0.5) * sky.width;
  const double row = std::acos(d.y) / kPi * sky.height;
  const auto x = static_cast<std::size_t>(column) % sky.width;
  const auto y = std::min(static_cast<std::size_t>(row), std::size_t{sky.height} - 1);
  return sky.texels[y * sky.width + x];
}

constexpr std::array<std::array<std::uint8_t, 4>, 6> kFaces{{{255, 0, 0, 255},
                                                             {0, 255, 0, 255},
                                                             {0, 0, 255, 255},
                                                             {255, 255, 0, 255},
                                                             {0, 255, 255, 51},
                                                             {255, 0, 255, 255}}};

TEST(LoadGltf, ImageBasedLightsAreEnvironments) {
  Log log(Verbosity::quiet);
  const Scene scene = load(with_cube(kFaces, {{"intensity", 2.5}}), log);
  ASSERT_TRUE(scene.environment);
  const scene::Environment& sky = *scene.environment;
  EXPECT_EQ(sky.width, 16u);
  EXPECT_EQ(sky.height, 8u);
  EXPECT_EQ(sky.strength, 2.5f);
  EXPECT_EQ(sky.rotation, 0.0);
  expect_near(texel_towards(sky, {1, 0, 0}), {1, 0, 0}, 1e-6, "+X");
  expect_near(texel_towards(sky, {-1, 0, 0}), {0, 1, 0}, 1e-6, "-X");
  expect_near(texel_towards(sky, {0, 1, 0}), {0, 0, 1}, 1e-6, "+Y");
  expect_near(texel_towards(sky, {0, -1, 0}), {1, 1, 0}, 1e-6, "-Y");
  expect_near(texel_towards(sky, {0, 0, 1}), {0, 5, 5}, 4e-3, "+Z, in RGBD");
  expect_near(texel_towards(sky, {0, 0, -1}), {1, 0, 1}, 1e-6, "-Z");
  EXPECT_TRUE(log.warnings().empty());
}

// A quarter turn about +Y takes +Z to +X.
TEST(LoadGltf, ImageBasedLightsAreRotated) {
  const double half = std::sqrt(0.5);
  const Scene scene = load(with_cube(kFaces, {{"rotation", {0, half, 0, half}}}));
  ASSERT_TRUE(scene.environment);
  expect_near(texel_towards(*scene.environment, {1, 0, 0}), {0, 5, 5}, 4e-3, "+Z became +X");
  expect_near(texel_towards(*scene.environment, {0, 0, 1}), {0, 1, 0}, 1e-6, "-X became +Z");
  expect_near(texel_towards(*scene.environment, {0, 1, 0}), {0, 0, 1}, 1e-6, "+Y stays");
}

TEST(LoadGltf, ImageBasedLightsThatAreBrokenAreRefused) {
  const TemporaryFolder folder;
  const auto line_of = [&](const std::function<void(json&)>& bend) {
    GltfDocument document = with_cube(kFaces, json::object());
    bend(document.root);
    document.write_gltf(folder / "scene.gltf");
    return refusal(folder / "scene.gltf");
  };
  const std::string base = "extensions.EXT_lights_image_based";
  EXPECT_EQ(line_of([](json&) {}), "");
  const std::vector<std::pair<std::string, std::function<void(json&)>>> cases{
      {"scenes[0]." + base + ".light",
       [](json& root) { root["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 7; }},
      {base + ".lights[0].specularImages",
       [](json& root) {
         root["extensions"]["EXT_lights_image_based"]["lights"][0].erase("specularImages");
       }},
      {base + ".lights[0].specularImages",
       [](json& root) {
         root["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"][0].erase(0);
       }},
      {base + ".lights[0].specularImages[0][2]",
       [](json& root) {
         root["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"][0][2] = 99;
       }},
      {base + ".lights[0].rotation", [](json& root) {
         root["extensions"]["EXT_lights_image_based"]["lights"][0]["rotation"] = {0, 0, 0, 0};
       }}};
  for (const auto& [place, bend] : cases) {
    EXPECT_NE(line_of(bend).find(place), std::string::npos) << line_of(bend);
  }
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

// Powers and their sums must stay within single precision: a point light's is 4 pi times this.
TEST(LoadGltf, LightsBeyondSinglePrecisionAreRefused) {
  for (const char* type : {"point", "directional"}) {
    for (const double intensity : {1e29, 1e31, 3e38, 1e300}) {
      GltfDocument document;
      document.triangle();
      document.append(
          "nodes",
          {{"extensions", with_light(document, {{"type", type}, {"intensity", intensity}})}});
      if (intensity < 1e30) {
        EXPECT_EQ(load(document).punctual_lights.size(), 1u) << type;
      } else {
        EXPECT_THROW(load(document), Failure) << type << " " << intensity;
      }
    }
  }
}

TEST(LoadGltf, PerspectiveCameras) {
  GltfDocument document;
  document.triangle();
  document.append(
      "cameras",
      {{"name", "inner"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 1}}}});
  document.append("cameras",
                  {{"type", "perspective"},
                   {"perspective", {{"yfov", 1.5}, {"znear", 1}, {"aspectRatio", 1.25}}}});
  document.append("nodes", {{"camera", 0}, {"translation", {0.5, 0.5, 2}}, {"scale", {3, 3, 3}}});
  // 90 degrees about y: -z to -x, x to -z.
  document.append(
      "nodes",
      {{"name", "side"}, {"camera", 1}, {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
  const Scene scene = load(document);
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
