// Geometry by formula: sheets, boxes, balls and rings of triangles with smooth normals.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "scene.hpp"

namespace ppm::bench {

struct Surface {
  glm::vec3 position, normal;
};

/// Adds geometry and materials to a scene, in its working frame.
class Modeller {
 public:
  explicit Modeller(scene::Scene& scene) : scene_(scene) {}

  /// Returns the index of the new material.
  std::uint32_t material(const scene::Material& material);
  /// A Lambertian one.
  std::uint32_t diffuse(const char* name, glm::vec3 color);
  /// A black one that emits `radiance` from its front side.
  std::uint32_t emitter(const char* name, glm::vec3 radiance);

  /// A sheet over [0,1]^2, counter-clockwise from its normal's side; triangles without area are
  /// left out.
  void sheet(std::uint32_t columns, std::uint32_t rows, std::uint32_t material,
             const std::function<Surface(double u, double v)>& surface);
  /// A parallelogram; its normal is cross(right, up).
  void panel(glm::vec3 corner, glm::vec3 right, glm::vec3 up, std::uint32_t cuts,
             std::uint32_t material);
  /// A box seen from outside (`side` 1) or from within (-1), turned by `angle` about its vertical
  /// axis. Materials in the order -x, +x, -y, +y, -z, +z.
  void box(glm::vec3 centre, glm::vec3 half, float angle, float side, std::uint32_t cuts,
           const std::array<std::uint32_t, 6>& materials);
  void ball(glm::vec3 centre, double radius, std::uint32_t rows, std::uint32_t material);
  /// A torus that lies flat.
  void ring(glm::vec3 centre, double radius, double thickness, std::uint32_t columns,
            std::uint32_t rows, std::uint32_t material);

  /// Sets the scene's bounds, once all is there.
  void find_bounds();

 private:
  void triangle(const Surface& a, const Surface& b, const Surface& c, std::uint32_t material);

  scene::Scene& scene_;
};

}  // namespace ppm::bench
