// Rays against every triangle in double precision, with the error that the kernels' float
// arithmetic may make.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace ppm::tests {

/// As traverse_probe.comp reads and writes them.
struct ProbeRay {
  glm::vec3 origin;
  float t_max;
  glm::vec3 direction;
  std::uint32_t skip;
};
struct ProbeHit {
  float t;
  std::uint32_t triangle;
  glm::vec2 barycentric;
  std::uint32_t any;
};

struct Corners {
  glm::vec3 corner[3];
};

/// How often the comparison had something to say.
struct Agreement {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;    ///< closest hits that the device found
  std::uint64_t sure = 0;    ///< rays whose nearest hit is beyond doubt in float
  std::uint64_t any = 0;     ///< any-hit queries that found something
  std::uint64_t faults = 0;  ///< disagreements beyond the error band
  std::string first_fault;
};

/// Checks the device's answers for `rays` among `triangles` (in slot order; with `refuse_odd` the
/// odd slots are air).
///
/// Error band. Let e = 2^-24, D the largest distance from the ray's origin to a corner, E the
/// longest edge; d is the ray's direction, a, b, c the corners as seen from its origin. The kernel
/// projects the corners along the ray; each of the two coordinates errs by at most 4 e D
/// (difference, slope, product, sum), which moves an edge's signed volume u = 2 d.(a x c) by at
/// most 2 (2 * 4 sqrt(2) e D) (sqrt(3) E) = 40 e D E where the ray is inside the triangle; its own
/// two products and their difference add 2 * 3 e * 3 E^2, E being at most 2 D. So 64 e D E bounds
/// the error of all but triangles that wrap around the ray's origin. A ray all of whose exact
/// volumes exceed that, with one sign, must be hit; a hit may be reported where none is below minus
/// twice that. t is a mean of the corners' own distances, in error by 8 e D, with weights u / (u +
/// v + w): their three errors move it by at most 3 * 64 e D E / |u + v + w| of the triangle's
/// extent along the ray, and by that extent at most.
Agreement compare_with_brute_force(std::span<const ProbeRay> rays, std::span<const ProbeHit> hits,
                                   std::span<const Corners> triangles, bool refuse_odd);

}  // namespace ppm::tests
