#include "ahead.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ppm::view {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kAside = 0.05;  // of the picture's height

struct Ray {
  glm::dvec3 origin, direction;
  double nearest = kNone;
};

/// As Moeller and Trumbore: Fast, Minimum Storage Ray/Triangle Intersection, JGT 1997.
double distance_to(const scene::Triangle& triangle, const Ray& ray) {
  const glm::dvec3 corner(triangle.corners[0].position);
  const glm::dvec3 u = glm::dvec3(triangle.corners[1].position) - corner;
  const glm::dvec3 v = glm::dvec3(triangle.corners[2].position) - corner;
  const glm::dvec3 p = glm::cross(ray.direction, v);
  const double determinant = glm::dot(u, p);
  if (determinant == 0.0) return kNone;
  const glm::dvec3 s = ray.origin - corner;
  const double a = glm::dot(s, p) / determinant;
  if (!(a >= 0.0 && a <= 1.0)) return kNone;
  const glm::dvec3 q = glm::cross(s, u);
  const double b = glm::dot(ray.direction, q) / determinant;
  if (!(b >= 0.0 && a + b <= 1.0)) return kNone;
  const double distance = glm::dot(v, q) / determinant;
  return distance > 0.0 ? distance : kNone;
}

Ray ray_aside(const scene::Camera& camera, double right, double up) {
  const double height = camera.ymag ? 2.0 * *camera.ymag : 2.0 * std::tan(0.5 * camera.yfov);
  const glm::dvec3 shift = height * (right * camera.right + up * camera.up);
  if (camera.ymag) return {camera.position + shift, camera.forward};
  return {camera.position, camera.forward + shift};  // its parameter is the depth
}

}  // namespace

std::optional<double> distance_ahead(const scene::Scene& scene, const scene::Camera& camera) {
  std::array<Ray, 5> rays{ray_aside(camera, 0.0, 0.0), ray_aside(camera, kAside, 0.0),
                          ray_aside(camera, -kAside, 0.0), ray_aside(camera, 0.0, kAside),
                          ray_aside(camera, 0.0, -kAside)};
  for (const scene::Triangle& triangle : scene.triangles) {
    for (Ray& ray : rays) ray.nearest = std::min(ray.nearest, distance_to(triangle, ray));
  }
  std::ranges::sort(rays, {}, &Ray::nearest);
  const double median = rays[rays.size() / 2].nearest;
  return median < kNone ? std::optional(median) : std::nullopt;
}

}  // namespace ppm::view
