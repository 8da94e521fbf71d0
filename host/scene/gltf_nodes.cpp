#include "gltf_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ppm::scene::gltf {
namespace {

glm::dmat4 matrix_of(const Element& element) {
  std::array<double, 16> values{};
  element.numbers(values);
  glm::dmat4 matrix(1.0);
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
  if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0) {
    element.fail("is not affine", "let its last row be 0 0 0 1");
  }
  return matrix;
}

/// Rotation by a quaternion (x, y, z, w) of any length but zero.
glm::dmat3 rotation_of(const Element& element) {
  std::array<double, 4> q{};
  element.numbers(q);
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(length > 0.0) || !std::isfinite(length)) {
    element.fail("is not a rotation", "write a unit quaternion x, y, z, w");
  }
  const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
  // Columns: the images of the axes.
  return {{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)},
          {2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)},
          {2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)}};
}

glm::dmat4 local_transform(const Element& node) {
  if (const std::optional<Element> matrix = node.find("matrix")) return matrix_of(*matrix);
  glm::dmat3 linear(1.0);
  if (const std::optional<Element> rotation = node.find("rotation"))
    linear = rotation_of(*rotation);
  if (const std::optional<Element> scale = node.find("scale")) {
    std::array<double, 3> s{};
    scale->numbers(s);
    for (int axis = 0; axis < 3; ++axis) linear[axis] *= s[static_cast<std::size_t>(axis)];
  }
  glm::dmat4 matrix(linear);
  if (const std::optional<Element> translation = node.find("translation")) {
    std::array<double, 3> t{};
    translation->numbers(t);
    matrix[3] = {t[0], t[1], t[2], 1.0};
  }
  return matrix;
}

bool is_finite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

std::vector<std::uint32_t> indices_of(const Element& list) {
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < list.size(); ++i) indices.push_back(list[i].as_index("nodes"));
  return indices;
}

std::vector<std::uint32_t> children_of(const Element& node) {
  const std::optional<Element> children = node.find("children");
  return children ? indices_of(*children) : std::vector<std::uint32_t>();
}

std::vector<std::uint32_t> parentless_nodes(const Element& nodes) {
  std::vector<bool> has_parent(nodes.size(), false);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const std::uint32_t child : children_of(nodes[i])) has_parent[child] = true;
  }
  std::vector<std::uint32_t> roots;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!has_parent[i]) roots.push_back(static_cast<std::uint32_t>(i));
  }
  return roots;
}

std::vector<std::uint32_t> root_nodes(Origin& origin, const Element& nodes) {
  const Element root(origin, *origin.root, "");
  const std::optional<Element> scenes = root.find("scenes");
  std::optional<Element> scene;
  if (root.find("scene")) {
    scene = root.follow("scene", "scenes");
  } else if (scenes && scenes->size() > 0) {
    scene = (*scenes)[0];
  }
  if (!scene) return parentless_nodes(nodes);
  const std::optional<Element> list = scene->find("nodes");
  return list ? indices_of(*list) : std::vector<std::uint32_t>();
}

}  // namespace

std::optional<glm::dvec3> unit(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!std::isfinite(largest) || !(largest > 0.0)) return std::nullopt;
  const glm::dvec3 scaled = v / largest;
  const glm::dvec3 result = glm::normalize(scaled);
  return std::isfinite(glm::dot(result, result)) ? std::optional(result) : std::nullopt;
}

std::vector<Placement> place_nodes(Origin& origin) {
  std::vector<Placement> placements;
  const std::optional<Element> nodes = top_level(origin, "nodes");
  if (!nodes) return placements;

  struct Pending {
    std::uint32_t node;
    glm::dmat4 parent_to_world;
  };
  std::vector<Pending> pending;  // a stack of our own: the depth is the file's choice
  const std::vector<std::uint32_t> roots = root_nodes(origin, *nodes);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    pending.push_back({*root, glm::dmat4(1.0)});
  }
  std::vector<bool> reached(nodes->size(), false);
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    const Element node = (*nodes)[next.node];
    if (reached[next.node]) {
      node.fail("is reached twice: it has two parents, is its own ancestor or is listed twice",
                "let every node have one parent at most");
    }
    reached[next.node] = true;
    const glm::dmat4 to_world = next.parent_to_world * local_transform(node);
    if (!is_finite(to_world)) node.fail("its transform overflows", "use smaller numbers");
    placements.push_back({node, to_world});
    const std::vector<std::uint32_t> children = children_of(node);
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      pending.push_back({*child, to_world});
    }
  }
  return placements;
}

}  // namespace ppm::scene::gltf
