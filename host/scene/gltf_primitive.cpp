#include "gltf_primitive.hpp"

namespace ppm::scene::gltf {
namespace {

using PrimitiveElement = Element<tinygltf::Primitive>;

/// The mode of a primitive, or nothing for points and lines.
std::optional<Topology> topology_of(const PrimitiveElement& primitive) {
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

/// What an attribute may be.
struct Shape {
  int least_components, most_components;
  std::uint64_t count;  ///< of elements; 0: any
};

Accessor read_accessor(const Place& place, int index, const Shape& shape,
                       const std::optional<ByteView>& unpacked = std::nullopt) {
  const auto element = follow(place, index, place.model().accessors, "accessors");
  Accessor accessor = unpacked ? Accessor(element, *unpacked) : Accessor(element);
  if (accessor.components() < shape.least_components ||
      accessor.components() > shape.most_components) {
    place.fail("has a type that this attribute cannot have", "see glTF 2.0, section 3.7.2.1");
  }
  if (shape.count != 0 && accessor.count() != shape.count) {
    place.fail("has " + std::to_string(accessor.count()) + " elements beside " +
                   std::to_string(shape.count) + " positions",
               "give every attribute as many");
  }
  return accessor;
}

std::optional<Accessor> attribute(const PrimitiveElement& primitive, const DracoMesh* draco,
                                  const std::string& name, const Shape& shape) {
  const auto found = primitive->attributes.find(name);
  if (found == primitive->attributes.end()) return std::nullopt;
  return read_accessor(primitive.member("attributes").member(name), found->second, shape,
                       draco ? draco->attribute(name) : std::nullopt);
}

bool is_unsigned(const Accessor& accessor) {
  const ComponentType type = accessor.component_type();
  return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

std::optional<Accessor> read_indices(const PrimitiveElement& primitive, const DracoMesh* draco) {
  const int index = draco ? draco->index_accessor() : primitive->indices;
  if (index == -1) return std::nullopt;
  const Place place = primitive.member("indices");
  const auto element = follow(place, index, primitive.model().accessors, "accessors");
  Accessor accessor = draco ? Accessor(element, draco->indices()) : Accessor(element);
  if (accessor.components() != 1 || !is_unsigned(accessor)) {
    place.fail("are not unsigned integers", "use SCALAR with componentType 5121, 5123 or 5125");
  }
  return accessor;
}

std::vector<MorphTarget> read_targets(const PrimitiveElement& primitive, std::uint64_t count) {
  std::vector<MorphTarget> targets;
  for (std::size_t i = 0; i < primitive->targets.size(); ++i) {
    const Place place = primitive.member("targets").item(i);
    MorphTarget& target = targets.emplace_back();
    for (const auto& [name, index] : primitive->targets[i]) {
      const Place member = place.member(printable(name));
      if (name == "POSITION") target.position = read_accessor(member, index, {3, 3, count});
      if (name == "NORMAL") target.normal = read_accessor(member, index, {3, 3, count});
      if (name == "TANGENT") target.tangent = read_accessor(member, index, {3, 3, count});
      if (name.starts_with("TEXCOORD_") || name.starts_with("COLOR_")) {
        member.warn("morphed " + name, "morph targets of " + printable(name) + " are ignored");
      }
    }
  }
  return targets;
}

std::vector<Influences> read_influences(const PrimitiveElement& primitive, const DracoMesh* draco,
                                        std::uint64_t count) {
  std::vector<Influences> influences;
  for (int set = 0;; ++set) {
    const std::string joints_name = "JOINTS_" + std::to_string(set);
    const std::string weights_name = "WEIGHTS_" + std::to_string(set);
    auto joints = attribute(primitive, draco, joints_name, {4, 4, count});
    auto weights = attribute(primitive, draco, weights_name, {4, 4, count});
    if (!joints && !weights) return influences;
    const Place attributes = primitive.member("attributes");
    if (!joints || !weights) {
      attributes.fail("has one of " + joints_name + " and " + weights_name + " only",
                      "write both or none");
    }
    if (!is_unsigned(*joints)) {
      attributes.member(joints_name).fail("are not unsigned integers", "use 5121 or 5123");
    }
    influences.push_back({std::move(*joints), std::move(*weights)});
  }
}

void warn_of_unread(const PrimitiveElement& primitive) {
  const Place attributes = primitive.member("attributes");
  for (const auto& [name, unused] : primitive->attributes) {
    const bool is_read = name == "POSITION" || name == "NORMAL" || name == "TANGENT" ||
                         name == "TEXCOORD_0" || name == "TEXCOORD_1" || name == "COLOR_0" ||
                         name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
    if (is_read || name.starts_with('_')) continue;  // those are a program's own
    if (name.starts_with("COLOR_")) {
      attributes.warn("COLOR_1", "only COLOR_0 is read");
    } else if (name.starts_with("TEXCOORD_")) {
      attributes.warn("TEXCOORD_2", "only TEXCOORD_0 and TEXCOORD_1 are read");
    } else {
      attributes.warn("unknown attributes",
                      printable(name) + " is no attribute of glTF and is ignored");
    }
  }
}

std::optional<int> material_of(const PrimitiveElement& primitive) {
  if (primitive->material == -1) return std::nullopt;
  follow(primitive.member("material"), primitive->material, primitive.model().materials,
         "materials");
  return primitive->material;
}

std::optional<Primitive> read_primitive(const PrimitiveElement& element, MaterialUses& materials) {
  std::optional<Topology> topology = topology_of(element);
  if (!topology) return std::nullopt;
  warn_of_unread(element);
  if (!element->attributes.contains("POSITION")) {
    element.warn("no positions", "a primitive without POSITION is not rendered");
    return std::nullopt;
  }
  std::shared_ptr<const DracoMesh> shared;
  if (auto unpacked = DracoMesh::read(element)) {
    shared = std::make_shared<const DracoMesh>(std::move(*unpacked));
    topology = Topology::triangles;  // as which Draco keeps strips, too
  }
  const DracoMesh* const draco = shared.get();
  auto position = attribute(element, draco, "POSITION", {1, 16, 0});
  if (position->components() != 3) {
    element.member("attributes.POSITION").fail("is not of type VEC3", "write x, y, z");
  }
  const std::uint64_t count = position->count();
  Primitive primitive{element, shared, *topology, std::move(*position), {}, {}, {}, {}, {}, {},
                      {},      0,      0};
  primitive.normal = attribute(element, draco, "NORMAL", {3, 3, count});
  primitive.tangent = attribute(element, draco, "TANGENT", {4, 4, count});
  primitive.texcoords = {attribute(element, draco, "TEXCOORD_0", {2, 2, count}),
                         attribute(element, draco, "TEXCOORD_1", {2, 2, count})};
  primitive.color = attribute(element, draco, "COLOR_0", {3, 4, count});
  primitive.indices = read_indices(element, draco);
  primitive.targets = read_targets(element, count);
  primitive.influences = read_influences(element, draco, count);
  primitive.triangle_count =
      triangle_count_of(element, *topology, primitive.indices ? primitive.indices->count() : count);
  primitive.material = materials.use(material_of(element));
  return primitive;
}

}  // namespace

std::uint32_t MaterialUses::use(std::optional<int> index) {
  const auto next = static_cast<std::uint32_t>(in_order_.size());
  const auto [position, is_new] = positions_.emplace(index, next);
  if (is_new) in_order_.push_back(index);
  return position->second;
}

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

}  // namespace ppm::scene::gltf
