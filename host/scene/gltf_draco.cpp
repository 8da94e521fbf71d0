#include "gltf_draco.hpp"

#include <draco/compression/decode.h>

#include <exception>
#include <new>

#include "gltf_draco_header.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr const char* kName = "KHR_draco_mesh_compression";
constexpr const char* kRemedy = "compress the file again";
// Draco's entropy coder has no lowest cost of a face. Real meshes take a byte or so; regular grids
// have been seen to take a hundredth.
constexpr std::uint64_t kMostFacesAByte = 256, kSmall = 1 << 16;
constexpr std::uint64_t kMostSeams = 32;
constexpr std::uint64_t kMostFaces = std::uint64_t{1} << 25;

/// What the stream claims, in so far as it can be true.
DracoSizes checked_sizes(const Place& place, ByteView stream) {
  const std::optional<DracoSizes> sizes = draco_sizes(stream);
  if (!sizes) place.fail("is not a mesh of Draco 2.2", kRemedy);
  const std::uint64_t most = std::min(kMostFaces, kSmall + kMostFacesAByte * stream.size());
  if (sizes->faces == 0 || sizes->faces > most || sizes->seams > kMostSeams) {
    place.fail("claims " + std::to_string(sizes->faces) + " triangles in " +
                   std::to_string(stream.size()) + " bytes",
               kRemedy);
  }
  return *sizes;
}

std::unique_ptr<draco::Mesh> decode(const Place& place, ByteView stream) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  std::string problem;
  try {
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (result.ok()) return std::move(result).value();
    problem = result.status().error_msg_string();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {  // vectors of absurd lengths
    problem = exception.what();
  }
  place.fail("its Draco stream is corrupt: " + printable(problem), kRemedy);
}

/// The values of all points as the accessor's type.
template <typename T>
bool convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components,
             std::vector<std::uint8_t>& out) {
  std::array<T, 16> values{};
  std::uint8_t* at = out.data();
  const std::size_t size = static_cast<std::size_t>(components) * sizeof(T);
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point, at += size) {
    const draco::AttributeValueIndex value = attribute.mapped_index(point);
    if (value.value() >= attribute.size()) return false;
    if (!attribute.ConvertValue(value, static_cast<std::int8_t>(components), values.data())) {
      return false;
    }
    std::memcpy(at, values.data(), size);
  }
  return true;
}

bool convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute, ComponentType type,
             int components, std::vector<std::uint8_t>& out) {
  switch (type) {
    case ComponentType::i8:
      return convert<std::int8_t>(mesh, attribute, components, out);
    case ComponentType::u8:
      return convert<std::uint8_t>(mesh, attribute, components, out);
    case ComponentType::i16:
      return convert<std::int16_t>(mesh, attribute, components, out);
    case ComponentType::u16:
      return convert<std::uint16_t>(mesh, attribute, components, out);
    case ComponentType::u32:
      return convert<std::uint32_t>(mesh, attribute, components, out);
    case ComponentType::f32:
      return convert<float>(mesh, attribute, components, out);
  }
  return false;
}

Element<tinygltf::Accessor> accessor_of(const Place& reference, int index) {
  return follow(reference, index, reference.model().accessors, "accessors");
}

void check_count(const Element<tinygltf::Accessor>& accessor, std::uint64_t actual,
                 const char* things) {
  if (accessor->count == actual) return;
  accessor.member("count").fail("is " + std::to_string(accessor->count) + " beside " +
                                    std::to_string(actual) + ' ' + things + " in the Draco stream",
                                kRemedy);
}

std::uint64_t element_bytes(const Element<tinygltf::Accessor>& accessor) {
  const Accessor layout(accessor, {});
  return size_of(layout.component_type()) * static_cast<std::uint64_t>(layout.components());
}

/// An attribute of the primitive that is in the stream.
struct Packed {
  std::string name;
  int number;  ///< in the stream
  Place reference;
  Element<tinygltf::Accessor> accessor;
};

std::vector<Packed> packed_attributes(const Element<tinygltf::Primitive>& primitive,
                                      const Extension& extension) {
  std::vector<Packed> list;
  for (const auto& [name, number] : extension.indices("attributes")) {
    const auto attribute = primitive->attributes.find(name);
    if (attribute == primitive->attributes.end()) continue;
    const Place reference = primitive.member("attributes").member(printable(name));
    list.push_back({name, number, reference, accessor_of(reference, attribute->second)});
  }
  return list;
}

