#include "facets.hpp"

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>

namespace ppm::test {
namespace {

constexpr double kPi = std::numbers::pi;

double lambda(double alpha, double cosine) {
  const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

/// Sums meet(facet's normal) over the facets that light of this cosine meets, in proportion to how
/// much of it each meets, unmasked: <o, h> D / cos_o. Midpoints.
void over_facets(double alpha, double cos_o, const std::function<void(glm::dvec3, double)>& meet) {
  constexpr int kTilts = 1500, kTurns = 180;
  const glm::dvec3 wo(std::sqrt(1.0 - cos_o * cos_o), 0.0, cos_o);
  for (int i = 0; i < kTilts; ++i) {
    // tan = alpha s / (1 - s) spreads steps over the distribution's peak and its tail alike.
    const double s = (i + 0.5) / kTilts, tangent = alpha * s / (1.0 - s);
    const double cos_h = 1.0 / std::sqrt(1.0 + tangent * tangent), sin_h = tangent * cos_h;
    const double step = alpha / ((1.0 - s) * (1.0 - s)) / kTilts * cos_h * cos_h;  // d theta
    const double d =
        alpha * alpha /
        (kPi * std::pow(cos_h, 4.0) * std::pow(alpha * alpha + tangent * tangent, 2.0));
    for (int j = 0; j < kTurns; ++j) {
      const double turn = (j + 0.5) * kPi / kTurns;  // the other half is its mirror image
      const glm::dvec3 h(sin_h * std::cos(turn), sin_h * std::sin(turn), cos_h);
      const double oh = glm::dot(wo, h);
      if (oh > 0.0) meet(h, oh * d / cos_o * sin_h * step * 2.0 * kPi / kTurns);
    }
  }
}

}  // namespace

FacetShares facet_shares(double alpha, double eta, double cosine, bool thin) {
  const glm::dvec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  const auto leaves = [&](double cos_i) {
    return 1.0 / (1.0 + lambda(alpha, cosine) + lambda(alpha, cos_i));
  };
  FacetShares shares;
  over_facets(alpha, cosine, [&](glm::dvec3 h, double met) {
    const double oh = glm::dot(wo, h);
    const double cos2 = 1.0 - (1.0 - oh * oh) / (eta * eta);
    double f = 1.0, bent = 0.0;  // cosine of the refracted direction to the surface
    if (cos2 > 0.0) {
      const double ct = std::sqrt(cos2);
      const double p = (eta * oh - ct) / (eta * oh + ct), s = (oh - eta * ct) / (oh + eta * ct);
      f = 0.5 * (p * p + s * s);
      bent = wo.z / eta - h.z * (oh / eta - ct);
    }
    const double mirrored = 2.0 * oh * h.z - cosine;
    if (thin) {
      f = 2.0 * f / (1.0 + f);
      bent = mirrored;
    }
    if (mirrored > 0.0) shares.reflected += met * f * leaves(mirrored);
    if (bent > 0.0) shares.transmitted += met * (1.0 - f) * leaves(bent);
  });
  return shares;
}

double coat_share(double alpha, double f0, double f90, double cosine) {
  const glm::dvec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  double sum = 0.0;
  over_facets(alpha, cosine, [&](glm::dvec3 h, double met) {
    const double oh = glm::dot(wo, h), mirrored = 2.0 * oh * h.z - cosine;
    if (mirrored <= 0.0) return;
    const double g = 1.0 / (1.0 + lambda(alpha, cosine) + lambda(alpha, mirrored));
    sum += met * g * (f0 + (f90 - f0) * std::pow(1.0 - oh, 5.0));
  });
  return sum;
}

}  // namespace ppm::test
