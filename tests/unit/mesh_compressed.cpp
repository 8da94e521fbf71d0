// The sheet as meshoptimizer and Draco pack it.
#include "mesh_sheet.hpp"
#include "pack_mesh.hpp"

namespace ppm::test::variants {

using nlohmann::json;

namespace {

/// Appends a bufferView of `bytes` that are packed, as gltfpack does it: the view itself lies in a
/// buffer that is not there.
std::size_t add_packed_view(GltfDocument& document, const Bytes& bytes, std::size_t stride,
                            const char* mode, const char* filter) {
  const std::size_t stream = document.view(meshopt_packed(bytes, stride, mode));
  const json packed = document.root["bufferViews"][stream];
  json view = {{"buffer", 1}, {"byteLength", bytes.size()}};
  if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = stride;
  view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                   {"byteOffset", packed["byteOffset"]},
                                                   {"byteLength", packed["byteLength"]},
                                                   {"byteStride", stride},
                                                   {"count", bytes.size() / stride},
                                                   {"mode", mode},
                                                   {"filter", filter}};
  return document.append("bufferViews", view);
}

}  // namespace

std::size_t add_packed(GltfDocument& document, const Bytes& bytes, std::size_t stride,
                       const char* type, int component_type, const char* mode, const char* filter,
                       bool normalized) {
  return document.append("accessors",
                         {{"bufferView", add_packed_view(document, bytes, stride, mode, filter)},
                          {"componentType", component_type},
                          {"type", type},
                          {"count", bytes.size() / stride},
                          {"normalized", normalized}});
}

void add_fallback_buffer(GltfDocument& document) {
  declare(document, "EXT_meshopt_compression");
  document.root["buffers"].push_back(
      {{"byteLength", 1 << 20},
       {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
}

void packed_by_meshopt(GltfDocument& document, const char* index_mode) {
  const MeshData mesh = sheet();
  json attributes = {{"POSITION", add_packed(document, bytes_of(mesh.positions), 12, "VEC3", 5126)},
                     {"NORMAL", add_packed(document, bytes_of(mesh.normals), 12, "VEC3", 5126)}};
  attributes["TEXCOORD_0"] = add_packed(document, bytes_of(mesh.texcoords), 8, "VEC2", 5126);
  attributes["COLOR_0"] = add_packed(document, bytes_of(mesh.colors), 16, "VEC4", 5126);
  const std::vector<std::uint16_t> indices(mesh.indices.begin(), mesh.indices.end());
  add_mesh(document, attributes)["indices"] =
      add_packed(document, bytes_of(indices), 2, "SCALAR", 5123, index_mode);
  place_twice(document, 0);
  add_fallback_buffer(document);
}

std::vector<glm::vec4> as_vectors(const std::vector<float>& values, std::size_t components) {
  std::vector<glm::vec4> vectors(values.size() / components, glm::vec4(0.0f));
  for (std::size_t i = 0; i < values.size(); ++i) {
    vectors[i / components][static_cast<glm::length_t>(i % components)] = values[i];
  }
  return vectors;
}

void filtered_by_meshopt(GltfDocument& document) {
  const MeshData mesh = sheet();
  json attributes = float_attributes(document, mesh);
  attributes["POSITION"] =
      add_packed(document, meshopt_filtered(as_vectors(mesh.positions, 3), 12, "EXPONENTIAL"), 12,
                 "VEC3", 5126, "ATTRIBUTES", "EXPONENTIAL");
  attributes["NORMAL"] =
      add_packed(document, meshopt_filtered(as_vectors(mesh.normals, 3), 8, "OCTAHEDRAL"), 8,
                 "VEC3", 5122, "ATTRIBUTES", "OCTAHEDRAL", true);
  add_mesh(document, attributes)["indices"] =
      add_packed(document, bytes_of(mesh.indices), 4, "SCALAR", 5125, "TRIANGLES");
  place_twice(document, 0);
  add_fallback_buffer(document);
}

void packed_by_draco(GltfDocument& document, bool sequential, int bits) {
  const MeshData mesh = sheet();
  DracoInput input;
  input.attributes = {{"POSITION", mesh.positions},
                      {"NORMAL", mesh.normals},
                      {"TEXCOORD_0", mesh.texcoords},
                      {"COLOR_0", mesh.colors}};
  input.components = {{"POSITION", 3}, {"NORMAL", 3}, {"TEXCOORD_0", 2}, {"COLOR_0", 4}};
  input.indices = mesh.indices;
  const DracoOutput packed = draco_packed(input, sequential, bits);
  json attributes;
  for (const auto& [name, number] : packed.attributes) {
    attributes[name] =
        document.append("accessors", {{"componentType", 5126},
                                      {"type", "VEC" + std::to_string(input.components.at(name))},
                                      {"count", packed.vertices}});
  }
  const std::size_t indices = document.append(
      "accessors", {{"componentType", 5123}, {"type", "SCALAR"}, {"count", 3 * packed.triangles}});
  json& primitive = add_mesh(document, attributes);
  primitive["indices"] = indices;
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", document.view(packed.stream)}, {"attributes", packed.attributes}};
  declare(document, "KHR_draco_mesh_compression");
  place_twice(document, 0);
}

}  // namespace ppm::test::variants
