// Posed primitives to triangles of the working frame.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "gltf_pose.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// An axis-aligned box in world space, empty at first.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

/// Extends `box` by the corners of the primitive's triangles in the world. Throws Failure for
/// indices out of range and positions that are not finite; must succeed before `bake`.
void extend(Box& box, const PosedPrimitive& posed);

/// Which of what few scenes need a material needs of its triangles.
struct DetailNeeds {
  bool tangents = false;
  std::size_t tangent_set = 0;  ///< of texture coordinates that tangents follow
  bool texcoord1 = false;

  bool any() const { return tangents || texcoord1; }
};

DetailNeeds needs_of(const Material& material);

/// Triangles that cannot be rendered.
struct LeftOut {
  std::uint64_t without_area = 0;
  std::uint64_t too_small = 0;  ///< well-shaped, but without area in single precision
};

/// Where triangles go.
struct Baked {
  std::vector<Triangle> triangles;
  std::vector<TriangleDetail> details;  ///< one a triangle if `with_details`, else none
  bool with_details = false;
  LeftOut left_out;
};

/// Appends the primitive's triangles to `baked`, and counts those that have no area in single
/// precision.
void bake(const PosedPrimitive& posed, const Frame& frame, const DetailNeeds& needs, Baked& baked);

}  // namespace ppm::scene::gltf
