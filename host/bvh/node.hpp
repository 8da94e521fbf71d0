// Writing wide nodes.
#pragma once

#include <cstdint>
#include <span>

#include "grid.hpp"
#include "shared/layout.h"

namespace ppm::bvh {

/// A node without children.
shared::BvhNode empty_node();

/// Writes the box of child `slot`, 0 to 3; it may only grow, to planes of the grid.
void set_child_box(shared::BvhNode& node, int slot, const Box& box, const Grid& grid);

/// Triangles in slots [first, first + count), count in [1, PPM_BVH_MAX_LEAF], first < 2^29.
std::uint32_t leaf_reference(std::uint32_t first, std::uint32_t count);

/// Entries in use at once when every child of every node on the way is hit and pushed before one is
/// popped. Children come behind their parents; there is at least one node.
std::uint32_t stack_depth_of(std::span<const shared::BvhNode> nodes);

}  // namespace ppm::bvh
