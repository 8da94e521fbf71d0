#include "node.hpp"

#include <algorithm>
#include <vector>

namespace ppm::bvh {
namespace {

using shared::BvhNode;

void set_half(std::uint32_t& word, int shift, std::uint32_t plane) {
  word = (word & ~(0xffffu << shift)) | plane << shift;
}

}  // namespace

BvhNode empty_node() {
  const glm::uvec4 inverted(~0u, ~0u, 0u, 0u);  // lower planes 65535, upper 0
  return {inverted, inverted, inverted, glm::uvec4(PPM_BVH_EMPTY)};
}

void set_child_box(BvhNode& node, int slot, const Box& box, const Grid& grid) {
  const int pair = slot / 2, shift = 16 * (slot % 2);
  for (int axis = 0; axis < 3; ++axis) {
    glm::uvec4& planes = axis == 0 ? node.box_x : axis == 1 ? node.box_y : node.box_z;
    set_half(planes[pair], shift, grid.plane_below(box.lower[axis], axis));
    set_half(planes[2 + pair], shift, grid.plane_above(box.upper[axis], axis));
  }
}

std::uint32_t leaf_reference(std::uint32_t first, std::uint32_t count) {
  return PPM_BVH_LEAF | (count - 1) << 29 | first;
}

std::uint32_t stack_depth_of(std::span<const BvhNode> nodes) {
  std::vector<std::uint8_t> depth(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    std::uint32_t count = 0, deepest = 0;
    for (int slot = 0; slot < 4; ++slot) {
      const std::uint32_t child = nodes[i].children[slot];
      if (child == PPM_BVH_EMPTY) continue;
      ++count;
      deepest = std::max<std::uint32_t>(deepest, (child & PPM_BVH_LEAF) != 0 ? 1u : depth[child]);
    }
    depth[i] = static_cast<std::uint8_t>(count == 0 ? 0 : count - 1 + deepest);
  }
  return depth[0];
}

}  // namespace ppm::bvh
