// Tangents for meshes that have none: MikkTSpace's convention, as glTF asks for it.
#pragma once

#include "gltf_pose.hpp"

namespace ppm::scene::gltf {

/// Tangents of a posed primitive in the mesh's own space. A vertex's is the mean of its triangles',
/// each laid into the plane across the normal and weighted by the angle that the triangle takes up
/// there; triangles whose texture is mirrored have a mean of their own. Vertices are shared as the
/// indices say, or where there are none by equal positions, normals and texture coordinates.
class VertexTangents {
 public:
  /// `texcoords` are the primitive's. All must outlive this object; all vertices are in range.
  VertexTangents(const PosedPrimitive& posed, const Accessor& texcoords);

  /// The tangents at the corners of a triangle. w is 1 or -1, the bitangent's way as w times
  /// cross(normal, tangent): towards falling v, which is up in a picture. A tangent without any
  /// direction is 0.
  std::array<glm::dvec4, 3> at(const Indices& vertices) const;

 private:
  struct Face;

  Face face_of(const Indices& vertices) const;
  void share_by_index();
  void share_by_value();
  std::uint64_t slot_of(std::uint64_t vertex) const;

  const PosedPrimitive& posed_;
  const Accessor& texcoords_;
  // One of these tells a vertex's slot: vertex less first_used_, where neither table is filled.
  std::uint64_t first_used_ = 0;
  std::vector<std::uint64_t> used_;             ///< by slot: the vertex; sorted
  std::vector<std::uint32_t> slots_;            ///< by vertex: the slot
  std::vector<std::array<glm::vec3, 2>> sums_;  ///< by slot: of upright and of mirrored triangles
};

}  // namespace ppm::scene::gltf
