#include "gltf_mesh.hpp"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

#include "gltf_tangent.hpp"

namespace ppm::scene::gltf {
namespace {

bool is_finite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::dvec3 transformed(const glm::dmat4& matrix, glm::dvec3 point) {
  return glm::dvec3(matrix[0]) * point.x + glm::dvec3(matrix[1]) * point.y +
         glm::dvec3(matrix[2]) * point.z + glm::dvec3(matrix[3]);
}

/// Whether the kernels, which work in single precision, can find the triangle's normal.
bool has_area(const Triangle& triangle) {
  const auto& c = triangle.corners;
  const glm::vec3 a = c[1].position - c[0].position, b = c[2].position - c[0].position;
  const glm::vec3 n = glm::cross(a, b);
  const glm::dvec3 exact = glm::cross(glm::dvec3(c[1].position) - glm::dvec3(c[0].position),
                                      glm::dvec3(c[2].position) - glm::dvec3(c[0].position));
  return glm::dot(n, n) >= FLT_MIN && glm::dot(exact, exact) > 0.0;
}

/// Whether it is a triangle rather than a line, at any size.
bool is_well_shaped(const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 a = corners[1] - corners[0], b = corners[2] - corners[0];
  const double longest = std::max(glm::length(a), glm::length(b));
  return longest > 0.0 && glm::length(glm::cross(a / longest, b / longest)) > 1e-6;
}

glm::vec3 geometric_normal(const Triangle& triangle) {
  const auto& c = triangle.corners;
  return glm::vec3(
      glm::normalize(glm::cross(glm::dvec3(c[1].position) - glm::dvec3(c[0].position),
                                glm::dvec3(c[2].position) - glm::dvec3(c[0].position))));
}

/// A unit normal in the working frame. What is zero or not finite becomes the triangle's own.
glm::vec3 normal_of(const PosedPrimitive& posed, std::uint64_t vertex,
                    const NormalTransform& transform, glm::vec3 geometric) {
  if (!posed.primitive().normal) return geometric;
  if (const auto normal = unit(transform.matrix * posed.normal(vertex))) return glm::vec3(*normal);
  posed.primitive().element.warn("normals",
                                 "normals that are zero or not finite become the triangle's own");
  return geometric;
}

glm::vec2 texcoord_of(const Primitive& primitive, std::size_t set, std::uint64_t vertex) {
  if (!primitive.texcoords[set]) return glm::vec2(0.0f);
  const glm::dvec2 uv = primitive.texcoords[set]->vec2(vertex);
  if (std::isfinite(uv.x) && std::isfinite(uv.y)) return glm::vec2(uv);
  primitive.element.warn("texture coordinates", "texture coordinates that are not finite become 0");
  return glm::vec2(0.0f);
}

glm::vec4 color_of(const Primitive& primitive, std::uint64_t vertex) {
  if (!primitive.color) return glm::vec4(1.0f);
  const bool has_alpha = primitive.color->components() == 4;
  const glm::dvec4 color =
      has_alpha ? primitive.color->vec4(vertex) : glm::dvec4(primitive.color->vec3(vertex), 1.0);
  glm::dvec4 legal;
  for (int i = 0; i < 4; ++i) legal[i] = std::clamp(color[i], 0.0, 1.0);
  // What compression rounds beyond the range is no fault of the file.
  constexpr double kRounding = 1e-3;
  if (glm::all(glm::lessThanEqual(glm::abs(legal - color), glm::dvec4(kRounding)))) {
    return glm::vec4(legal);
  }
  primitive.element.warn("vertex colors", "vertex colours outside [0,1] are clamped");
  return is_finite(glm::dvec3(legal)) && std::isfinite(legal.w) ? glm::vec4(legal)
                                                                : glm::vec4(1.0f);
}

/// Any unit vector across `normal`.
glm::dvec3 any_across(glm::dvec3 normal) {
  const glm::dvec3 axis =
      std::abs(normal.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  return glm::normalize(glm::cross(axis, normal));
}

/// How a vertex gets into the world.
struct VertexTransform {
  glm::dmat4 to_world;
  NormalTransform normals;

  explicit VertexTransform(const glm::dmat4& matrix) : to_world(matrix), normals(matrix) {}
};

/// Makes triangles of a posed primitive.
class Baker {
 public:
  Baker(const PosedPrimitive& posed, const Frame& frame, const DetailNeeds& needs)
      : posed_(posed), primitive_(posed.primitive()), frame_(frame), needs_(needs) {
    if (posed.is_rigid()) rigid_.emplace(posed.to_world(0));
    if (!needs.tangents || (primitive_.normal && primitive_.tangent)) return;
    const auto& texcoords = primitive_.texcoords[needs.tangent_set];
    if (texcoords) tangents_.emplace(posed, *texcoords);
  }

  void bake(std::uint64_t t, Baked& baked) const;

 private:
  TriangleDetail detail_of(const Indices& vertices, const Triangle& triangle,
                           const std::array<const VertexTransform*, 3>& transforms) const;
  glm::vec4 tangent_of(glm::dvec4 tangent, glm::vec3 normal,
                       const VertexTransform& transform) const;

  const PosedPrimitive& posed_;
  const Primitive& primitive_;
  const Frame& frame_;
  const DetailNeeds& needs_;
  std::optional<VertexTransform> rigid_;    ///< of all vertices
  std::optional<VertexTangents> tangents_;  ///< where they have to be computed
};

void Baker::bake(std::uint64_t t, Baked& baked) const {
  Indices vertices = vertices_of(primitive_, t);
  std::array<std::optional<VertexTransform>, 3> blended;
  std::array<const VertexTransform*, 3> transforms{};
  if (rigid_) {
    transforms.fill(&*rigid_);
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      transforms[i] = &blended[i].emplace(posed_.to_world(vertices[i]));
    }
  }
  if (transforms[0]->normals.mirrors) {
    std::swap(vertices[1], vertices[2]);
    std::swap(transforms[1], transforms[2]);
  }
  Triangle triangle{};
  triangle.material = primitive_.material;
  std::array<glm::dvec3, 3> world;
  for (std::size_t i = 0; i < 3; ++i) {
    world[i] = transformed(transforms[i]->to_world, posed_.position(vertices[i]));
    triangle.corners[i].position = glm::vec3(frame_.to_working(world[i]));
  }
  if (!has_area(triangle)) {
    ++(is_well_shaped(world) ? baked.left_out.too_small : baked.left_out.without_area);
    return;
  }
  const glm::vec3 geometric = geometric_normal(triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    Corner& corner = triangle.corners[i];
    corner.normal = normal_of(posed_, vertices[i], transforms[i]->normals, geometric);
    corner.texcoord = texcoord_of(primitive_, 0, vertices[i]);
    corner.color = color_of(primitive_, vertices[i]);
  }
  baked.triangles.push_back(triangle);
  if (baked.with_details) baked.details.push_back(detail_of(vertices, triangle, transforms));
}

TriangleDetail Baker::detail_of(const Indices& vertices, const Triangle& triangle,
                                const std::array<const VertexTransform*, 3>& transforms) const {
  TriangleDetail detail;
  std::array<glm::dvec4, 3> tangents{};
  if (tangents_) {
    tangents = tangents_->at(vertices);
  } else if (needs_.tangents && primitive_.tangent && primitive_.normal) {
    for (std::size_t i = 0; i < 3; ++i) tangents[i] = posed_.tangent(vertices[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (needs_.texcoord1) detail[i].texcoord1 = texcoord_of(primitive_, 1, vertices[i]);
    if (!needs_.tangents) continue;
    detail[i].tangent = tangent_of(tangents[i], triangle.corners[i].normal, *transforms[i]);
  }
  return detail;
}

glm::vec4 Baker::tangent_of(glm::dvec4 tangent, glm::vec3 normal,
                            const VertexTransform& transform) const {
  const bool is_left = (tangent.w < 0.0) != transform.normals.mirrors;
  auto direction = unit(glm::dmat3(transform.to_world) * glm::dvec3(tangent));
  if (!direction) {
    primitive_.element.warn("tangents",
                            "tangents without a direction become any across the normal");
    direction = any_across(normal);
  }
  return {glm::vec3(*direction), is_left ? -1.0f : 1.0f};
}

glm::dvec3 checked_position(const PosedPrimitive& posed, std::uint64_t vertex) {
  const Primitive& primitive = posed.primitive();
  const Accessor& accessor = primitive.position;
  if (vertex >= accessor.count()) {
    primitive.element.member("indices").fail("index " + std::to_string(vertex) + " exceeds the " +
                                                 std::to_string(accessor.count()) + " vertices",
                                             "repair the mesh");
  }
  const glm::dvec3 position = posed.position(vertex);
  if (!is_finite(position)) {
    primitive.element.member("attributes.POSITION")
        .fail("vertex " + std::to_string(vertex) + " (" + accessor.path() + ") is not finite",
              "repair the mesh");
  }
  return position;
}

}  // namespace

void extend(Box& box, const PosedPrimitive& posed) {
  const Primitive& primitive = posed.primitive();
  glm::dmat4 to_world(1.0);
  if (posed.is_rigid()) to_world = posed.to_world(0);
  for (std::uint64_t t = 0; t < primitive.triangle_count; ++t) {
    for (const std::uint64_t vertex : vertices_of(primitive, t)) {
      const glm::dvec3 position = checked_position(posed, vertex);
      if (!posed.is_rigid()) to_world = posed.to_world(vertex);
      const glm::dvec3 world = transformed(to_world, position);
      if (!is_finite(world)) {
        primitive.element.fail("its positions overflow in the world", "use smaller transforms");
      }
      box.low = glm::min(box.low, world);
      box.high = glm::max(box.high, world);
    }
  }
}

DetailNeeds needs_of(const Material& material) {
  DetailNeeds needs;
  for (const OptionalTextureUse* use : texture_uses(material)) {
    needs.texcoord1 = needs.texcoord1 || (*use && (*use)->texcoord_set == 1);
  }
  if (const OptionalTextureUse& use = material.normal_texture) {
    needs.tangents = true;
    needs.tangent_set = use->texcoord_set == 1 ? 1 : 0;
  }
  return needs;
}

void bake(const PosedPrimitive& posed, const Frame& frame, const DetailNeeds& needs, Baked& baked) {
  const Baker baker(posed, frame, needs);
  for (std::uint64_t t = 0; t < posed.primitive().triangle_count; ++t) baker.bake(t, baked);
}

}  // namespace ppm::scene::gltf
