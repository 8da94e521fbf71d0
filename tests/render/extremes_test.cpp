// Numbers at the edge of single precision: pictures without NaN or infinity, and not black.
#include <algorithm>
#include <cmath>

#include "render_harness.hpp"

namespace ppm::test {
namespace {

class Extremes : public RenderTest {
 protected:
  /// A white floor seen straight from above, all pixels showing its centre: their size squared is
  /// below the smallest float.
  static GltfWriter floor_seen_through_a_pinhole() {
    GltfWriter writer;
    writer.mesh(quad({-1.0f, 0.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}),
                writer.material(lambert(glm::dvec3(1.0))));
    writer.camera("above", {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, 1e-24, 1.0, {0.0, 0.0, -1.0});
    return writer;
  }

  render::Picture render(const GltfWriter& writer, double radius) {
    const scene::Scene scene = load(writer);
    render::Settings settings = small_settings(scene, 4, 4);
    settings.radius_mode = render::RadiusMode::fixed;
    settings.radius = radius;
    return render_scene(device(), scene, settings, 1).picture;
  }
};

// Straight below a point light the floor has the radiance I / (pi d^2); over a disc of radius 0.2 d
// the irradiance falls by less than 6 %, and 1 % of the 20000 photons land in it: some 200, so that
// the estimate's standard error is 7 %.
TEST_F(Extremes, PixelsWithoutSizeAreLit) {
  GltfWriter writer = floor_seen_through_a_pinhole();
  writer.point_light({0.0, 0.5, 0.0}, glm::dvec3(1.0), 1.0);
  const double expected = 1.0 / (3.14159265 * 0.25);
  for (const float value : render(writer, 0.1).rgb) EXPECT_NEAR(value, expected, 0.35 * expected);
}

// The irradiance I / d^2 = 1e40 W/m^2 of a patch of radius 1e-6 is more than a float can hold.
TEST_F(Extremes, RadianceBeyondSinglePrecisionIsTheLargestFloat) {
  GltfWriter writer = floor_seen_through_a_pinhole();
  writer.spot_light({0.0, 1e-5, 0.0}, {0.0, -1.0, 0.0}, glm::dvec3(1.0), 1e30, 0.0, 0.1);
  for (const float value : render(writer, 1e-7).rgb) {
    EXPECT_TRUE(std::isfinite(value));
    EXPECT_GT(value, 3.4e38f);
  }
}

}  // namespace
}  // namespace ppm::test
