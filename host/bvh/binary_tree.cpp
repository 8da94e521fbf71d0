#include "binary_tree.hpp"

#include <algorithm>
#include <bit>

#include "parallel.hpp"
#include "split.hpp"

namespace ppm::bvh {
namespace {

constexpr std::uint32_t kBlock = 16384;  // primitives a piece of work of the parallel stages
constexpr std::uint32_t kSharedNode = 4 * kBlock;  // larger nodes are split by all threads together
constexpr std::uint32_t kMaxLeaf = 4;

struct Range {
  std::uint32_t begin, end;
  std::uint32_t count() const { return end - begin; }
};

int halvings(std::uint32_t count) {
  return count <= 1 ? 0 : std::bit_width(count - 1);
}

// A child of this size, `depth` edges below the root, can still be built within kMaxHeight.
bool fits(std::uint32_t count, int depth) {
  return halvings(count) <= kMaxHeight - depth;
}

// Whether both sides get something and can still be built within kMaxHeight.
bool is_usable(const Split& split, std::uint32_t count, int depth) {
  return split.axis >= 0 && fits(split.left_count, depth + 1) &&
         fits(count - split.left_count, depth + 1);
}

class Builder {
 public:
  Builder(std::span<const scene::Triangle> triangles, unsigned threads) : threads_(threads) {
    const auto count = static_cast<std::uint32_t>(triangles.size());
    tree_.primitives.resize(count);
    tree_.nodes.resize(count);
    load(triangles);
  }

  BinaryTree build() && {
    const Range all{0, static_cast<std::uint32_t>(tree_.primitives.size())};
    if (all.count() == 0) return std::move(tree_);
    const Bounds bounds = bounds_of(all);
    tree_.bounds = bounds.box;
    build_shared({all, bounds, 0, &tree_.root});
    scratch_ = {};
    std::stable_sort(tasks_.begin(), tasks_.end(), [](const Task& a, const Task& b) {
      return a.range.count() > b.range.count();
    });
    parallel_for(threads_, tasks_.size(), [&](std::size_t i) {
      Histogram histogram;
      build_alone(tasks_[i], histogram);
    });
    for (std::size_t i = shared_nodes_.size(); i-- > 0;) finish(shared_nodes_[i]);
    return std::move(tree_);
  }

 private:
  // A part of the tree to be built, and where its parent awaits it.
  struct Task {
    Range range;
    Bounds bounds;
    int depth;
    Child* result;
  };

  struct Halves {
    std::uint32_t middle = 0;
    Bounds left, right;
  };

  static std::size_t blocks(Range range) { return (range.count() + kBlock - 1) / kBlock; }
  static Range block(Range range, std::size_t i) {
    const std::uint32_t begin = range.begin + static_cast<std::uint32_t>(i) * kBlock;
    return {begin, std::min(begin + kBlock, range.end)};
  }
  std::span<Primitive> primitives(Range range) {
    return std::span(tree_.primitives).subspan(range.begin, range.count());
  }

  void load(std::span<const scene::Triangle> triangles);
  Bounds bounds_of(Range range);
  void build_shared(const Task& task);
  void build_alone(const Task& task, Histogram& histogram);
  std::array<Task, 2> make_node(const Task& task, const Halves& halves);
  Split split_shared(const Task& task, const BinMap& map);
  Halves partition_shared(Range range, const BinMap& map, const Split& split);
  Halves partition(Range range, const BinMap& map, const Split& split);
  Halves halve_by_count(const Task& task);
  void finish(std::uint32_t index);
  float half_area(Child child) const;
  std::array<float, 3> forest_cost(Child child) const;
  int height(Child child) const;

