// Primitives of meshes: what their accessors hold, in the glTF file's own terms.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "gltf_accessor.hpp"
#include "gltf_draco.hpp"

namespace ppm::scene::gltf {

/// The materials that triangles use, in the order of their first use; nothing stands for glTF's
/// default.
class MaterialUses {
 public:
  /// The index in Scene::materials of the glTF material `index`.
  std::uint32_t use(std::optional<int> index);
  const std::vector<std::optional<int>>& in_order() const { return in_order_; }

 private:
  std::map<std::optional<int>, std::uint32_t> positions_;
  std::vector<std::optional<int>> in_order_;
};

enum class Topology { triangles, strip, fan };

/// What is added to a vertex for each unit of a morph target's weight.
struct MorphTarget {
  std::optional<Accessor> position, normal, tangent;
};

/// Up to four joints of a vertex (JOINTS_n) and how much each moves it (WEIGHTS_n).
struct Influences {
  Accessor joints, weights;
};

/// A primitive whose accessors agree with each other. Indices and positions are checked by
/// `extend`.
struct Primitive {
  Element<tinygltf::Primitive> element;
  std::shared_ptr<const DracoMesh> draco;  ///< where accessors read from, if it is compressed
  Topology topology = Topology::triangles;
  Accessor position;
  std::optional<Accessor> normal, tangent, color, indices;
  std::array<std::optional<Accessor>, 2> texcoords;
  std::vector<MorphTarget> targets;
  std::vector<Influences> influences;
  std::uint64_t triangle_count = 0;
  std::uint32_t material = 0;
};

/// The vertices of a triangle.
using Indices = std::array<std::uint64_t, 3>;

/// The vertices of triangle `t`, counter-clockwise seen from the front (glTF 2.0, section 3.7.2.1).
/// They may lie out of range.
Indices vertices_of(const Primitive& primitive, std::uint64_t t);

/// The primitives of a mesh that consist of triangles; others are skipped with a warning. Throws
/// Failure for malformed ones. But for compressed ones takes no time in proportion to their size.
std::vector<Primitive> read_primitives(const Element<tinygltf::Mesh>& mesh,
                                       MaterialUses& materials);

}  // namespace ppm::scene::gltf
