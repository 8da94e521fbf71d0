// Light that paths from the lights bring to the lens: where it falls on the film.
#include "render_harness.hpp"

namespace ppm::test {
namespace {

using Lens = RenderTest;

// The lens puts light into the pixels through which the camera sees where it comes from: next to
// the edges of a white quarter, on which pixels end, it stays dark.
TEST_F(Lens, AndCameraSeeTheSameEdges) {
  GltfWriter writer;
  writer.mesh(quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), writer.material(lambert(glm::dvec3(0.8))));
  writer.point_light({0.3, 0.5, 0.3}, glm::dvec3(1.0), 1.0);
  writer.camera("above", {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}, 0.6, 1.0, {0.0, 0.0, -1.0});
  const scene::Scene scene = load(writer);
  for (const char* method : {"bdpt", "lt"}) {
    render::Settings settings = small_settings(scene, 16, 16);
    settings.integrator = method;
    const render::Picture picture = render_scene(device(), scene, settings, 16).picture;
    const double white = window_mean(picture, {8, 8, 16, 16}).x;
    EXPECT_GT(white, 0.1) << method;
    EXPECT_GT(window_mean(picture, {8, 8, 9, 16}).x, 0.2 * white) << method;
    EXPECT_GT(window_mean(picture, {8, 8, 16, 9}).x, 0.2 * white) << method;
    EXPECT_LT(window_mean(picture, {0, 0, 8, 16}).x, 1e-4 * white) << method;
    EXPECT_LT(window_mean(picture, {0, 0, 16, 8}).x, 1e-4 * white) << method;
  }
}

}  // namespace
}  // namespace ppm::test
