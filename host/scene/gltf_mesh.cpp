#include "gltf_mesh.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "gltf_nodes.hpp"

namespace ppm::scene::gltf {
namespace {

using Indices = std::array<std::uint64_t, 3>;

bool is_finite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The mode of a primitive, or nothing for points and lines.
std::optional<Topology> topology_of(const Element<tinygltf::Primitive>& primitive) {
  switch (primitive->mode) {
    case TINYGLTF_MODE_TRIANGLES:
      return Topology::triangles;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
      return Topology::strip;
    case TINYGLTF_MODE_TRIANGLE_FAN:
      return Topology::fan;
    case TINYGLTF_MODE_POINTS:
    case TINYGLTF_MODE_LINE:
    case TINYGLTF_MODE_LINE_LOOP:
    case TINYGLTF_MODE_LINE_STRIP:
      primitive.warn("points and lines", "points and lines are not rendered");
      return std::nullopt;
    default:
      primitive.member("mode").fail("is not a topology of glTF", "use 4, 5 or 6");
  }
}

std::uint64_t triangle_count_of(const Place& primitive, Topology topology, std::uint64_t vertices) {
  if (topology == Topology::triangles && vertices % 3 == 0) return vertices / 3;
  if (topology != Topology::triangles && vertices >= 3) return vertices - 2;
  primitive.fail(std::to_string(vertices) + " vertices do not make up whole triangles",
                 "correct the indices or the mode");
}

std::optional<Accessor> attribute(const Element<tinygltf::Primitive>& primitive, const char* name) {
  const auto found = primitive->attributes.find(name);
  if (found == primitive->attributes.end()) return std::nullopt;
  return Accessor(follow(primitive.member("attributes").member(name), found->second,
                         primitive.model().accessors, "accessors"));
}

/// An attribute beside POSITION, which has `count` elements.
std::optional<Accessor> attribute(const Element<tinygltf::Primitive>& primitive, const char* name,
                                  std::uint64_t count, int least_components, int most_components) {
  std::optional<Accessor> accessor = attribute(primitive, name);
  if (!accessor) return std::nullopt;
  const Place place = primitive.member("attributes").member(name);
  if (accessor->components() < least_components || accessor->components() > most_components) {
    place.fail("has a type that this attribute cannot have", "see glTF 2.0, section 3.7.2.1");
  }
  if (accessor->count() != count) {
    place.fail("has " + std::to_string(accessor->count()) + " elements beside " +
                   std::to_string(count) + " positions",
               "give every attribute as many");
  }
  return accessor;
}

std::optional<Accessor> read_indices(const Element<tinygltf::Primitive>& primitive) {
  if (primitive->indices == -1) return std::nullopt;
  const Place place = primitive.member("indices");
  Accessor accessor(follow(place, primitive->indices, primitive.model().accessors, "accessors"));
  const ComponentType type = accessor.component_type();
  const bool is_unsigned =
      type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
  if (accessor.components() != 1 || !is_unsigned) {
    place.fail("are not unsigned integers", "use SCALAR with componentType 5121, 5123 or 5125");
  }
  return accessor;
}

void warn_of_unread(const Element<tinygltf::Primitive>& primitive) {
  const Place attributes = primitive.member("attributes");
  if (!primitive->targets.empty()) primitive.warn("morph targets", "morph targets are ignored");
  if (primitive->attributes.contains("JOINTS_0")) attributes.warn("skins", "skins are ignored");
  if (primitive->attributes.contains("COLOR_1")) attributes.warn("COLOR_1", "only COLOR_0 is read");
}

std::optional<int> material_of(const Element<tinygltf::Primitive>& primitive) {
  if (primitive->material == -1) return std::nullopt;
  follow(primitive.member("material"), primitive->material, primitive.model().materials,
         "materials");
  return primitive->material;
}

std::optional<Primitive> read_primitive(const Element<tinygltf::Primitive>& element,
                                        MaterialUses& materials) {
  const std::optional<Topology> topology = topology_of(element);
  if (!topology) return std::nullopt;
  warn_of_unread(element);
  std::optional<Accessor> position = attribute(element, "POSITION");
  if (!position) {
    element.warn("no positions", "a primitive without POSITION is not rendered");
    return std::nullopt;
  }
  const std::uint64_t count = position->count();
  if (position->components() != 3) {
    element.member("attributes.POSITION").fail("is not of type VEC3", "write x, y, z");
  }
  Primitive primitive{element, *topology, std::move(*position), {}, {}, {}, {}, 0, 0};
  primitive.normal = attribute(element, "NORMAL", count, 3, 3);
  primitive.texcoord = attribute(element, "TEXCOORD_0", count, 2, 2);
  primitive.color = attribute(element, "COLOR_0", count, 3, 4);
  primitive.indices = read_indices(element);
  primitive.triangle_count =
      triangle_count_of(element, *topology, primitive.indices ? primitive.indices->count() : count);
  primitive.material = materials.use(material_of(element));
  return primitive;
}

/// The vertices of triangle `t`, counter-clockwise seen from the front (glTF 2.0, section 3.7.2.1).
Indices vertices_of(const Primitive& primitive, std::uint64_t t) {
  Indices corners{};
  switch (primitive.topology) {
    case Topology::triangles:
      corners = {3 * t, 3 * t + 1, 3 * t + 2};
      break;
    case Topology::strip:
      corners = {t, t + 1 + t % 2, t + 2 - t % 2};
      break;
    case Topology::fan:
      corners = {t + 1, t + 2, 0};
      break;
  }
  if (primitive.indices) {
    for (std::uint64_t& corner : corners) corner = primitive.indices->whole(corner);
  }
  return corners;
}

glm::dvec3 checked_position(const Primitive& primitive, std::uint64_t vertex) {
  const Accessor& accessor = primitive.position;
  if (vertex >= accessor.count()) {
    primitive.element.member("indices").fail("index " + std::to_string(vertex) + " exceeds the " +
                                                 std::to_string(accessor.count()) + " vertices",
                                             "repair the mesh");
  }
  const glm::dvec3 position = accessor.vec3(vertex);
  if (!is_finite(position)) {
    primitive.element.member("attributes.POSITION")
        .fail("vertex " + std::to_string(vertex) + " (" + accessor.path() + ") is not finite",
              "repair the mesh");
  }
  return position;
}

glm::dvec3 transformed(const glm::dmat4& matrix, glm::dvec3 point) {
  return glm::dvec3(matrix * glm::dvec4(point, 1.0));
}

/// How normals transform: by the inverse transpose, here as the cofactors with the determinant's
/// sign, which exist for singular transforms too. Scaled to avoid overflow; only directions matter.
struct NormalTransform {
  glm::dmat3 matrix{1.0};
  bool mirrors = false;

