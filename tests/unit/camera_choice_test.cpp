// Which camera the options choose, how it is turned, and how many pixels it gets.
#include "camera_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "failure.hpp"

namespace ppm::cli {
namespace {

using Sides = std::pair<std::uint32_t, std::uint32_t>;

/// One triangle and two cameras, in a frame that moves and scales.
scene::Scene two_cameras() {
  scene::Scene scene;
  scene.file = "s.glb";
  scene.frame = {{10.0, 20.0, 30.0}, 0.25};
  scene.triangles.resize(1);
  scene.bounds_min = glm::vec3(-1.0f);
  scene.bounds_max = glm::vec3(1.0f);
  scene.cameras.resize(2);
  scene.cameras[0].name = "west";
  scene.cameras[1].name = "east";
  scene.cameras[1].position = {0.0, 0.0, 2.0};
  scene.cameras[1].yfov = 1.0;
  scene.cameras[1].aspect = 2.0;
  return scene;
}

scene::Camera choose(const RenderOptions& options, const scene::Scene& scene = two_cameras()) {
  Log log(Verbosity::quiet);
  const scene::Camera camera = choose_camera(options, scene, log);
  EXPECT_NEAR(glm::length(camera.forward), 1.0, 1e-12);
  EXPECT_NEAR(glm::length(camera.up), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0.0, 1e-12);
  EXPECT_LT(glm::length(glm::cross(camera.forward, camera.up) - camera.right), 1e-12);
  return camera;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-12) << a.x << "," << a.y << "," << a.z;
}

TEST(CameraChoice, ByNameByIndexOrTheFirst) {
  RenderOptions options;
  EXPECT_EQ(choose(options).name, "west");
  options.camera = "east";
  EXPECT_EQ(choose(options).name, "east");
  options.camera = "0";
  EXPECT_EQ(choose(options).name, "west");
  for (const char* absent : {"2", "-1", "North", "east ", "0x1"}) {
    options.camera = absent;
    try {
      choose(options);
      ADD_FAILURE() << absent;
    } catch (const Failure& failure) {
      const std::string line = failure.what();
      EXPECT_NE(line.find(absent), std::string::npos) << line;
      EXPECT_NE(line.find("1 \"east\""), std::string::npos) << line;
    }
  }
}

TEST(CameraChoice, NamesGoBeforeIndices) {
  scene::Scene scene = two_cameras();
  scene.cameras[1].name = "0";
  RenderOptions options;
  options.camera = "0";
  EXPECT_EQ(choose(options, scene).yfov, 1.0);
}

// What turns and moves a camera leaves its kind alone; an angle asks for a pinhole.
TEST(CameraChoice, OrthographicCamerasStayUntilAnAngleIsAskedFor) {
  scene::Scene scene = two_cameras();
  scene.cameras[0].ymag = 0.5;
  RenderOptions options;
  options.camera_position = {10.0, 20.0, 34.0};
  options.camera_target = {14.0, 20.0, 34.0};
  EXPECT_EQ(choose(options, scene).ymag, 0.5);
  options.camera_fov = 60.0;
  EXPECT_FALSE(choose(options, scene).ymag);
}

TEST(CameraChoice, PositionAndTargetAreInWorldUnits) {
  RenderOptions options;
  options.camera_position = {10.0, 20.0, 34.0};  // one unit along z in the working frame
  options.camera_target = {14.0, 20.0, 34.0};
  const scene::Camera camera = choose(options);
  expect_near(camera.position, {0.0, 0.0, 1.0});
  expect_near(camera.forward, {1.0, 0.0, 0.0});
  expect_near(camera.up, {0.0, 1.0, 0.0});
  expect_near(camera.right, {0.0, 0.0, 1.0});
}

TEST(CameraChoice, PositionAloneKeepsTheDirection) {
  scene::Scene scene = two_cameras();
  scene.cameras[0].forward = {1.0, 0.0, 0.0};
  scene.cameras[0].right = {0.0, 0.0, 1.0};
  RenderOptions options;
  options.camera_position = {0.0, 0.0, 0.0};
  const scene::Camera camera = choose(options, scene);
  expect_near(camera.position, {-2.5, -5.0, -7.5});
  expect_near(camera.forward, {1.0, 0.0, 0.0});
}

TEST(CameraChoice, UpIsKeptAsFarAsTheDirectionLets) {
  RenderOptions options;
  options.camera_up = glm::dvec3(3.0, 3.0, 5.0);  // forward is -z
  const scene::Camera camera = choose(options);
  expect_near(camera.up, glm::normalize(glm::dvec3(1.0, 1.0, 0.0)));
  expect_near(camera.forward, {0.0, 0.0, -1.0});
}

TEST(CameraChoice, StraightDownNeedsNoUp) {
  RenderOptions options;
  options.camera_position = {10.0, 24.0, 30.0};
  options.camera_target = {10.0, 20.0, 30.0};
  const scene::Camera camera = choose(options);
  expect_near(camera.forward, {0.0, -1.0, 0.0});
  expect_near(camera.up, {0.0, 0.0, -1.0});
  options.camera_up = {0.0, 1.0, 0.0};
  EXPECT_THROW(choose(options), Failure);
}

TEST(CameraChoice, UpMayHaveAnyLength) {
  for (const double length : {1e-320, 1e-200, 1e200, 1e308}) {
    RenderOptions options;
    options.camera_up = glm::dvec3(length, 0.0, 0.0);
    expect_near(choose(options).up, {1.0, 0.0, 0.0});
  }
}

TEST(CameraChoice, PointsThatSinglePrecisionCannotReachAreRefused) {
  for (const double far : {1e20, 1e160, 1e308}) {
    RenderOptions position, target;
    position.camera_position = glm::dvec3(0.0, far, 0.0);
    EXPECT_THROW(choose(position), Failure) << far;
    target.camera_target = glm::dvec3(0.0, -far, far);
    EXPECT_THROW(choose(target), Failure) << far;
  }
}

TEST(CameraChoice, TargetAtTheCameraIsRefused) {
  RenderOptions options;
  options.camera_target = {10.0, 20.0, 30.0};  // where the first camera stands
  EXPECT_THROW(choose(options), Failure);
}

TEST(CameraChoice, FieldOfViewIsInDegrees) {
  RenderOptions options;
  options.camera_fov = 90.0;
  EXPECT_NEAR(choose(options).yfov, std::numbers::pi / 2.0, 1e-15);
}

TEST(CameraChoice, WithoutCameraTheSceneIsFramedWithAWarning) {
  scene::Scene scene = two_cameras();
  scene.cameras.clear();
  Log log(Verbosity::quiet);
  const scene::Camera camera = choose_camera({}, scene, log);
  EXPECT_EQ(log.warnings().size(), 1u);
  // Every corner of the bounds lies within the field of view, at the default aspect and at any
  // wider one.
  const double tangent = std::tan(camera.yfov / 2.0);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 way =
        glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1) - camera.position;
    const double depth = glm::dot(way, camera.forward);
    EXPECT_GT(depth, 0.0);
    EXPECT_LE(std::abs(glm::dot(way, camera.up)), tangent * depth);
    EXPECT_LE(std::abs(glm::dot(way, camera.right)), 4.0 / 3.0 * tangent * depth);
  }
  RenderOptions options;
  options.camera = "0";
  EXPECT_THROW(choose_camera(options, scene, log), Failure);
}

