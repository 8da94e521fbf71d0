// Meshes to triangles of the working frame.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "gltf_accessor.hpp"
#include "scene.hpp"

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

/// A primitive whose accessors agree with each other. `extend` checks the indices and positions in
/// it.
struct Primitive {
  Element<tinygltf::Primitive> element;
  Topology topology = Topology::triangles;
  Accessor position;
  std::optional<Accessor> normal, texcoord, color, indices;
  std::uint64_t triangle_count = 0;
  std::uint32_t material = 0;
};

/// An axis-aligned box in world space, empty at first.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

/// The primitives of a mesh that consist of triangles; others are skipped with a warning.
/// Throws Failure for malformed ones. Takes no time in proportion to their size.
std::vector<Primitive> read_primitives(const Element<tinygltf::Mesh>& mesh,
                                       MaterialUses& materials);

/// Extends `box` by the corners of the primitive's triangles in the world. Throws Failure for
/// indices out of range and positions that are not finite; must succeed before `bake`.
void extend(Box& box, const Primitive& primitive, const glm::dmat4& to_world);

/// Triangles that cannot be rendered.
struct LeftOut {
  std::uint64_t without_area = 0;
  std::uint64_t too_small = 0;  ///< well-shaped, but without area in single precision
};

/// Appends the primitive's triangles to `triangles`. Counts in `left_out` those that have no area
/// in single precision.
void bake(const Primitive& primitive, const glm::dmat4& to_world, const Frame& frame,
          std::vector<Triangle>& triangles, LeftOut& left_out);

}  // namespace ppm::scene::gltf
