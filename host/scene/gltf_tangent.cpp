#include "gltf_tangent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ppm::scene::gltf {

/// A triangle and the way its texture's u runs.
struct VertexTangents::Face {
  std::array<glm::dvec3, 3> corners, normals;
  std::optional<glm::dvec3> direction;  ///< unit; none where the texture has no area
  bool is_mirrored = false;
};

namespace {

constexpr std::uint64_t kSparse = 16;  // vertices between the used ones that a table is worth

/// What is left of `v` across the unit vector `normal`, as a unit vector or zero.
glm::dvec3 across(glm::dvec3 v, glm::dvec3 normal) {
  return unit(v - glm::dot(v, normal) * normal).value_or(glm::dvec3(0.0));
}

/// Corner `k`'s angle, seen along the normal.
double angle_at(const std::array<glm::dvec3, 3>& corners, std::size_t k, glm::dvec3 normal) {
  const glm::dvec3 a = across(corners[(k + 1) % 3] - corners[k], normal);
  const glm::dvec3 b = across(corners[(k + 2) % 3] - corners[k], normal);
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

}  // namespace

VertexTangents::VertexTangents(const PosedPrimitive& posed, const Accessor& texcoords)
    : posed_(posed), texcoords_(texcoords) {
  const Primitive& primitive = posed.primitive();
  if (!primitive.normal) return;  // every triangle has its own
  if (primitive.indices) {
    share_by_index();
  } else {
    share_by_value();
  }
  for (std::uint64_t t = 0; t < primitive.triangle_count; ++t) {
    const Indices vertices = vertices_of(primitive, t);
    const Face face = face_of(vertices);
    if (!face.direction) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = angle_at(face.corners, k, face.normals[k]);
      const glm::dvec3 tangent = across(*face.direction, face.normals[k]) * angle;
      sums_[slot_of(vertices[k])][face.is_mirrored] += glm::vec3(tangent);
    }
  }
}

VertexTangents::Face VertexTangents::face_of(const Indices& vertices) const {
  Face face;
  std::array<glm::dvec2, 3> uv;
  for (std::size_t k = 0; k < 3; ++k) {
    face.corners[k] = posed_.position(vertices[k]);
    uv[k] = texcoords_.vec2(vertices[k]);
    uv[k].y = -uv[k].y;  // up
  }
  const glm::dvec3 a = face.corners[1] - face.corners[0], b = face.corners[2] - face.corners[0];
  for (std::size_t k = 0; k < 3; ++k) {
    std::optional<glm::dvec3> normal;
    if (posed_.primitive().normal) normal = unit(posed_.normal(vertices[k]));
    if (!normal) normal = unit(glm::cross(a, b));
    face.normals[k] = normal.value_or(glm::dvec3(0.0));
  }
  const glm::dvec2 s = uv[1] - uv[0], t = uv[2] - uv[0];
  const double area = s.x * t.y - t.x * s.y;
  face.is_mirrored = area < 0.0;
  if (area != 0.0) face.direction = unit((a * t.y - b * s.y) * (face.is_mirrored ? -1.0 : 1.0));
  return face;
}

void VertexTangents::share_by_index() {
  const Primitive& primitive = posed_.primitive();
  used_.reserve(3 * primitive.triangle_count);
  for (std::uint64_t t = 0; t < primitive.triangle_count; ++t) {
    for (const std::uint64_t vertex : vertices_of(primitive, t)) used_.push_back(vertex);
  }
  const auto [least, most] = std::minmax_element(used_.begin(), used_.end());
  first_used_ = *least;
  const std::uint64_t extent = *most - *least + 1;
  if (extent <= kSparse * used_.size()) {
    sums_.resize(extent);
    used_ = {};
    return;
  }
  std::sort(used_.begin(), used_.end());
  used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
  sums_.resize(used_.size());
}

void VertexTangents::share_by_value() {
  const std::uint64_t count = posed_.primitive().position.count();
  using Key = std::array<float, 8>;
  std::vector<Key> keys(count);
  for (std::uint64_t vertex = 0; vertex < count; ++vertex) {
    const glm::vec3 p(posed_.position(vertex)), n(posed_.normal(vertex));
    const glm::vec2 uv(texcoords_.vec2(vertex));
    keys[vertex] = {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y};
    for (float& value : keys[vertex]) {
      if (std::isnan(value)) value = 0.0f;  // which has no order
    }
  }
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  slots_.resize(count);
  std::uint32_t slot = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i > 0 && keys[order[i]] != keys[order[i - 1]]) ++slot;
    slots_[order[i]] = slot;
  }
  sums_.resize(std::uint64_t{slot} + 1);
}

std::uint64_t VertexTangents::slot_of(std::uint64_t vertex) const {
  if (!slots_.empty()) return slots_[vertex];
  if (used_.empty()) return vertex - first_used_;
  return static_cast<std::uint64_t>(std::lower_bound(used_.begin(), used_.end(), vertex) -
                                    used_.begin());
}

std::array<glm::dvec4, 3> VertexTangents::at(const Indices& vertices) const {
  const Face face = face_of(vertices);
  std::array<glm::dvec4, 3> tangents;
  for (std::size_t k = 0; k < 3; ++k) {
    bool is_mirrored = face.is_mirrored;
    glm::dvec3 tangent = across(face.direction.value_or(glm::dvec3(0.0)), face.normals[k]);
    if (!sums_.empty()) {
      const auto& sums = sums_[slot_of(vertices[k])];
      // Where its own texture has no area a triangle takes what its neighbours have.
      if (!face.direction && sums[0] == glm::vec3(0.0f)) is_mirrored = true;
      tangent = unit(glm::dvec3(sums[is_mirrored])).value_or(tangent);
    }
    tangents[k] = {tangent, is_mirrored ? -1.0 : 1.0};
  }
  return tangents;
}

}  // namespace ppm::scene::gltf
