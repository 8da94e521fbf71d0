// A hit point's statistics at a pixel, as Figure 4 shows them.
#include <cmath>

#include "plate.hpp"

namespace ppm::test {
namespace {

class Probe : public RenderTest {};

// With one eye path a pixel a diffuse plate has one hit point a pixel, of weight 1: its L is the
// pixel's, whatever the order in which hit points lie.
TEST_F(Probe, TellsThePixelsOwnHitPoint) {
  PlateView view;
  view.eye = {0.0, 2.0, 0.0};
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.5f), writer.material(lambert(glm::dvec3(0.8, 0.4, 0.2))));
  writer.point_light({0.2, 0.7, 0.1}, glm::dvec3(1.0), 3.0);
  view.add_camera(writer);
  const scene::Scene scene = load(writer);
  const render::Settings settings = view.settings(scene, 0);
  Log log(Verbosity::quiet);
  const auto never = [] { return false; };
  const auto integrator = render::make_integrator(settings, scene, device(), log, 2);
  ASSERT_TRUE(integrator->prepare(never));
  std::vector<render::ProbeReading> before;
  for (int pass = 0; pass < 3; ++pass) {
    ASSERT_TRUE(integrator->advance(never));
    const render::Picture picture = integrator->resolve();
    std::vector<render::ProbeReading> readings;
    for (std::uint32_t y = 0; y < settings.height; y += 3) {
      for (std::uint32_t x = 0; x < settings.width; x += 3) {
        const auto reading = integrator->probe(x, y);
        ASSERT_TRUE(reading);
        const glm::dvec3 shown = pixel(picture, x, y);
        for (int channel = 0; channel < 3; ++channel) {
          EXPECT_NEAR(reading->radiance[static_cast<std::size_t>(channel)], shown[channel],
                      2e-5 * shown[channel]);
        }
        const double photons = reading->photons / settings.alpha;
        EXPECT_NEAR(photons, std::round(photons), 1e-6);  // N = alpha C
        readings.push_back(*reading);
      }
    }
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double more = readings[i].photons - before[i].photons;
      EXPECT_GE(more, 0.0);
      // Eq. 9 with M photons of which alpha are kept.
      const double n = before[i].photons, m = more / settings.alpha;
      const double expected =
          m > 0.0 ? before[i].radius * std::sqrt((n + more) / (n + m)) : before[i].radius;
      EXPECT_NEAR(readings[i].radius, expected, 1e-5 * expected);
    }
    before = readings;
  }
  EXPECT_FALSE(integrator->probe(settings.width, 0));
}

}  // namespace
}  // namespace ppm::test
