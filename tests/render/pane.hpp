// A pane of glass between parallel faces, in double precision and by other formulas than the
// renderer's.
#pragma once

#include <glm/glm.hpp>
#include <ostream>
#include <string>

#include "gltf_writer.hpp"

namespace ppm::test {

/// What one interface reflects of unpolarised light, by Fresnel's sine and tangent laws. `cosine`
/// of the side that light comes from; `ior` of the far side over the near side, at least 1.
double interface_reflectance(double cosine, double ior);
/// Cosine of the refracted direction.
double refracted_cosine(double cosine, double ior);

struct Pane {
  std::string name;
  double ior = 1.5;
  bool thin = false;            ///< a sheet without thickness
  glm::dvec3 tint{1.0};         ///< base colour: of each transmission
  glm::dvec3 attenuation{1.0};  ///< left after `distance` inside
  double distance = 1.0;
  double thickness = 0.05;

  nlohmann::json material() const;
  /// Fills [-half, half]^2 of the plane y = 0, its thickness towards +y.
  void add_to(GltfWriter& writer, double half, double height = 0.0) const;
};

inline void PrintTo(const Pane& pane, std::ostream* stream) {
  *stream << pane.name;
}

/// Shares of light that go back and through, all orders of reflection between the faces summed:
/// with R of one face, t the tint and a what is left after one crossing of length
/// thickness / cos(refracted),
///   through  t^2 (1-R)^2 a (1 + R^2 a^2 + ...) = t^2 (1-R)^2 a / (1 - R^2 a^2)
///   back     R + t^2 (1-R)^2 R a^2 / (1 - R^2 a^2)
/// and for the thin sheet, which is tinted once, t (1-R) / (1+R) and 2R / (1+R).
struct Shares {
  glm::dvec3 reflected, transmitted;
};
Shares shares(const Pane& pane, double cosine);

/// Reflected share of light that comes alike from everywhere: the integral of 2 R(c) c dc.
glm::dvec3 diffuse_reflectance(const Pane& pane);

}  // namespace ppm::test
