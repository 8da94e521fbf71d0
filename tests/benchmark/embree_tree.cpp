#include "embree_tree.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "failure.hpp"
#include "grid.hpp"
#include "node.hpp"

namespace ppm::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

struct Element {
  bool is_leaf;
  unsigned count;  // children or triangles
  std::array<Element*, 4> children;
  std::array<RTCBounds, 4> bounds;
  std::array<std::uint32_t, 4> triangles;
};

double half_area(const RTCBounds& box) {
  const double x = box.upper_x - box.lower_x, y = box.upper_y - box.lower_y,
               z = box.upper_z - box.lower_z;
  return x * y + y * z + z * x;
}

void* new_element(RTCThreadLocalAllocator allocator, bool is_leaf, std::size_t count) {
  void* const memory = rtcThreadLocalAlloc(allocator, sizeof(Element), 16);
  return new (memory) Element{is_leaf, static_cast<unsigned>(count), {}, {}, {}};
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned count, void*) {
  return new_element(allocator, false, count);
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t count, void*) {
  auto* const leaf = static_cast<Element*>(new_element(allocator, true, count));
  for (std::size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
  return leaf;
}

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i)
    static_cast<Element*>(node)->children[i] = static_cast<Element*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Element*>(node)->bounds[i] = *bounds[i];
}

// The boxes of a triangle's parts on either side of a plane, within the box it has by now.
void split(const RTCBuildPrimitive* primitive, unsigned axis, float position, RTCBounds* left,
           RTCBounds* right, void* scene) {
  const auto& corners =
      (*static_cast<const std::span<const scene::Triangle>*>(scene))[primitive->primID].corners;
  constexpr float kFar = 3e38f;
  std::array<glm::vec3, 2> lower = {glm::vec3(kFar), glm::vec3(kFar)};
  std::array<glm::vec3, 2> upper = {glm::vec3(-kFar), glm::vec3(-kFar)};
  const auto grow = [&](std::size_t side, glm::vec3 point) {
    lower[side] = glm::min(lower[side], point);
    upper[side] = glm::max(upper[side], point);
  };
  const int a = static_cast<int>(axis);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 from = corners[i].position, to = corners[(i + 1) % 3].position;
    if (from[a] <= position) grow(0, from);
    if (from[a] >= position) grow(1, from);
    if ((from[a] < position) == (to[a] < position) || from[a] == to[a]) continue;
    glm::vec3 cut = glm::mix(from, to, (position - from[a]) / (to[a] - from[a]));
    cut[a] = position;
    grow(0, cut);
    grow(1, cut);
  }
  const glm::vec3 lowest(primitive->lower_x, primitive->lower_y, primitive->lower_z);
  const glm::vec3 highest(primitive->upper_x, primitive->upper_y, primitive->upper_z);
  for (std::size_t side = 0; side < 2; ++side) {
    const glm::vec3 l = glm::max(lower[side], lowest), u = glm::min(upper[side], highest);
    *(side == 0 ? left : right) = {l.x, l.y, l.z, 0.0f, u.x, u.y, u.z, 0.0f};
  }
}

bvh::Box box_of(const RTCBounds& b) {
  return {bvh::Float4{b.lower_x, b.lower_y, b.lower_z, 0.0f},
          bvh::Float4{b.upper_x, b.upper_y, b.upper_z, 0.0f}};
}

// Writes Embree's tree as the kernels read one: the boxes on the grid, the triangles of the leaves
// one after another, those that were split once for each part.
class Translation {
 public:
  Translation(const Element& root, const RTCBounds& bounds)
      : grid_(bvh::Grid::over(box_of(bounds))) {
    tree_.nodes.push_back(bvh::empty_node());
    if (root.is_leaf) {
      add_child(root, bounds, 0, 0);
    } else {
      fill(root, bounds, 0);
    }
    tree_.grid_origin = grid_.origin;
    tree_.grid_step = grid_.step;
    tree_.sah_cost /= half_area(bounds);
    tree_.stack_depth = bvh::stack_depth_of(tree_.nodes);
    if (tree_.stack_depth > PPM_BVH_STACK)
      throw Failure("", "Embree's tree", "is too deep for the kernels", "measure another scene");
  }

