// Cameras, and views that no picture can show.
#include <gtest/gtest.h>

#include <numbers>

#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::Scene;

/// A triangle, whose frame doubles lengths, and this camera.
GltfDocument with_camera(const char* type, json members) {
  GltfDocument document;
  document.triangle();
  document.append("cameras", {{"name", "c"}, {"type", type}, {type, std::move(members)}});
  document.append("nodes", {{"camera", 0}, {"translation", {0.5, 0.5, 3}}, {"scale", {4, 5, 6}}});
  return document;
}

TEST(LoadGltfCamera, OrthographicOnesKeepTheirHeight) {
  const Scene scene = load(
      with_camera("orthographic", {{"xmag", 6.0}, {"ymag", 1.5}, {"znear", 0.0}, {"zfar", 100.0}}));
  ASSERT_EQ(scene.frame.scale, 2.0);
  const scene::Camera& camera = scene.cameras.at(0);
  ASSERT_TRUE(camera.ymag);
  EXPECT_EQ(*camera.ymag, 3.0);  // the node's scale does not count
  EXPECT_EQ(camera.aspect, 4.0);
  EXPECT_EQ(camera.position, glm::dvec3(0.0, 0.0, 6.0));
  EXPECT_EQ(camera.forward, glm::dvec3(0.0, 0.0, -1.0));
}

TEST(LoadGltfCamera, NegativeMagnificationsAreTakenAsPositiveWithAWarning) {
  Log log(Verbosity::quiet);
  const Scene scene = load(
      with_camera("orthographic", {{"xmag", -1}, {"ymag", 2}, {"znear", 0}, {"zfar", 1}}), log);
  EXPECT_EQ(scene.cameras.at(0).aspect, 0.5);
  EXPECT_EQ(warnings_with(log, "magnifications"), 1u);
}

TEST(LoadGltfCamera, PerspectiveOnesAreNotOrthographic) {
  const Scene scene = load(with_camera("perspective", {{"yfov", 1.0}, {"znear", 0.1}}));
  EXPECT_FALSE(scene.cameras.at(0).ymag);
  EXPECT_EQ(scene.cameras.at(0).yfov, 1.0);
}

TEST(LoadGltfCamera, AbsurdViewsAreRefused) {
  struct Absurd {
    const char* type;
    json members;
    const char* fragment;
  };
  const std::vector<Absurd> table{
      {"perspective", {{"yfov", 0}, {"znear", 1}}, "cameras[0].perspective.yfov"},
      {"perspective", {{"yfov", -1}, {"znear", 1}}, "cameras[0].perspective.yfov"},
      {"perspective", {{"yfov", std::numbers::pi}, {"znear", 1}}, "cameras[0].perspective.yfov"},
      {"perspective", {{"yfov", nullptr}, {"znear", 1}}, "cameras[0]"},
      {"perspective", {{"yfov", 1}, {"znear", 2}, {"zfar", 1}}, "cameras[0].perspective.zfar"},
      {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 1}}, "cameras[0].perspective.zfar"},
      {"perspective",
       {{"yfov", 1}, {"znear", 1}, {"aspectRatio", -1}},
       "cameras[0].perspective.aspectRatio"},
      {"orthographic",
       {{"xmag", 0}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}},
       "cameras[0].orthographic.xmag"},
      {"orthographic",
       {{"xmag", 1}, {"ymag", 0}, {"znear", 0}, {"zfar", 1}},
       "cameras[0].orthographic.ymag"},
      {"orthographic",
       {{"xmag", 1}, {"ymag", 1e300}, {"znear", 0}, {"zfar", 1}},
       "cameras[0].orthographic.ymag"},
      {"orthographic",
       {{"xmag", 1e6}, {"ymag", 1e-6}, {"znear", 0}, {"zfar", 1}},
       "cameras[0].orthographic.xmag"},
      {"orthographic",
       {{"xmag", 1}, {"ymag", 1}, {"znear", 2}, {"zfar", 1}},
       "cameras[0].orthographic.zfar"},
      {"fisheye", json::object(), "cameras[0]"},
  };
  for (const Absurd& absurd : table) {
    const TemporaryFolder folder;
    with_camera(absurd.type, absurd.members).write_gltf(folder / "scene.gltf");
    const std::string message = refusal(folder / "scene.gltf");
    EXPECT_NE(message.find(absurd.fragment), std::string::npos)
        << absurd.members << ": '" << message << "'";
  }
}

}  // namespace
}  // namespace ppm::test
