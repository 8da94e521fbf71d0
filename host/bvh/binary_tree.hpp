// The binary tree from which the four-wide one is collapsed: surface area heuristic, one triangle a
// leaf.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lanes.hpp"
#include "scene.hpp"

namespace ppm::bvh {

/// Edges between the root and the deepest triangle at most. Opened two levels at a time such a tree
/// needs 3 * ceil(42 / 2) + 1 = 64 entries of stack.
inline constexpr int kMaxHeight = 42;

/// A child: a node of the binary tree, or one primitive.
struct Child {
  static constexpr std::uint32_t kPrimitive = 0x80000000u;
  std::uint32_t bits = kPrimitive;

  bool is_primitive() const { return (bits & kPrimitive) != 0; }
  std::uint32_t index() const { return bits & ~kPrimitive; }
};

/// An inner node over primitives [begin, end). Its own index in BinaryTree::nodes is where its
/// right child's primitives begin, which no two nodes share: no numbering is needed, whichever
/// thread comes first.
///
/// `forest_cost[k - 1]` is the least cost of the primitives when they may be given to k children of
/// a wide node, each of them a leaf or an inner node; the flags say how it is reached.
struct BinaryNode {
  Box box;
  std::uint32_t begin, end;
  Child left, right;
  std::array<float, 3> forest_cost;
  std::uint8_t height;  ///< edges to the deepest primitive
  std::uint8_t
      left_of_four;  ///< as an inner node: how many of its four children the left child supplies
  std::uint8_t left_of_three;  ///< as three children: idem; 0 if two or fewer are as good
  bool is_leaf;                ///< as one child: a leaf rather than an inner node
  bool is_two;                 ///< as two children: left and right rather than one

  std::uint32_t count() const { return end - begin; }
};

struct BinaryTree {
  std::vector<Primitive> primitives;  ///< in leaf order
  std::vector<BinaryNode> nodes;      ///< as many as primitives; [0] is unused
  Child root;                         ///< only where there are primitives
  Box bounds;
};

/// What a visit to an inner node costs, and a leaf for every two of its triangles, of which the
/// kernels intersect two at a time; the unit is free. On lavapipe 2:1 and 2:1.3 are equally good,
/// 2:0.7 and 2:1.7 slower for some rays by 2 to 5 %.
inline constexpr float kNodeCost = 2.0f;
inline constexpr float kPairCost = 1.2f;

/// Builds over all triangles. The result does not depend on `threads`.
BinaryTree build_binary_tree(std::span<const scene::Triangle> triangles, unsigned threads);

}  // namespace ppm::bvh
