// The scene-wide grid on which boxes are stored.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "lanes.hpp"

namespace ppm::bvh {

/// 65536 planes an axis; plane q lies at origin + q * step, evaluated in float.
struct Grid {
  glm::vec3 origin{0.0f}, step{1.0f};

  /// A grid over a box that holds something. Steps are positive even where the box is flat.
  static Grid over(const Box& bounds);

  /// The last plane at or below `value`, a coordinate within the box; exact in spite of rounding.
  std::uint32_t plane_below(float value, int axis) const;
  /// The first plane at or above `value`.
  std::uint32_t plane_above(float value, int axis) const;
};

}  // namespace ppm::bvh
