// A four-wide bounding volume hierarchy with 16-bit boxes on one scene-wide grid.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene.hpp"
#include "shared/layout.h"

namespace ppm::bvh {

/// What `build` yields; uploaded as it is.
struct Bvh {
  std::vector<shared::BvhNode> nodes;         ///< nodes[0] is the root; never empty
  std::vector<std::uint32_t> triangle_order;  ///< leaf order: slot -> index of the input triangle
  /// Box plane q (0..65535) of axis a lies at grid_origin[a] + q * grid_step[a].
  glm::vec3 grid_origin{0.0f}, grid_step{1.0f};
  std::uint32_t stack_depth =
      0;  ///< entries a traversal may have to push at once, at most PPM_BVH_STACK
  double sah_cost =
      0.0;  ///< expected (nodes + triangles visited) of a random ray through the root's box
};

/// Builds over the triangles with the surface area heuristic, on `threads` threads (0: all there
/// are). The result depends on the triangles alone, never on the number of threads. Boxes are
/// conservative: they contain their triangles exactly, in spite of quantisation. Depth is bounded
/// whatever the triangles (coincident, degenerate, huge and tiny ones included). An empty span
/// gives one empty root.
Bvh build(std::span<const scene::Triangle> triangles, unsigned threads = 0);

}  // namespace ppm::bvh