/// Before any of it is unpacked. The decoder keeps faces, what is opposite of each corner, and
/// values as they are in the stream and as they come out.
void claim(std::uint64_t faces, const Element<tinygltf::Accessor>& indices,
           const std::vector<Packed>& attributes) {
  constexpr std::uint64_t kDecoderBytesAFace = 64;
  std::uint64_t bytes = 3 * faces * element_bytes(indices);
  for (const Packed& packed : attributes) {
    // The stream has no more points than its faces have corners, whatever the accessor says.
    const std::uint64_t points = std::min<std::uint64_t>(packed.accessor->count, 3 * faces);
    bytes += points * element_bytes(packed.accessor);
  }
  indices.document().claim_decoded(bytes, kDecoderBytesAFace * faces + 2 * bytes);
}

std::vector<std::uint8_t> unpack_attribute(const Packed& packed, const draco::Mesh& mesh) {
  const draco::PointAttribute* const attribute =
      mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(packed.number));
  if (!attribute) packed.reference.fail("is not in the Draco stream", kRemedy);
  check_count(packed.accessor, mesh.num_points(), "vertices");
  const Accessor layout(packed.accessor, {});
  std::vector<std::uint8_t> bytes(mesh.num_points() * element_bytes(packed.accessor));
  if (attribute->num_components() < layout.components() ||
      !convert(mesh, *attribute, layout.component_type(), layout.components(), bytes)) {
    packed.reference.fail("does not agree with its Draco stream", kRemedy);
  }
  return bytes;
}

/// In the type that the accessor asks for.
std::vector<std::uint8_t> unpack_indices(const Element<tinygltf::Accessor>& accessor,
                                         const draco::Mesh& mesh) {
  const Accessor layout(accessor, {});
  const std::uint64_t size = size_of(layout.component_type());
  if (size < 4 && mesh.num_points() - 1 >= std::uint64_t{1} << (8 * size)) {
    accessor.member("componentType").fail("is too short for its Draco stream", "use 5125");
  }
  std::vector<std::uint8_t> bytes(3 * size * mesh.num_faces());
  std::uint8_t* at = bytes.data();
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
    for (const draco::PointIndex& point : mesh.face(face)) {
      const std::uint32_t value = point.value();  // little-endian, as the hosts of Vulkan
      std::memcpy(at, &value, size);
      at += size;
    }
  }
  return bytes;
}

}  // namespace

std::optional<DracoMesh> DracoMesh::read(const Element<tinygltf::Primitive>& primitive) {
  const auto extension = Extension::find(primitive, primitive->extensions, kName);
  if (!extension) return std::nullopt;
  const auto view = follow(extension->member("bufferView"), extension->index("bufferView"),
                           primitive.model().bufferViews, "bufferViews");
  // See gltf_mending.hpp.
  const int index = extension->has("indices") ? extension->index("indices") : primitive->indices;
  if (index == -1) primitive.fail("is compressed, but has no indices", kRemedy);
  const auto indices = accessor_of(primitive.member("indices"), index);
  const ByteView stream = bytes_of(view);
  const std::uint64_t faces = checked_sizes(*extension, stream).faces;
  check_count(indices, 3 * faces, "corners");
  const std::vector<Packed> attributes = packed_attributes(primitive, *extension);
  claim(faces, indices, attributes);
  const std::unique_ptr<draco::Mesh> mesh = decode(*extension, stream);
  check_count(indices, 3 * std::uint64_t{mesh->num_faces()}, "corners");

  DracoMesh result;
  result.index_accessor_ = index;
  result.indices_ = unpack_indices(indices, *mesh);
  for (const Packed& packed : attributes) {
    result.attributes_[packed.name] = unpack_attribute(packed, *mesh);
  }
  return result;
}

std::optional<ByteView> DracoMesh::attribute(const std::string& name) const {
  const auto found = attributes_.find(name);
  if (found == attributes_.end()) return std::nullopt;
  return ByteView(found->second);
}

}  // namespace ppm::scene::gltf