  unsigned threads_;
  BinaryTree tree_;
  std::vector<Primitive> scratch_;           // partition_shared's other buffer
  std::vector<Task> tasks_;                  // left by build_shared
  std::vector<std::uint32_t> shared_nodes_;  // parents before children
};

void Builder::load(std::span<const scene::Triangle> triangles) {
  const Range all{0, static_cast<std::uint32_t>(triangles.size())};
  parallel_for(threads_, blocks(all), [&](std::size_t b) {
    const Range part = block(all, b);
    for (std::uint32_t i = part.begin; i < part.end; ++i) {
      const auto& c = triangles[i].corners;
      const glm::vec3 lower = glm::min(glm::min(c[0].position, c[1].position), c[2].position);
      const glm::vec3 upper = glm::max(glm::max(c[0].position, c[1].position), c[2].position);
      const float tag = Primitive::tag(i);
      tree_.primitives[i].lower = Float4{lower.x, lower.y, lower.z, tag};
      tree_.primitives[i].upper = Float4{upper.x, upper.y, upper.z, tag};
    }
  });
}

Bounds Builder::bounds_of(Range range) {
  std::vector<Bounds> parts(blocks(range));
  parallel_for(threads_, parts.size(), [&](std::size_t b) {
    for (const Primitive& primitive : primitives(block(range, b))) parts[b].grow(primitive);
  });
  Bounds whole;
  for (const Bounds& part : parts) whole.grow(part);
  return whole;
}

// Splits large nodes with all threads together and leaves the smaller ones as tasks.
void Builder::build_shared(const Task& task) {
  if (task.range.count() < kSharedNode) {
    tasks_.push_back(task);
    return;
  }
  const BinMap map(task.bounds.centroids, task.range.count());
  const Split split = split_shared(task, map);
  const Halves halves = is_usable(split, task.range.count(), task.depth)
                            ? partition_shared(task.range, map, split)
                            : halve_by_count(task);
  shared_nodes_.push_back(halves.middle);
  for (const Task& half : make_node(task, halves)) build_shared(half);
}

void Builder::build_alone(const Task& task, Histogram& histogram) {
  if (task.range.count() == 1) {
    *task.result = Child{task.range.begin | Child::kPrimitive};
    return;
  }
  const BinMap map(task.bounds.centroids, task.range.count());
  histogram.clear(map.bins());
  histogram.add(map, primitives(task.range));
  const Split split = best_split(histogram, map);
  const Halves halves = is_usable(split, task.range.count(), task.depth)
                            ? partition(task.range, map, split)
                            : halve_by_count(task);
  for (const Task& half : make_node(task, halves)) build_alone(half, histogram);
  finish(halves.middle);
}

std::array<Builder::Task, 2> Builder::make_node(const Task& task, const Halves& halves) {
  BinaryNode& node = tree_.nodes[halves.middle];
  node.box = task.bounds.box;
  node.begin = task.range.begin;
  node.end = task.range.end;
  *task.result = Child{halves.middle};
  return {Task{{node.begin, halves.middle}, halves.left, task.depth + 1, &node.left},
          Task{{halves.middle, node.end}, halves.right, task.depth + 1, &node.right}};
}

Split Builder::split_shared(const Task& task, const BinMap& map) {
  // Boxes and counts merge exactly, so that it does not matter how many parts there are.
  std::vector<Histogram> parts(std::min<std::size_t>(threads_, blocks(task.range)));
  const std::size_t all = blocks(task.range);
  parallel_for(threads_, parts.size(), [&](std::size_t p) {
    parts[p].clear(map.bins());
    for (std::size_t b = all * p / parts.size(); b < all * (p + 1) / parts.size(); ++b)
      parts[p].add(map, primitives(block(task.range, b)));
  });
  for (std::size_t p = 1; p < parts.size(); ++p) parts[0].add(parts[p], map.bins());
  return best_split(parts[0], map);
}

// By way of a second buffer: where each block's primitives go follows from the counts before it.
Builder::Halves Builder::partition_shared(Range range, const BinMap& map, const Split& split) {
  struct Part {
    Bounds left, right;
    std::uint32_t left_count = 0;
  };
  if (scratch_.empty()) scratch_.resize(tree_.primitives.size());
  std::vector<Part> parts(blocks(range));
  parallel_for(threads_, parts.size(), [&](std::size_t b) {
    Part& part = parts[b];
    const Range here = block(range, b);
    std::uint32_t left = here.begin, right = here.end;
    for (const Primitive& primitive : primitives(here)) {
      const bool goes_left = split.sends_left(map, primitive);
      (goes_left ? part.left : part.right).grow(primitive);
      scratch_[goes_left ? left++ : --right] = primitive;
    }
    part.left_count = left - here.begin;
  });
  Halves halves;
  halves.middle = range.begin + split.left_count;
  std::vector<Range> targets;
  Range target{range.begin, halves.middle};
  for (std::size_t b = 0; b < parts.size(); ++b) {
    halves.left.grow(parts[b].left);
    halves.right.grow(parts[b].right);
    targets.push_back(target);
    target.begin += parts[b].left_count;
    target.end += block(range, b).count() - parts[b].left_count;
  }
  parallel_for(threads_, parts.size(), [&](std::size_t b) {
    const Range here = block(range, b);
    const auto from = scratch_.begin() + here.begin;
    const auto to = tree_.primitives.begin();
    std::copy_n(from, parts[b].left_count, to + targets[b].begin);
    std::copy_n(from + parts[b].left_count, here.count() - parts[b].left_count,
                to + targets[b].end);
  });
  return halves;
}

Builder::Halves Builder::partition(Range range, const BinMap& map, const Split& split) {
  Halves halves;
  std::uint32_t left = range.begin, right = range.end;
  while (left < right) {
    Primitive& candidate = tree_.primitives[left];
    if (split.sends_left(map, candidate)) {
      halves.left.grow(candidate);
      ++left;
    } else {
      halves.right.grow(candidate);
      std::swap(candidate, tree_.primitives[--right]);
    }
  }
  halves.middle = left;
  return halves;
}

// Where the heuristic has no answer, or its answer would make the tree too deep.
Builder::Halves Builder::halve_by_count(const Task& task) {
  const std::span<Primitive> all = primitives(task.range);
  const std::size_t middle = all.size() / 2;
  const Float4 size = task.bounds.centroids.upper - task.bounds.centroids.lower;
  const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
  if (size[axis] > 0.0f) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(middle), all.end(),
                     [axis](const Primitive& a, const Primitive& b) {
                       return a.centroid()[axis] < b.centroid()[axis];
                     });
  }
  Halves halves;
  halves.middle = task.range.begin + static_cast<std::uint32_t>(middle);
  for (const Primitive& primitive : all.first(middle)) halves.left.grow(primitive);
  for (const Primitive& primitive : all.subspan(middle)) halves.right.grow(primitive);
  return halves;
}