  bvh::Bvh result() && { return std::move(tree_); }

 private:
  void fill(const Element& element, const RTCBounds& bounds, std::uint32_t index) {
    tree_.sah_cost += half_area(bounds);
    for (unsigned i = 0; i < element.count; ++i)
      add_child(*element.children[i], element.bounds[i], index, static_cast<int>(i));
  }

  void add_child(const Element& child, const RTCBounds& bounds, std::uint32_t parent, int slot) {
    bvh::set_child_box(tree_.nodes[parent], slot, box_of(bounds), grid_);
    if (!child.is_leaf) {
      const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
      tree_.nodes.push_back(bvh::empty_node());
      tree_.nodes[parent].children[slot] = index;
      return fill(child, bounds, index);
    }
    const auto first = static_cast<std::uint32_t>(tree_.triangle_order.size());
    tree_.nodes[parent].children[slot] = bvh::leaf_reference(first, child.count);
    tree_.triangle_order.insert(tree_.triangle_order.end(), child.triangles.begin(),
                                child.triangles.begin() + child.count);
    tree_.sah_cost += half_area(bounds) * child.count;
  }

  bvh::Grid grid_;
  bvh::Bvh tree_;
};

std::vector<RTCBuildPrimitive> boxes_of(std::span<const scene::Triangle> triangles,
                                        std::size_t capacity) {
  std::vector<RTCBuildPrimitive> boxes(capacity);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& c = triangles[i].corners;
    const glm::vec3 l = glm::min(glm::min(c[0].position, c[1].position), c[2].position);
    const glm::vec3 u = glm::max(glm::max(c[0].position, c[1].position), c[2].position);
    boxes[i] = {l.x, l.y, l.z, 0, u.x, u.y, u.z, static_cast<unsigned>(i)};
  }
  return boxes;
}

RTCBounds bounds_of(std::span<const RTCBuildPrimitive> boxes) {
  RTCBounds all{3e38f, 3e38f, 3e38f, 0.0f, -3e38f, -3e38f, -3e38f, 0.0f};
  for (const RTCBuildPrimitive& box : boxes) {
    all.lower_x = std::min(all.lower_x, box.lower_x);
    all.lower_y = std::min(all.lower_y, box.lower_y);
    all.lower_z = std::min(all.lower_z, box.lower_z);
    all.upper_x = std::max(all.upper_x, box.upper_x);
    all.upper_y = std::max(all.upper_y, box.upper_y);
    all.upper_z = std::max(all.upper_z, box.upper_z);
  }
  return all;
}

}  // namespace

EmbreeTree build_embree_tree(RTCDevice device, std::span<const scene::Triangle> triangles,
                             bool spatial_splits) {
  const std::size_t capacity = spatial_splits ? triangles.size() * 2 : triangles.size();
  std::vector<RTCBuildPrimitive> boxes = boxes_of(triangles, capacity);
  const RTCBounds bounds = bounds_of(std::span(boxes).first(triangles.size()));
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = spatial_splits ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = 4;
  arguments.maxDepth = 1000;
  arguments.maxLeafSize = 4;
  arguments.bvh = rtcNewBVH(device);
  arguments.primitives = boxes.data();
  arguments.primitiveCount = triangles.size();
  arguments.primitiveArrayCapacity = capacity;
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  arguments.splitPrimitive = spatial_splits ? split : nullptr;
  arguments.userPtr = &triangles;
  EmbreeTree tree;
  const auto start = Clock::now();
  const auto* const root = static_cast<const Element*>(rtcBuildBVH(&arguments));
  tree.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (root != nullptr) tree.tree = Translation(*root, bounds).result();
  rtcReleaseBVH(arguments.bvh);
  return tree;
}

}  // namespace ppm::benchmark
