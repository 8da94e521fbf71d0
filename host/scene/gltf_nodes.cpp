#include "gltf_nodes.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "failure.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr std::size_t kMostListed = 10;

glm::dmat4 matrix_of(const Place& place, const std::vector<double>& values) {
  place.check_length(values.size(), 16);
  const glm::dmat4 matrix = glm::make_mat4(values.data());
  if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0) {
    place.fail("is not affine", "let its last row be 0 0 0 1");
  }
  return matrix;
}

glm::dmat3 rotation_of(const Place& place, const std::vector<double>& q) {
  place.check_length(q.size(), 4);
  const auto matrix = rotation({q[0], q[1], q[2], q[3]});
  if (!matrix) place.fail("is not a rotation", "write a unit quaternion x, y, z, w");
  return *matrix;
}

glm::dvec3 vector_of(const Place& place, const std::vector<double>& values) {
  place.check_length(values.size(), 3);
  return {values[0], values[1], values[2]};
}

/// What is absent is empty in tinygltf.
glm::dmat4 local_transform(const Element<tinygltf::Node>& node) {
  if (!node->matrix.empty()) return matrix_of(node.member("matrix"), node->matrix);
  glm::dmat3 linear(1.0);
  if (!node->rotation.empty()) linear = rotation_of(node.member("rotation"), node->rotation);
  if (!node->scale.empty()) {
    const glm::dvec3 scale = vector_of(node.member("scale"), node->scale);
    for (int axis = 0; axis < 3; ++axis) linear[axis] *= scale[axis];
  }
  glm::dmat4 matrix(linear);
  if (!node->translation.empty()) {
    matrix[3] = {vector_of(node.member("translation"), node->translation), 1.0};
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

using Nodes = std::vector<Element<tinygltf::Node>>;

Nodes nodes_of(const Place& list, const std::vector<int>& indices) {
  Nodes nodes;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    nodes.push_back(follow(list.item(i), indices[i], list.model().nodes, "nodes"));
  }
  return nodes;
}

Nodes children_of(const Element<tinygltf::Node>& node) {
  return nodes_of(node.member("children"), node->children);
}

std::size_t position_of(const Element<tinygltf::Node>& node) {
  return static_cast<std::size_t>(&*node - node.model().nodes.data());
}

Nodes parentless_nodes(const Place& root) {
  const std::vector<tinygltf::Node>& all = root.model().nodes;
  std::vector<bool> has_parent(all.size(), false);
  const auto node_at = [&](std::size_t i) { return Element(root.member("nodes").item(i), all[i]); };
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const auto& child : children_of(node_at(i))) has_parent[position_of(child)] = true;
  }
  Nodes roots;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!has_parent[i]) roots.push_back(node_at(i));
  }
  return roots;
}

/// The scene that `wanted` names, or else counts from 0. Many have no name.
std::size_t chosen_scene(const Place& root, const std::string& wanted) {
  const std::vector<tinygltf::Scene>& scenes = root.model().scenes;
  const auto named = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const auto& scene) { return scene.name == wanted; });
  if (named != scenes.end()) return static_cast<std::size_t>(named - scenes.begin());
  std::size_t index = 0;
  const char* const last = wanted.data() + wanted.size();
  const auto [end, error] = std::from_chars(wanted.data(), last, index);
  if (error == std::errc{} && end == last && index < scenes.size()) return index;

  std::string list = scenes.empty() ? "leave --scene out: the file has none" : "the file has ";
  for (std::size_t i = 0; i < std::min(scenes.size(), kMostListed); ++i) {
    list += (i == 0 ? "" : ", ") + std::to_string(i) + " \"" + printable(scenes[i].name) + "\"";
  }
  if (scenes.size() > kMostListed) list += " and more";
  throw Failure(root.document().file, "--scene", "there is no scene '" + printable(wanted) + "'",
                list);
}

Nodes root_nodes(const Place& root, const std::string& wanted) {
  const auto scene = find_scene(root.document(), wanted);
  return scene ? nodes_of(scene->member("nodes"), (*scene)->nodes) : parentless_nodes(root);
}

}  // namespace

std::optional<Element<tinygltf::Scene>> find_scene(Document& document, const std::string& wanted) {
  const Place root(document, "");
  const tinygltf::Model& model = document.model;
  if (!wanted.empty()) {
    const std::size_t position = chosen_scene(root, wanted);
    return Element(root.member("scenes").item(position), model.scenes[position]);
  }
  const bool names_one = model.defaultScene != -1;
  if (!names_one && model.scenes.empty()) return std::nullopt;
  return follow(root.member("scene"), names_one ? model.defaultScene : 0, model.scenes, "scenes");
}

std::optional<glm::dvec3> unit(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!std::isfinite(largest) || !(largest > 0.0)) return std::nullopt;
  const glm::dvec3 scaled = v / largest;
  const glm::dvec3 result = glm::normalize(scaled);
  return std::isfinite(glm::dot(result, result)) ? std::optional(result) : std::nullopt;
}

std::optional<glm::dmat3> rotation(glm::dvec4 q) {
  const double length = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  const double x = q.x / length, y = q.y / length, z = q.z / length, w = q.w / length;
  // Columns: the images of the axes.
  return glm::dmat3{{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)},
                    {2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)},
                    {2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)}};
}

std::vector<Placement> place_nodes(Document& document, const std::string& wanted) {
  std::vector<Placement> pending;  // a stack of our own: the depth is the file's choice
  const auto push = [&](const Nodes& nodes, const glm::dmat4& parent_to_world) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      pending.push_back({*node, parent_to_world});
    }
  };
  push(root_nodes(Place(document, ""), wanted), glm::dmat4(1.0));
  std::vector<Placement> placements;
  std::vector<bool> reached(document.model.nodes.size(), false);
  while (!pending.empty()) {
    const auto [node, parent_to_world] = pending.back();
    pending.pop_back();
    if (reached[position_of(node)]) {
      node.fail("is reached twice: it has two parents, is its own ancestor or is listed twice",
                "let every node have one parent at most");
    }
    reached[position_of(node)] = true;
    const glm::dmat4 to_world = parent_to_world * local_transform(node);
    if (!is_finite(to_world)) node.fail("its transform overflows", "use smaller numbers");
    placements.push_back({node, to_world});
    push(children_of(node), to_world);
  }
  return placements;
}

}  // namespace ppm::scene::gltf