TEST(CameraChoice, OptionsThatPlaceItNeedNoWarning) {
  scene::Scene scene = two_cameras();
  scene.cameras.clear();
  RenderOptions options;
  options.camera_position = {0.0, 0.0, 0.0};
  options.camera_target = {1.0, 0.0, 0.0};
  Log log(Verbosity::quiet);
  choose_camera(options, scene, log);
  EXPECT_TRUE(log.warnings().empty());
}

TEST(Resolution, FollowsTheAspect) {
  scene::Camera camera;
  RenderOptions options;
  EXPECT_EQ(choose_resolution(options, camera, 640), Sides(640, 480));
  camera.aspect = 16.0 / 9.0;
  EXPECT_EQ(choose_resolution(options, camera, 640), Sides(640, 360));
  options.width = 100;
  EXPECT_EQ(choose_resolution(options, camera, 640), Sides(100, 56));  // 56.25
  options.width.reset();
  options.height = 90;
  EXPECT_EQ(choose_resolution(options, camera, 640), Sides(160, 90));
  options.width = 7;
  EXPECT_EQ(choose_resolution(options, camera, 640), Sides(7, 90));
}

TEST(Resolution, ExtremeAspects) {
  scene::Camera camera;
  camera.aspect = 1e9;
  EXPECT_EQ(choose_resolution({}, camera, 640), Sides(640, 1));
  RenderOptions options;
  options.height = 480;
  EXPECT_THROW(choose_resolution(options, camera, 640), Failure);
  camera.aspect = 1e-9;
  EXPECT_THROW(choose_resolution({}, camera, 640), Failure);
  options.width = 480;
  EXPECT_EQ(choose_resolution(options, camera, 640), Sides(480, 480));
}

}  // namespace
}  // namespace ppm::cli
