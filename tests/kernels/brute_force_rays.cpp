#include "brute_force_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/layout.h"

namespace ppm::tests {
namespace {

constexpr double kRoundoff = 1.0 / 16777216.0;

// One ray and one triangle, exactly (double's own error is 2^-29 of float's).
struct Crossing {
  bool sure = false;      // float arithmetic must find it
  bool possible = false;  // float arithmetic may find it
  double t = 0.0, t_error = 0.0;
  glm::dvec2 barycentric{0.0};
  double barycentric_error = 0.0;
};

Crossing cross_triangle(const ProbeRay& ray, const Corners& corners) {
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 d(ray.direction);
  const glm::dvec3 a = glm::dvec3(corners.corner[0]) - origin;
  const glm::dvec3 b = glm::dvec3(corners.corner[1]) - origin;
  const glm::dvec3 c = glm::dvec3(corners.corner[2]) - origin;
  // Signed volumes of the ray's direction and each edge, doubled as the kernel's are.
  const double u = 2.0 * glm::dot(d, glm::cross(a, c));
  const double v = 2.0 * glm::dot(d, glm::cross(b, a));
  const double w = 2.0 * glm::dot(d, glm::cross(c, b));
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = std::abs(glm::dot(normal, d));
  const auto [nearest, furthest] = std::minmax({glm::dot(a, d), glm::dot(b, d), glm::dot(c, d)});
  const double distance = std::max({glm::length(a), glm::length(b), glm::length(c)});
  const double edge = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  const double band = 64.0 * kRoundoff * distance * edge;
  const double sign = u + v + w >= 0.0 ? 1.0 : -1.0;
  const double lowest = std::min({sign * u, sign * v, sign * w});

  Crossing result;
  // Corners that coincide stay together through rounding, and products commute: no area at all.
  result.possible = edge > 0.0 && lowest >= -2.0 * band;
  if (!result.possible) return result;
  const double extent = furthest - nearest;
  result.t = facing > 0.0 ? glm::dot(normal, a) / glm::dot(normal, d) : nearest;
  result.t = std::clamp(result.t, nearest, furthest);
  result.t_error = 8.0 * kRoundoff * distance +
                   (facing > 0.0 ? std::min(extent, 1.5 * band * extent / facing) : extent);
  const double volume = std::abs(u + v + w);
  result.barycentric = volume > 0.0 ? glm::dvec2(u, v) / (u + v + w) : glm::dvec2(0.0);
  result.barycentric_error = volume > 0.0 ? 4.0 * band / volume : 1.0;
  result.possible = result.t > -result.t_error;
  result.sure = lowest > band && result.t > result.t_error;
  return result;
}

class Judge {
 public:
  Judge(std::span<const Corners> triangles, bool refuse_odd)
      : triangles_(triangles), refuse_odd_(refuse_odd) {}

  void compare(const ProbeRay& ray, const ProbeHit& hit) {
    agreement_.rays += 1;
    agreement_.hits += hit.triangle != PPM_NO_TRIANGLE ? 1 : 0;
    agreement_.any += hit.any;
    double nearest = std::numeric_limits<double>::infinity();  // upper bound that float must keep
    bool any_sure = false, any_possible = false;
    double sure_t = std::numeric_limits<double>::infinity();
    double rival_t = std::numeric_limits<double>::infinity();
    for (std::uint32_t slot = 0; slot < triangles_.size(); ++slot) {
      if (slot == ray.skip || (refuse_odd_ && slot % 2 == 1)) continue;
      const Crossing crossing = cross_triangle(ray, triangles_[slot]);
      if (!crossing.possible) continue;
      any_possible |= crossing.t < ray.t_max + crossing.t_error;
      if (crossing.sure) {
        nearest = std::min(nearest, crossing.t + crossing.t_error);
        any_sure |= crossing.t + crossing.t_error < ray.t_max;
        sure_t = std::min(sure_t, crossing.t + crossing.t_error);
      } else {
        rival_t = std::min(rival_t, crossing.t - crossing.t_error);
      }
    }
    agreement_.sure += sure_t < rival_t ? 1 : 0;
    check_closest(ray, hit, nearest);
    if (any_sure && hit.any == 0) fault(ray, "any-hit found nothing");
    if (!any_possible && hit.any != 0) fault(ray, "any-hit found what is not there");
  }

  const Agreement& agreement() const { return agreement_; }

 private:
  void check_closest(const ProbeRay& ray, const ProbeHit& hit, double nearest) {
    if (hit.triangle == PPM_NO_TRIANGLE) {
      if (std::isfinite(nearest)) fault(ray, "missed a hit at " + std::to_string(nearest));
      return;
    }
    if (hit.triangle >= triangles_.size() || hit.triangle == ray.skip ||
        (refuse_odd_ && hit.triangle % 2 == 1)) {
      fault(ray, "hit triangle " + std::to_string(hit.triangle) + ", which does not count");
      return;
    }
    const Crossing crossing = cross_triangle(ray, triangles_[hit.triangle]);
    if (!crossing.possible) return fault(ray, "hit a triangle that the ray does not meet");
    if (std::abs(hit.t - crossing.t) > crossing.t_error) return fault(ray, "wrong distance");
    const glm::dvec2 weights(hit.barycentric);
    const glm::dvec2 off = glm::abs(weights - crossing.barycentric);
    if (std::max(off.x, off.y) > crossing.barycentric_error) fault(ray, "wrong barycentric");
    const Corners& corners = triangles_[hit.triangle];
    const glm::dvec3 c0(corners.corner[0]), c1(corners.corner[1]), c2(corners.corner[2]);
    const glm::dvec3 on_triangle = c0 + (c1 - c0) * weights.x + (c2 - c0) * weights.y;
    const glm::dvec3 on_ray = glm::dvec3(ray.origin) + glm::dvec3(ray.direction) * double(hit.t);
    const double span = glm::length(c1 - c0) + glm::length(c2 - c0);
    if (glm::length(on_triangle - on_ray) > crossing.t_error + crossing.barycentric_error * span)
      fault(ray, "barycentric names another point than t");
    if (hit.t > nearest) fault(ray, "another hit at " + std::to_string(nearest) + " is nearer");
  }

  void fault(const ProbeRay& ray, const std::string& what) {
    if (agreement_.faults++ > 0) return;
    const auto text = [](glm::vec3 v) {
      return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) +
             ")";
    };
    agreement_.first_fault = "ray " + std::to_string(agreement_.rays - 1) + " from " +
                             text(ray.origin) + " along " + text(ray.direction) + ": " + what;
  }

  std::span<const Corners> triangles_;
  bool refuse_odd_;
  Agreement agreement_;
};

}  // namespace

Agreement compare_with_brute_force(std::span<const ProbeRay> rays, std::span<const ProbeHit> hits,
                                   std::span<const Corners> triangles, bool refuse_odd) {
  Judge judge(triangles, refuse_odd);
  for (std::size_t i = 0; i < rays.size(); ++i) judge.compare(rays[i], hits[i]);
  return judge.agreement();
}

}  // namespace ppm::tests
