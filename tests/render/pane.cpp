#include "pane.hpp"

#include <cmath>

namespace ppm::test {

double refracted_cosine(double cosine, double ior) {
  return std::sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
}

double interface_reflectance(double cosine, double ior) {
  if (cosine > 1.0 - 1e-12) return std::pow((ior - 1.0) / (ior + 1.0), 2.0);
  const double outside = std::acos(cosine), inside = std::acos(refracted_cosine(cosine, ior));
  const double s = std::sin(outside - inside) / std::sin(outside + inside);
  const double p = std::tan(outside - inside) / std::tan(outside + inside);
  return 0.5 * (s * s + p * p);
}

nlohmann::json Pane::material() const {
  nlohmann::json result = thin ? thin_glass(ior) : glass(ior, attenuation, distance);
  result["pbrMetallicRoughness"]["baseColorFactor"] = {tint.x, tint.y, tint.z, 1.0};
  return result;
}

void Pane::add_to(GltfWriter& writer, double half, double height) const {
  const auto h = static_cast<float>(half), y = static_cast<float>(height);
  const std::size_t index = writer.material(material());
  if (thin) {
    writer.mesh(quad({-h, y, -h}, {0.0f, 0.0f, 2.0f * h}, {2.0f * h, 0.0f, 0.0f}), index);
  } else {
    writer.mesh(box({-h, y, -h}, {h, static_cast<float>(height + thickness), h}), index);
  }
}

Shares shares(const Pane& pane, double cosine) {
  const glm::dvec3 r(interface_reflectance(cosine, pane.ior)), one(1.0);
  if (pane.thin) return {2.0 * r / (one + r), pane.tint * (one - r) / (one + r)};
  const double length = pane.thickness / refracted_cosine(cosine, pane.ior);
  const glm::dvec3 a = glm::pow(pane.attenuation, glm::dvec3(length / pane.distance));
  const glm::dvec3 through =
      pane.tint * pane.tint * (one - r) * (one - r) * a / (one - r * r * a * a);
  return {r + through * r * a, through};
}

glm::dvec3 diffuse_reflectance(const Pane& pane) {
  constexpr int kSteps = 4000;  // midpoints; the integrand is smooth but for its slope at c = 0
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    sum += 2.0 * cosine / kSteps * shares(pane, cosine).reflected;
  }
  return sum;
}

}  // namespace ppm::test
