// The scene graph, flattened: every node with its transform to the world.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gltf_document.hpp"

namespace ppm::scene::gltf {

/// A node and its transform to world space (affine, finite, maybe singular).
struct Placement {
  Element<tinygltf::Node> node;
  glm::dmat4 to_world;
};

/// The unit vector along `v`, or nothing where `v` is zero or not finite.
std::optional<glm::dvec3> unit(glm::dvec3 v);

/// Rotation by a quaternion (x, y, z, w) of any length, or nothing where that is zero or not
/// finite.
std::optional<glm::dmat3> rotation(glm::dvec4 q);

/// The scene of this name or index; empty: the default scene, the first if the file names none,
/// nothing if it has none. Throws Failure where there is no such scene.
std::optional<Element<tinygltf::Scene>> find_scene(Document& document, const std::string& wanted);

/// The nodes of the scene that `wanted` names (see find_scene), parents first; all nodes if there
/// is none. Throws Failure for cycles, nodes with two parents and transforms that are not finite.
std::vector<Placement> place_nodes(Document& document, const std::string& wanted);

}  // namespace ppm::scene::gltf
