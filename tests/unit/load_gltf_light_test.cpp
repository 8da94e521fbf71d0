// KHR_lights_punctual and cameras, with the working frame worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "failure.hpp"
#include "gltf_document.hpp"
#include "load_gltf.hpp"

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