float Builder::half_area(Child child) const {
  if (!child.is_primitive()) return tree_.nodes[child.index()].box.half_area();
  const Primitive& primitive = tree_.primitives[child.index()];
  return Box{primitive.lower, primitive.upper}.half_area();
}

std::array<float, 3> Builder::forest_cost(Child child) const {
  if (!child.is_primitive()) return tree_.nodes[child.index()].forest_cost;
  const float cost = half_area(child) * kPairCost;
  return {cost, cost, cost};
}

int Builder::height(Child child) const {
  return child.is_primitive() ? 0 : tree_.nodes[child.index()].height;
}

// Chooses by dynamic programming how a node whose children are finished joins wide nodes.
void Builder::finish(std::uint32_t index) {
  BinaryNode& node = tree_.nodes[index];
  const std::array<float, 3> l = forest_cost(node.left), r = forest_cost(node.right);
  const float area = node.box.half_area();

  const float two = l[0] + r[0];
  const bool left_single = l[0] + r[1] <= l[1] + r[0];
  const float three = left_single ? l[0] + r[1] : l[1] + r[0];
  const std::array<float, 3> fours = {l[0] + r[2], l[1] + r[1], l[2] + r[0]};
  const auto four = std::min_element(fours.begin(), fours.end());

  const float inner = area * kNodeCost + *four;
  const float pairs = static_cast<float>((node.count() + 1) / 2);
  const float leaf = area * pairs * kPairCost;
  node.is_leaf = node.count() <= kMaxLeaf && leaf <= inner;
  node.forest_cost[0] = node.is_leaf ? leaf : inner;
  node.is_two = two < node.forest_cost[0];
  node.forest_cost[1] = node.is_two ? two : node.forest_cost[0];
  const bool is_three = three < node.forest_cost[1];
  node.forest_cost[2] = is_three ? three : node.forest_cost[1];
  node.left_of_three = !is_three     ? std::uint8_t{0}
                       : left_single ? std::uint8_t{1}
                                     : std::uint8_t{2};
  node.left_of_four = static_cast<std::uint8_t>(1 + (four - fours.begin()));
  node.height = static_cast<std::uint8_t>(1 + std::max(height(node.left), height(node.right)));
}

}  // namespace

BinaryTree build_binary_tree(std::span<const scene::Triangle> triangles, unsigned threads) {
  return Builder(triangles, threads).build();
}

}  // namespace ppm::bvh
