#include "grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm::bvh {
namespace {

constexpr std::int64_t kLastPlane = 65535;

// A plane counts as at or below a value only if it is so both in float, as written in bvh.hpp, and
// exactly.
double lowest_reading(double origin, double step, std::int64_t plane) {
  const float q = static_cast<float>(plane);
  const float rounded = static_cast<float>(origin) + q * static_cast<float>(step);
  return std::min(origin + static_cast<double>(plane) * step, static_cast<double>(rounded));
}

double highest_reading(double origin, double step, std::int64_t plane) {
  const float q = static_cast<float>(plane);
  const float rounded = static_cast<float>(origin) + q * static_cast<float>(step);
  return std::max(origin + static_cast<double>(plane) * step, static_cast<double>(rounded));
}

}  // namespace

Grid Grid::over(const Box& bounds) {
  double extent = 0.0, magnitude = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = bounds.lower[axis], upper = bounds.upper[axis];
    extent = std::max(extent, upper - lower);
    magnitude = std::max({magnitude, std::abs(lower), std::abs(upper)});
  }
  // Planes must differ in float where the box is, and a ray's origin in steps must stay far from
  // float's limits: hence no axis is taken for flatter than this.
  const double thinnest = std::max({extent * 0x1p-16, magnitude * 0x1p-18, 0x1p-90});
  Grid grid;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = bounds.lower[axis], upper = bounds.upper[axis];
    // Two planes to spare below, and two above, for rounding of both origin and step.
    const double step = std::max(upper - lower, thinnest) / static_cast<double>(kLastPlane - 4);
    grid.step[axis] = std::nextafter(static_cast<float>(step), std::numeric_limits<float>::max());
    grid.origin[axis] = static_cast<float>(lower - 2.0 * step);
  }
  return grid;
}

std::uint32_t Grid::plane_below(float value, int axis) const {
  const double start = origin[axis], width = step[axis];
  auto plane = static_cast<std::int64_t>(std::floor((static_cast<double>(value) - start) / width));
  while (plane > 0 && highest_reading(start, width, plane) > static_cast<double>(value)) --plane;
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(plane, 0, kLastPlane));
}

std::uint32_t Grid::plane_above(float value, int axis) const {
  const double start = origin[axis], width = step[axis];
  auto plane = static_cast<std::int64_t>(std::ceil((static_cast<double>(value) - start) / width));
  while (plane < kLastPlane && lowest_reading(start, width, plane) < static_cast<double>(value))
    ++plane;
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(plane, 0, kLastPlane));
}

}  // namespace ppm::bvh
