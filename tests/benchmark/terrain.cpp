#include "terrain.hpp"

#include <cmath>
#include <cstdint>

#include "modeller.hpp"

namespace ppm::benchmark {

scene::Scene make_terrain(std::size_t triangles) {
  scene::Scene scene;
  scene.file = "terrain";
  bench::Modeller modeller(scene);
  const auto cuts =
      static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 2.0)));
  const auto height = [](double x, double z) {
    double sum = 0.0, amplitude = 0.12, frequency = 3.0;
    for (int octave = 0; octave < 7; ++octave, amplitude *= 0.45, frequency *= 2.1)
      sum += amplitude * std::sin(frequency * x + octave) * std::cos(frequency * z + 1.3 * octave);
    return sum;
  };
  modeller.sheet(cuts, cuts, modeller.diffuse("earth", glm::vec3(0.5f)), [&](double u, double v) {
    const double x = 1.98 * u - 0.99, z = 0.99 - 1.98 * v, step = 1e-5;
    const glm::dvec3 normal((height(x - step, z) - height(x + step, z)) / (2.0 * step), 1.0,
                            (height(x, z - step) - height(x, z + step)) / (2.0 * step));
    return bench::Surface{glm::vec3(x, height(x, z), z), glm::vec3(glm::normalize(normal))};
  });
  scene::Camera camera;
  camera.name = "aloft";
  camera.position = {0.0, 0.6, 0.9};
  camera.forward = glm::normalize(glm::dvec3(0.0, -0.6, -1.0));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.yfov = 1.0;
  scene.cameras.push_back(camera);
  modeller.find_bounds();
  return scene;
}

}  // namespace ppm::benchmark
