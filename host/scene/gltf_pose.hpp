// Meshes as nodes pose them: morph targets at their default weights, skins as the joints stand.
#pragma once

#include <memory>

#include "gltf_nodes.hpp"
#include "gltf_primitive.hpp"

namespace ppm::scene::gltf {

/// How normals transform: by the inverse transpose, here as the cofactors with the determinant's
/// sign, which exist for singular transforms too. Scaled to avoid overflow; only directions matter.
struct NormalTransform {
  glm::dmat3 matrix{1.0};
  bool mirrors = false;

  explicit NormalTransform(const glm::dmat4& to_world);
};

/// The joints of a skin: from the space in which its vertices are given to the world.
struct Skin {
  std::vector<glm::dmat4> joints;
};

/// Reads skins, each once.
class SkinReader {
 public:
  /// `placements`, where joints are looked up, must outlive this object.
  explicit SkinReader(const std::vector<Placement>& placements);

  /// The skin of a node, or nothing where it has none or its joints are not in the scene, of which
  /// is warned. Throws Failure for malformed ones.
  std::shared_ptr<const Skin> read(const Element<tinygltf::Node>& node);

 private:
  std::shared_ptr<const Skin> read_new(const Element<tinygltf::Skin>& skin) const;

  std::map<int, const Placement*> placements_;  ///< by node
  std::map<int, std::shared_ptr<const Skin>> known_;
};

/// What a node makes of a mesh.
struct Pose {
  glm::dmat4 to_world{1.0};  ///< ignored where there is a skin
  std::span<const double> morph_weights;
  std::shared_ptr<const Skin> skin;
};

/// The pose of a node's mesh.
Pose pose_of(const Placement& placement, const Element<tinygltf::Mesh>& mesh, SkinReader& skins);

/// A primitive in a pose, both of which must outlive it. Vertices are to be in range.
class PosedPrimitive {
 public:
  PosedPrimitive(const Primitive& primitive, const Pose& pose);

  const Primitive& primitive() const { return primitive_; }
  /// Of a vertex in the mesh's own space, morphed; normals and tangents of any length.
  glm::dvec3 position(std::uint64_t vertex) const;
  glm::dvec3 normal(std::uint64_t vertex) const;   ///< the primitive has normals
  glm::dvec4 tangent(std::uint64_t vertex) const;  ///< the primitive has tangents
  /// Whether all vertices have the same transform.
  bool is_rigid() const { return skin_ == nullptr; }
  /// Throws Failure for joints that the skin does not have.
  glm::dmat4 to_world(std::uint64_t vertex) const {
    return skin_ ? blended_joints(vertex) : to_world_;
  }

 private:
  glm::dmat4 blended_joints(std::uint64_t vertex) const;
  glm::dvec3 morphed(glm::dvec3 value, std::optional<Accessor> MorphTarget::*part,
                     std::uint64_t vertex) const;

  const Primitive& primitive_;
  const glm::dmat4& to_world_;
  const Skin* skin_;
  std::vector<std::pair<const MorphTarget*, double>> targets_;  ///< with their weights, not 0
};

}  // namespace ppm::scene::gltf
