#include "pack_mesh.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <meshoptimizer.h>

#include <cstring>
#include <stdexcept>

namespace ppm::test {

std::vector<std::uint8_t> meshopt_packed(const std::vector<std::uint8_t>& bytes, std::size_t stride,
                                         const std::string& mode) {
  const std::size_t count = bytes.size() / stride;
  std::vector<std::uint8_t> packed;
  if (mode == "ATTRIBUTES") {
    packed.resize(meshopt_encodeVertexBufferBound(count, stride));
    packed.resize(
        meshopt_encodeVertexBuffer(packed.data(), packed.size(), bytes.data(), count, stride));
    return packed;
  }
  std::vector<unsigned> indices(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&indices[i], bytes.data() + i * stride, stride);  // little-endian
  }
  meshopt_encodeIndexVersion(1);
  if (mode == "TRIANGLES") {
    packed.resize(meshopt_encodeIndexBufferBound(count, 1u << 20));
    packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), count));
  } else {
    packed.resize(meshopt_encodeIndexSequenceBound(count, 1u << 20));
    packed.resize(meshopt_encodeIndexSequence(packed.data(), packed.size(), indices.data(), count));
  }
  return packed;
}

std::vector<std::uint8_t> meshopt_filtered(const std::vector<glm::vec4>& values, std::size_t stride,
                                           const std::string& filter) {
  std::vector<std::uint8_t> bytes(values.size() * stride);
  if (filter == "OCTAHEDRAL") {
    meshopt_encodeFilterOct(bytes.data(), values.size(), stride, stride == 4 ? 8 : 16,
                            &values[0].x);
  } else if (filter == "QUATERNION") {
    meshopt_encodeFilterQuat(bytes.data(), values.size(), stride, 16, &values[0].x);
  } else {
    std::vector<float> flat;
    for (const glm::vec4& value : values) {
      for (std::size_t i = 0; i < stride / 4; ++i) {
        flat.push_back(value[static_cast<glm::length_t>(i)]);
      }
    }
    meshopt_encodeFilterExp(bytes.data(), values.size(), stride, 23, flat.data());
  }
  return bytes;
}

namespace {

draco::GeometryAttribute::Type type_of(const std::string& name) {
  if (name == "POSITION") return draco::GeometryAttribute::POSITION;
  if (name == "NORMAL") return draco::GeometryAttribute::NORMAL;
  if (name.starts_with("TEXCOORD")) return draco::GeometryAttribute::TEX_COORD;
  if (name.starts_with("COLOR")) return draco::GeometryAttribute::COLOR;
  return draco::GeometryAttribute::GENERIC;
}

}  // namespace

DracoOutput draco_packed(const DracoInput& input, bool sequential, int bits) {
  draco::Mesh mesh;
  mesh.SetNumFaces(input.indices.size() / 3);
  for (std::uint32_t face = 0; face < mesh.num_faces(); ++face) {
    const std::uint32_t* const corners = input.indices.data() + std::size_t{3} * face;
    mesh.SetFace(draco::FaceIndex(face),
                 {draco::PointIndex(corners[0]), draco::PointIndex(corners[1]),
                  draco::PointIndex(corners[2])});
  }
  DracoOutput output;
  std::vector<int> ids;
  for (const auto& [name, values] : input.attributes) {
    const int components = input.components.at(name);
    const auto size = static_cast<std::size_t>(components);
    const auto count = static_cast<std::uint32_t>(values.size() / size);
    mesh.set_num_points(count);
    draco::GeometryAttribute attribute;
    attribute.Init(type_of(name), nullptr, static_cast<std::int8_t>(components), draco::DT_FLOAT32,
                   false, 4 * components, 0);
    const int id = mesh.AddAttribute(attribute, true, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i * size]);
    }
    ids.push_back(id);
    output.attributes[name] = static_cast<int>(mesh.attribute(id)->unique_id());
  }
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                       : draco::MESH_EDGEBREAKER_ENCODING);
  for (const int id : ids) {
    if (bits > 0) encoder.SetAttributeQuantization(id, bits);
  }
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) throw std::runtime_error("Draco cannot pack this");
  output.stream.assign(buffer.data(), buffer.data() + buffer.size());
  // Packing may split and merge vertices.
  draco::DecoderBuffer packed;
  packed.Init(buffer.data(), buffer.size());
  draco::Decoder decoder;
  const auto decoded = decoder.DecodeMeshFromBuffer(&packed);
  output.vertices = decoded.value()->num_points();
  output.triangles = decoded.value()->num_faces();
  return output;
}

}  // namespace ppm::test
