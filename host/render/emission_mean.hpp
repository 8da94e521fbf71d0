// What triangle lights have of their material's emission: emissive textures and coverage.
#pragma once

#include <cstdint>

#include "scene.hpp"

namespace ppm::render {

/// Whether the emission differs from point to point: a texture (of its coat, too),
/// or an alphaMode.
bool has_textured_emission(const scene::Material& material);

/// Means over triangles. How finely they are sampled depends on how many triangles there are, so
/// that the work for all stays below a second or so.
class EmissionMean {
 public:
  explicit EmissionMean(const scene::Scene& scene);

  /// The mean of texture times coverage over a triangle, by channel: by a rule of midpoints. Zero
  /// only where the triangle meets no texel that is not black; where none of the midpoints has any
  /// light but some texel may, next to nothing. 1 for emission without textures.
  glm::vec3 of(std::uint32_t triangle) const;

 private:
  const scene::Scene& scene_;
  int most_parts_ = 0;  ///< of a triangle's edge
};

}  // namespace ppm::render
