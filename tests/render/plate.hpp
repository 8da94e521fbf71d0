// A diffuse plate seen from straight above, whose irradiance is known.
#pragma once

#include <functional>
#include <numbers>
#include <string>

#include "render_harness.hpp"

namespace ppm::test {

/// Irradiance by channel at a point (x, z) of a plate in a plane of constant y, W/m^2.
using Irradiance = std::function<glm::dvec3(glm::dvec2)>;

/// What a camera at `eye` sees of the plate at height `plate_height` above or below it: a square of
/// 2 * half, its pixels of equal area. Film x runs with x, film y with z (seen from above) or
/// against z (from below).
struct PlateView {
  glm::dvec3 eye;
  double plate_height = 0.0;
  double half = 0.45;
  std::uint32_t pixels = 24, block = 8;
  double radius = 0.03;  ///< of the hit points, all passes start with it
  unsigned passes = 4, seeds = 8;
  std::uint64_t photons = 50000;
  std::uint32_t samples_per_pixel = 1;
  std::string integrator = "ppm";  ///< "pm": `radius` is the largest
  std::uint32_t nearest = 100;

  void add_camera(GltfWriter& writer) const;
  render::Settings settings(const scene::Scene& scene, std::uint32_t max_depth) const;
  /// The plate's point under film position (x, y), in pixels.
  glm::dvec2 point(double film_x, double film_y) const;
};

/// A square lying in the plane y = height, from -half to half, front up (or down).
Mesh plate(float height, float half, bool front_up = true);

/// Renders over `view.seeds` seeds and compares the means of all blocks, and of the whole, with
/// albedo / pi * irradiance. Where `irradiance` is exact, what remains is noise and the bias of the
/// discs; `slack` is the relative error of `irradiance` itself.
void expect_irradiance(gpu::Device& device, const GltfWriter& writer, const PlateView& view,
                       glm::dvec3 albedo, const Irradiance& irradiance, std::uint32_t max_depth,
                       double slack);
/// The same of a scene that has been loaded already.
void expect_irradiance(gpu::Device& device, const scene::Scene& scene, const PlateView& view,
                       glm::dvec3 albedo, const Irradiance& irradiance, std::uint32_t max_depth,
                       double slack);

}  // namespace ppm::test
