// EXT_mesh_gpu_instancing: many copies of a node's mesh.
#pragma once

#include "gltf_accessor.hpp"
#include "gltf_nodes.hpp"

namespace ppm::scene::gltf {

/// Where the copies of a node's mesh stand.
class Copies {
 public:
  /// Nothing where the node asks for none. Throws Failure for accessors that do not agree.
  static std::optional<Copies> read(const Element<tinygltf::Node>& node);

  std::uint64_t count() const { return count_; }
  /// Of copy `i` to the node. Throws Failure where it is not finite.
  glm::dmat4 to_node(std::uint64_t i) const;

 private:
  explicit Copies(Place place) : place_(std::move(place)) {}

  Place place_;
  std::uint64_t count_ = 0;
  std::optional<Accessor> translation_, rotation_, scale_;
};

}  // namespace ppm::scene::gltf