  explicit NormalTransform(const glm::dmat4& to_world) {
    glm::dmat3 m(to_world);
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
    }
    if (largest > 0.0) m /= largest;
    matrix = {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
    mirrors = glm::dot(m[0], matrix[0]) < 0.0;
    if (mirrors) matrix = -matrix;
  }
};

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

glm::vec2 texcoord_of(const Primitive& primitive, std::uint64_t vertex) {
  if (!primitive.texcoord) return glm::vec2(0.0f);
  const glm::dvec2 uv = primitive.texcoord->vec2(vertex);
  if (std::isfinite(uv.x) && std::isfinite(uv.y)) return glm::vec2(uv);
  primitive.element.warn("texture coordinates", "texture coordinates that are not finite become 0");
  return glm::vec2(0.0f);
}

glm::vec4 color_of(const Primitive& primitive, std::uint64_t vertex) {
  if (!primitive.color) return glm::vec4(1.0f);
  const glm::dvec3 color = primitive.color->vec3(vertex);
  const glm::dvec3 legal(std::clamp(color.x, 0.0, 1.0), std::clamp(color.y, 0.0, 1.0),
                         std::clamp(color.z, 0.0, 1.0));
  if (legal == color) return {glm::vec3(color), 1.0f};
  primitive.element.warn("vertex colors", "vertex colours outside [0,1] are clamped");
  return is_finite(legal) ? glm::vec4(glm::vec3(legal), 1.0f) : glm::vec4(1.0f);
}

glm::vec3 normal_of(const Primitive& primitive, std::uint64_t vertex, const glm::dmat3& matrix,
                    glm::vec3 geometric) {
  if (!primitive.normal) return geometric;
  if (const auto normal = unit(matrix * primitive.normal->vec3(vertex))) return glm::vec3(*normal);
  primitive.element.warn("normals",
                         "normals that are zero or not finite become the triangle's own");
  return geometric;
}

}  // namespace

std::uint32_t MaterialUses::use(std::optional<int> index) {
  const auto next = static_cast<std::uint32_t>(in_order_.size());
  const auto [position, is_new] = positions_.emplace(index, next);
  if (is_new) in_order_.push_back(index);
  return position->second;
}

std::vector<Primitive> read_primitives(const Element<tinygltf::Mesh>& mesh,
                                       MaterialUses& materials) {
  const Place list = mesh.member("primitives");
  if (mesh->primitives.empty()) list.fail("is empty", "remove the mesh or give it a primitive");
  std::vector<Primitive> primitives;
  for (std::size_t i = 0; i < mesh->primitives.size(); ++i) {
    std::optional<Primitive> primitive =
        read_primitive({list.item(i), mesh->primitives[i]}, materials);
    if (primitive) primitives.push_back(std::move(*primitive));
  }
  return primitives;
}

void extend(Box& box, const Primitive& primitive, const glm::dmat4& to_world) {
  for (std::uint64_t t = 0; t < primitive.triangle_count; ++t) {
    for (const std::uint64_t vertex : vertices_of(primitive, t)) {
      const glm::dvec3 world = transformed(to_world, checked_position(primitive, vertex));
      if (!is_finite(world)) {
        primitive.element.fail("its positions overflow in the world", "use smaller transforms");
      }
      box.low = glm::min(box.low, world);
      box.high = glm::max(box.high, world);
    }
  }
}

void bake(const Primitive& primitive, const glm::dmat4& to_world, const Frame& frame,
          std::vector<Triangle>& triangles, LeftOut& left_out) {
  const NormalTransform normals(to_world);
  for (std::uint64_t t = 0; t < primitive.triangle_count; ++t) {
    Indices vertices = vertices_of(primitive, t);
    if (normals.mirrors) std::swap(vertices[1], vertices[2]);
    Triangle triangle{};
    triangle.material = primitive.material;
    std::array<glm::dvec3, 3> world;
    for (std::size_t i = 0; i < 3; ++i) {
      world[i] = transformed(to_world, primitive.position.vec3(vertices[i]));
      triangle.corners[i].position = glm::vec3(frame.to_working(world[i]));
    }
    if (!has_area(triangle)) {
      ++(is_well_shaped(world) ? left_out.too_small : left_out.without_area);
      continue;
    }
    const glm::vec3 geometric = geometric_normal(triangle);
    for (std::size_t i = 0; i < 3; ++i) {
      Corner& corner = triangle.corners[i];
      corner.normal = normal_of(primitive, vertices[i], normals.matrix, geometric);
      corner.texcoord = texcoord_of(primitive, vertices[i]);
      corner.color = color_of(primitive, vertices[i]);
    }
    triangles.push_back(triangle);
  }
}

}  // namespace ppm::scene::gltf
