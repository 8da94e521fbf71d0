// Closed scenes in which radiance is the same everywhere: whatever shows is an error.
#include "render_harness.hpp"

namespace ppm::test {
namespace {

// Radiance in a closed room whose walls all emit `emission` and reflect diffusely: e + rho L = L.
glm::dvec3 furnace_radiance(glm::dvec3 emission, glm::dvec3 albedo) {
  return emission / (1.0 - albedo);
}

class Furnace : public RenderTest {};

TEST_F(Furnace, DiffuseSphere) {
  const glm::dvec3 emission(0.5, 1.0, 0.25), albedo(0.5, 0.2, 0.8);
  GltfWriter writer;
  const auto wall = writer.material(with_emission(lambert(albedo), emission));
  writer.mesh(inside_out(icosphere(3, Shading::flat)), wall);
  writer.camera("centre", {0.1, 0.0, 0.2}, {0.3, 0.2, -1.0}, 1.0);
  const scene::Scene scene = load(writer);
  const auto settings = small_settings(scene);
  const Estimate estimate = replicate(device(), scene, settings, 4, 8, whole(settings));
  EXPECT_TRUE(agrees(estimate, furnace_radiance(emission, albedo), 5.0, 0.01));
}

}  // namespace
}  // namespace ppm::test
