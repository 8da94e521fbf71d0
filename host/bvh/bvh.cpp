#include "bvh.hpp"

#include <algorithm>
#include <string>
#include <thread>

#include "binary_tree.hpp"
#include "failure.hpp"
#include "grid.hpp"
#include "node.hpp"
#include "parallel.hpp"

namespace ppm::bvh {
namespace {

using shared::BvhNode;

constexpr std::uint32_t kTaskSize = 16384;  // primitives below which one thread emits a subtree

// In double, where squares of floats cannot overflow.
double half_area(const Box& box) {
  const glm::dvec3 size = glm::dvec3(box.upper[0], box.upper[1], box.upper[2]) -
                          glm::dvec3(box.lower[0], box.lower[1], box.lower[2]);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

// Entries of stack that a subtree can be held to: opened two binary levels at a time, every wide
// level leaves at most three siblings behind, and the last one may have four children on the stack
// at once.
int least_stack(int height) {
  return height == 0 ? 0 : 3 * ((height + 1) / 2) + 1;
}
static_assert(3 * ((kMaxHeight + 1) / 2) + 1 <= PPM_BVH_STACK);

// Up to four children of a wide node.
struct Family {
  std::array<Child, 4> members;
  int size = 0;

  void add(Child child) { members[static_cast<std::size_t>(size++)] = child; }
};

// Figures of the nodes emitted so far.
struct Tally {
  double node_area = 0.0,
         triangle_area = 0.0;  // sums of half areas, of triangles' leaves per triangle
};

// A subtree to be emitted on its own.
struct Subtree {
  Child child;
  int stack_left;        // entries it may use
  std::uint32_t parent;  // where its root's index belongs
  int slot;
  std::vector<BvhNode> nodes{};  // references within count from its own first node
  Tally tally{};
};

class Collapse {
 public:
  Collapse(const BinaryTree& tree, const Grid& grid, unsigned threads)
      : tree_(tree), grid_(grid), threads_(threads) {}

  void run(Bvh& bvh) {
    top_.push_back(empty_node());
    Tally tally;
    if (tree_.root.is_primitive()) {
      link(tree_.root, 0, 0, top_, tally);
    } else {
      fill_node(0, tree_.root, PPM_BVH_STACK, top_, tally, kTaskSize);
    }
    parallel_for(threads_, subtrees_.size(), [&](std::size_t i) {
      Subtree& subtree = subtrees_[i];
      subtree.nodes.push_back(empty_node());
      fill_node(0, subtree.child, subtree.stack_left, subtree.nodes, subtree.tally, 0);
    });
    join(bvh, tally);
  }

 private:
  const BinaryNode& node_of(Child child) const { return tree_.nodes[child.index()]; }
  Box box_of(Child child) const {
    if (!child.is_primitive()) return node_of(child).box;
    const Primitive& primitive = tree_.primitives[child.index()];
    return {primitive.lower, primitive.upper};
  }
  bool is_leaf(Child child) const { return child.is_primitive() || node_of(child).is_leaf; }
  int height(Child child) const { return is_leaf(child) ? 0 : node_of(child).height; }

  void open(Child child, int roots, Family& family) const;
  Family cheapest_family(const BinaryNode& node) const;
  Family shallow_family(const BinaryNode& node) const;
  void link(Child child, std::uint32_t parent, int slot, std::vector<BvhNode>& nodes, Tally& tally);
  void fill_node(std::uint32_t index, Child child, int stack_left, std::vector<BvhNode>& nodes,
                 Tally& tally, std::uint32_t task_size);
  void join(Bvh& bvh, Tally tally);

  const BinaryTree& tree_;
  const Grid& grid_;
  unsigned threads_;
  std::vector<BvhNode> top_;
  std::vector<Subtree> subtrees_;
};

// The children that stand for `child` when up to `roots` are free, as the dynamic programme
// decided.
void Collapse::open(Child child, int roots, Family& family) const {
  if (child.is_primitive() || roots == 1) return family.add(child);
  const BinaryNode& node = node_of(child);
  if (roots == 3 && node.left_of_three != 0) {
    open(node.left, node.left_of_three, family);
    open(node.right, 3 - node.left_of_three, family);
  } else if (node.is_two) {
    open(node.left, 1, family);
    open(node.right, 1, family);
  } else {
    family.add(child);
  }
}

Family Collapse::cheapest_family(const BinaryNode& node) const {
  Family family;
  open(node.left, node.left_of_four, family);
  open(node.right, 4 - node.left_of_four, family);
  return family;
}

Family Collapse::shallow_family(const BinaryNode& node) const {
  Family family;
  for (const Child child : {node.left, node.right}) {
    if (is_leaf(child)) {
      family.add(child);
    } else {
      family.add(node_of(child).left);
      family.add(node_of(child).right);
    }
  }
  return family;
}

// Writes a child's box, and its reference where it is a leaf.
void Collapse::link(Child child, std::uint32_t parent, int slot, std::vector<BvhNode>& nodes,
                    Tally& tally) {
  const Box box = box_of(child);
  set_child_box(nodes[parent], slot, box, grid_);
  if (!is_leaf(child)) return;
  const std::uint32_t first = child.is_primitive() ? child.index() : node_of(child).begin;
  const std::uint32_t count = child.is_primitive() ? 1 : node_of(child).count();
  nodes[parent].children[slot] = leaf_reference(first, count);
  tally.triangle_area += half_area(box) * count;
}

// Depth first. `stack_left` entries may be in use below `child`; subtrees of fewer than `task_size`
// primitives are put off.
void Collapse::fill_node(std::uint32_t index, Child child, int stack_left,
                         std::vector<BvhNode>& nodes, Tally& tally, std::uint32_t task_size) {
  const BinaryNode& node = node_of(child);
  tally.node_area += half_area(node.box);
  Family family = cheapest_family(node);
  const auto members = [&] {
    return std::span(family.members).first(static_cast<std::size_t>(family.size));
  };
  const bool fits = std::ranges::all_of(members(), [&](Child member) {
    return family.size - 1 + std::max(1, least_stack(height(member))) <= stack_left;
  });
  if (!fits) family = shallow_family(node);
  const int stack_below = stack_left - (family.size - 1);
  for (int slot = 0; slot < family.size; ++slot) {
    const Child member = family.members[static_cast<std::size_t>(slot)];
    link(member, index, slot, nodes, tally);
    if (is_leaf(member)) continue;
    if (node_of(member).count() < task_size) {
      subtrees_.push_back({member, stack_below, index, slot});
      continue;
    }
    const auto next = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(empty_node());
    nodes[index].children[slot] = next;
    fill_node(next, member, stack_below, nodes, tally, task_size);
  }
}

// Puts the subtrees behind the top of the tree, in their order.
void Collapse::join(Bvh& bvh, Tally tally) {
  std::vector<std::uint32_t> first(subtrees_.size());
  auto next = static_cast<std::uint32_t>(top_.size());
  for (std::size_t i = 0; i < subtrees_.size(); ++i) {
    first[i] = next;
    next += static_cast<std::uint32_t>(subtrees_[i].nodes.size());
    top_[subtrees_[i].parent].children[subtrees_[i].slot] = first[i];
    tally.node_area += subtrees_[i].tally.node_area;
    tally.triangle_area += subtrees_[i].tally.triangle_area;
  }
  bvh.nodes = std::move(top_);
  bvh.nodes.resize(next);
  parallel_for(threads_, subtrees_.size(), [&](std::size_t i) {
    std::uint32_t target = first[i];
    for (BvhNode node : subtrees_[i].nodes) {
      for (int slot = 0; slot < 4; ++slot)
        if ((node.children[slot] & PPM_BVH_LEAF) == 0) node.children[slot] += first[i];
      bvh.nodes[target++] = node;
    }
    subtrees_[i].nodes = {};
  });
  const double root_area = half_area(tree_.bounds);
  bvh.sah_cost = root_area > 0.0 ? (tally.node_area + tally.triangle_area) / root_area : 0.0;
}

}  // namespace

Bvh build(std::span<const scene::Triangle> triangles, unsigned threads) {
  if (triangles.size() >= Primitive::kIndexLimit) {
    throw Failure("", "", std::to_string(triangles.size()) + " triangles are too many",
                  "at most " + std::to_string(Primitive::kIndexLimit - 1) + " can be rendered");
  }
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  Bvh bvh;
  if (triangles.empty()) {
    bvh.nodes.push_back(empty_node());
    return bvh;
  }
  const BinaryTree tree = build_binary_tree(triangles, threads);
  const Grid grid = Grid::over(tree.bounds);
  bvh.grid_origin = grid.origin;
  bvh.grid_step = grid.step;
  Collapse(tree, grid, threads).run(bvh);
  bvh.stack_depth = stack_depth_of(bvh.nodes);
  bvh.triangle_order.reserve(triangles.size());
  for (const Primitive& primitive : tree.primitives)
    bvh.triangle_order.push_back(primitive.index());
  return bvh;
}

}  // namespace ppm::bvh
