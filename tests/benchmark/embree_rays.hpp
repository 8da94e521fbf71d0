// The unit of the benchmark: rays that Embree traces, one at a time.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <span>
#include <vector>

#include "scene.hpp"

namespace ppm::benchmark {

struct Ray {
  glm::vec3 origin, direction;
};

/// A scene in Embree, of default quality.
class EmbreeScene {
 public:
  EmbreeScene(RTCDevice device, std::span<const scene::Triangle> triangles);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Closest hit by rtcIntersect1; `distance` is where the search ends and then where the hit is.
  /// Returns the triangle, or RTC_INVALID_GEOMETRY_ID for none.
  std::uint32_t intersect(const Ray& ray, float& distance) const;

 private:
  RTCScene scene_;
};

/// One ray a pixel, row by row.
std::vector<Ray> camera_rays(const scene::Camera& camera, std::uint32_t width,
                             std::uint32_t height);

/// Where `rays` hit: rays that leave with density cos/pi to the side they came from, in the same
/// order.
std::vector<Ray> bounce_rays(const EmbreeScene& embree, std::span<const scene::Triangle> triangles,
                             std::span<const Ray> rays);

/// Closest hits a second on so many threads.
double rays_per_second(const EmbreeScene& embree, std::span<const Ray> rays, unsigned threads);

}  // namespace ppm::benchmark
