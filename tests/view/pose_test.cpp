// Moves of the viewer's camera, held to a projection that is written here, and to what the command
// line makes of the options that it prints.
#include "pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "camera_choice.hpp"

namespace ppm::view {
namespace {

constexpr double kPi = std::numbers::pi;

/// Where a world point is seen, in picture heights from the middle, right and down.
glm::dvec2 seen_at(const Pose& pose, const glm::dvec3& point) {
  const glm::dvec3 z = glm::normalize(pose.target - pose.position);
  const glm::dvec3 x = glm::normalize(glm::cross(z, pose.up)), y = glm::cross(x, z);
  const glm::dvec3 way = point - pose.position;
  const double height = pose.half_height
                            ? 2.0 * *pose.half_height
                            : 2.0 * glm::dot(way, z) * std::tan(pose.fov * kPi / 360.0);
  return {glm::dot(way, x) / height, -glm::dot(way, y) / height};
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << "," << a.y << "," << a.z << " and " << b.x << "," << b.y << "," << b.z;
}

std::vector<Pose> poses() {
  return {{{1.0, 2.0, 5.0}, {0.5, 1.0, -1.0}, {0.0, 1.0, 0.0}, 40.0, {}},
          {{-300.0, 10.0, 20.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 90.0, {}},
          {{0.0, 3e-3, 0.0}, {0.0, 0.0, 1e-3}, {0.0, 0.0, -1.0}, 20.0, {}},
          {{4.0, 3.0, 2.0}, {1.0, 1.0, 1.0}, {0.6, 0.8, 0.0}, 50.0, 1.5}};
}

TEST(ViewPose, OrbitsAtOneDistanceAndBack) {
  for (const Pose& pose : poses()) {
    const double distance = pose.distance();
    for (const glm::dvec2 by : {glm::dvec2(0.4, 0.0), {0.0, 0.2}, {-2.5, -0.3}}) {
      const Pose turned = orbited(pose, by.x, by.y);
      EXPECT_EQ(turned.target, pose.target);
      EXPECT_NEAR(turned.distance(), distance, 1e-12 * distance);
      expect_near(orbited(turned, -by.x, -by.y).position, pose.position, 1e-11 * distance);
    }
    const Pose around = orbited(pose, 2.0 * kPi, 0.0);
    expect_near(around.position, pose.position, 1e-11 * distance);
    // A quarter turn about the axis: the levelled offset is where it was forward.
    const Pose quarter = orbited(pose, 0.5 * kPi, 0.0);
    EXPECT_NEAR(glm::dot(quarter.right(), pose.right()), 0.0, 1e-12);
  }
}

// What is nearer than the target moves the way that the hand does.
TEST(ViewPose, OrbitTurnsTheSceneWithTheHand) {
  for (const Pose& pose : poses()) {
    const glm::dvec3 nearer = pose.target - 0.2 * (pose.target - pose.position);
    EXPECT_GT(seen_at(orbited(pose, 0.1, 0.0), nearer).x, 1e-3);
    EXPECT_LT(seen_at(orbited(pose, -0.1, 0.0), nearer).x, -1e-3);
    EXPECT_GT(seen_at(orbited(pose, 0.0, 0.1), nearer).y, 1e-3);
    EXPECT_LT(seen_at(orbited(pose, 0.0, -0.1), nearer).y, -1e-3);
  }
}

TEST(ViewPose, OrbitStopsShortOfTheAxis) {
  for (const Pose& pose : poses()) {
    for (const double down : {10.0, -10.0}) {
      const Pose steep = orbited(pose, 0.3, down);
      EXPECT_GT(glm::length(glm::cross(steep.forward(), steep.up)), 0.03);
      EXPECT_NEAR(steep.distance(), pose.distance(), 1e-12 * pose.distance());
      EXPECT_GT(glm::dot(steep.forward(), steep.up) * -down, 0.0);
    }
  }
}

TEST(ViewPose, PanKeepsPointsAtTheTargetsDistanceUnderTheHand) {
  for (const Pose& pose : poses()) {
    const glm::dvec3 up = glm::cross(pose.right(), pose.forward());
    for (const glm::dvec2 at : {glm::dvec2(0.0, 0.0), {0.3, -0.2}}) {
      const glm::dvec3 point = pose.target + pose.distance() * (at.x * pose.right() + at.y * up);
      const glm::dvec2 before = seen_at(pose, point);
      const glm::dvec2 by(0.125, 0.25);
      const glm::dvec2 after = seen_at(panned(pose, by), point);
      EXPECT_NEAR(after.x - before.x, by.x, 1e-12);
      EXPECT_NEAR(after.y - before.y, by.y, 1e-12);
    }
  }
}

TEST(ViewPose, DollyKeepsTheLine) {
  for (const Pose& pose : poses()) {
    const double distance = pose.distance();
    const Pose closer = dollied(pose, 0.5, 0.1 * distance);
    EXPECT_NEAR(closer.distance(), 0.5 * distance, 1e-12 * distance);
    expect_near(closer.forward(), pose.forward(), 1e-12);
    EXPECT_NEAR(dollied(pose, 0.01, 0.1 * distance).distance(), 0.1 * distance, 1e-12 * distance);
    expect_near(dollied(closer, 2.0, 0.0).position, pose.position, 1e-12 * distance);
  }
}

TEST(ViewPose, FlightTakesTheTargetAlong) {
  for (const Pose& pose : poses()) {
    const double distance = pose.distance();
    const Pose flown_on = flown(pose, {0.0, 0.0, 0.5});
    expect_near(flown_on.position, 0.5 * (pose.position + pose.target), 1e-12 * distance);
    for (const glm::dvec3 by : {glm::dvec3(0.1, 0.0, 0.0), {0.0, 0.2, 0.0}, {0.0, 0.0, -0.3}}) {
      const Pose moved = flown(pose, by);
      expect_near(moved.target - moved.position, pose.target - pose.position, 1e-12 * distance);
      EXPECT_NEAR(glm::length(moved.position - pose.position), glm::length(by) * distance,
                  1e-12 * distance);
    }
    EXPECT_LT(seen_at(flown(pose, {0.1, 0.0, 0.0}), pose.target).x, 0.0);
    EXPECT_GT(seen_at(flown(pose, {0.0, 0.1, 0.0}), pose.target).y, 0.0);
  }
}

TEST(ViewPose, WideningScalesWhatIsSeen) {
  const Pose pose = poses()[0];
  const glm::dvec3 aside = pose.target + 0.1 * pose.right();
  EXPECT_NEAR(seen_at(widened(pose, 2.0), aside).x, 0.5 * seen_at(pose, aside).x, 1e-12);
  EXPECT_LT(widened(pose, 1e9).fov, 180.0);
  EXPECT_GT(widened(pose, 1e-9).fov, 0.0);
  const Pose orthographic = poses().back();
  EXPECT_TRUE(widened(orthographic, 2.0) == orthographic);
}

/// A square of edge 2 across Z in the working frame, which is moved and scaled.
scene::Scene square() {
  scene::Scene scene;
  scene.frame = {{10.0, -20.0, 30.0}, 0.25};
  scene.triangles.resize(2);
  const glm::vec3 corners[4] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    scene.triangles[0].corners[i].position = corners[i];
    scene.triangles[1].corners[i].position = corners[(i + 2) % 4];
  }
  scene.bounds_min = {-1.0f, -1.0f, -3.0f};
  scene.bounds_max = {1.0f, 1.0f, 1.0f};
  scene.cameras.resize(1);
  scene.cameras[0].position = {0.25, 0.25, 2.0};
  return scene;
}

TEST(ViewPose, LooksAtWhatTheCameraLooksAt) {
  scene::Scene scene = square();
  scene::Camera camera = scene.cameras[0];
  Pose pose = pose_of(camera, scene, std::nullopt);
  expect_near(pose.position, {11.0, -19.0, 38.0}, 1e-12);  // origin + working / scale
  expect_near(pose.target, {11.0, -19.0, 30.0}, 1e-12);
  EXPECT_EQ(pose.up, glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_DOUBLE_EQ(pose.fov, 45.0);
  camera.position.x = 0.95;  // some of what is in the middle is past the square
  expect_near(pose_of(camera, scene, std::nullopt).target, {13.8, -19.0, 30.0}, 1e-12);
  camera.position.x = 0.25;
  camera.ymag = 0.5;
  pose = pose_of(camera, scene, std::nullopt);
  expect_near(pose.target, {11.0, -19.0, 30.0}, 1e-12);
  EXPECT_EQ(pose.half_height, 2.0);
  scene.triangles.clear();  // past everything: as far as the middle of the bounds
  expect_near(pose_of(camera, scene, std::nullopt).target, {11.0, -19.0, 26.0}, 1e-12);
  expect_near(pose_of(camera, scene, glm::dvec3(11.0, -19.0, 0.0)).target, {11.0, -19.0, 0.0},
              1e-12);
  std::swap(camera.up, camera.right);  // on its side
  EXPECT_EQ(pose_of(camera, scene, std::nullopt).up, camera.up);
}

TEST(ViewPose, PrintsWhatItIsToTheBit) {
  const Pose pose{{0.1, -2.0, 1e3}, {1.0 / 3.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 39.5978, {}};
  EXPECT_EQ(camera_options(rounded(pose, 4)),
            "--camera-position 0.1,-2,1000 --camera-target 0.3333,0,0 --camera-fov 39.5978");
  Pose other = rounded(pose, 4);
  other.up = {0.0, 0.6, 0.8};
  other.half_height = 1.0;
  EXPECT_EQ(camera_options(other),
            "--camera-position 0.1,-2,1000 --camera-target 0.3333,0,0 --camera-up 0,0.6,0.8");
  EXPECT_EQ(digits_for(1.0), 5);
  EXPECT_EQ(digits_for(250.0), 3);
  EXPECT_EQ(digits_for(2e-3), 8);
  EXPECT_EQ(digits_for(1e9), 0);
}

// What is rounded is seen as before, to a tenth of a pixel of a large picture.
TEST(ViewPose, RoundingIsNotSeen) {
  for (const Pose& pose : poses()) {
    const Pose coarse = rounded(pose, digits_for(pose.distance()));
    const glm::dvec3 point = pose.target + 0.3 * pose.distance() * pose.right();
    const glm::dvec2 moved = seen_at(coarse, point) - seen_at(pose, point);
    EXPECT_LT(glm::length(moved), 5e-5);
  }
}

// A camera that the command line makes of a pose is that pose again.
TEST(ViewPose, RoundTripsThroughTheCommandLine) {
  const scene::Scene scene = square();
  for (const Pose& pose : poses()) {
    cli::RenderOptions options;
    options.camera_position = pose.position;
    options.camera_target = pose.target;
    options.camera_up = pose.up;
    options.camera_fov = pose.fov;
    Log log(Verbosity::quiet);
    const scene::Camera camera = cli::choose_camera(options, scene, log);
    const Pose back = pose_of(camera, scene, pose.target);
    expect_near(back.position, pose.position, 1e-9);
    expect_near(back.forward(), pose.forward(), 1e-9 / pose.distance());
    expect_near(back.right(), pose.right(), 1e-9 / pose.distance());
    EXPECT_NEAR(back.fov, pose.fov, 1e-9);
  }
}

}  // namespace
}  // namespace ppm::view
