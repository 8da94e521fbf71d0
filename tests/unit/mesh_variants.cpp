#include "mesh_variants.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>
#include <set>

#include "pack_mesh.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

constexpr int kColumns = 6, kRows = 4;

/// What a document is made of; positions lie in [-1,1]^3.
struct MeshData {
  std::vector<float> positions, normals, texcoords, colors;  // 3, 3, 2, 4 a vertex
  std::vector<std::uint32_t> indices;                        // of triangles

  std::size_t count() const { return positions.size() / 3; }
};

/// A wavy sheet.
MeshData sheet() {
  MeshData mesh;
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column <= kColumns; ++column) {
      const float u = static_cast<float>(column) / kColumns, v = static_cast<float>(row) / kRows;
      const glm::vec3 p(2.0f * u - 1.0f, 1.0f - 2.0f * v, 0.3f * std::sin(5.0f * u + 3.0f * v));
      const float slope = std::cos(5.0f * u + 3.0f * v);
      const glm::vec3 n = glm::normalize(glm::vec3(-0.75f * slope, 0.45f * slope, 1.0f));
      mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
      mesh.normals.insert(mesh.normals.end(), {n.x, n.y, n.z});
      mesh.texcoords.insert(mesh.texcoords.end(), {u, v});
      mesh.colors.insert(mesh.colors.end(), {u, 0.25f + 0.5f * v, 1.0f - u, 0.5f + 0.5f * v});
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * (kColumns + 1) + column, b = a + kColumns + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  }
  return mesh;
}

/// Where the two copies stand: one unevenly scaled and turned, one mirrored.
struct Stand {
  glm::dvec3 translation;
  glm::dquat rotation;
  glm::dvec3 scale;

  glm::dmat4 matrix() const {
    return glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(rotation) *
           glm::scale(glm::dmat4(1.0), scale);
  }
};

const Stand kStands[2] = {
    {{1.5, 0.25, -0.5}, glm::normalize(glm::dquat(0.9, 0.1, 0.3, -0.2)), {1.0, 0.75, 1.5}},
    {{-1.5, -0.5, 0.25}, glm::normalize(glm::dquat(0.8, -0.3, 0.1, 0.4)), {-1.25, 1.0, 0.5}}};

json as_json(const glm::dmat4& matrix) {
  json values = json::array();
  for (int i = 0; i < 16; ++i) values.push_back(glm::value_ptr(matrix)[i]);
  return values;
}

/// Appends nodes that show the mesh `index` twice, each time through `inner`.
void place_twice(GltfDocument& document, std::size_t index,
                 const glm::dmat4& inner = glm::dmat4(1.0)) {
  for (const Stand& stand : kStands) {
    document.append("nodes", {{"mesh", index}, {"matrix", as_json(stand.matrix() * inner)}});
  }
}

/// Appends a mesh without nodes and returns its only primitive.
json& add_mesh(GltfDocument& document, json attributes) {
  document.append("meshes",
                  {{"primitives", json::array({{{"attributes", std::move(attributes)}}})}});
  return document.root["meshes"].back()["primitives"][0];
}

json float_attributes(GltfDocument& document, const MeshData& mesh) {
  return {{"POSITION", document.accessor(mesh.positions, "VEC3")},
          {"NORMAL", document.accessor(mesh.normals, "VEC3")},
          {"TEXCOORD_0", document.accessor(mesh.texcoords, "VEC2")},
          {"COLOR_0", document.accessor(mesh.colors, "VEC4")}};
}

json& add_float_mesh(GltfDocument& document, const MeshData& mesh) {
  json& primitive = add_mesh(document, float_attributes(document, mesh));
  primitive["indices"] = document.accessor(mesh.indices, "SCALAR");
  return primitive;
}

using Build = std::function<void(GltfDocument&)>;

void plain(GltfDocument& document) {
  add_float_mesh(document, sheet());
  place_twice(document, 0);
}

template <typename Index>
void narrow_indices(GltfDocument& document) {
  const MeshData mesh = sheet();
  json& primitive = add_mesh(document, float_attributes(document, mesh));
  primitive["indices"] =
      document.accessor(std::vector<Index>(mesh.indices.begin(), mesh.indices.end()), "SCALAR");
  place_twice(document, 0);
}

std::vector<float> expanded(const std::vector<float>& values, std::size_t components,
                            const std::vector<std::uint32_t>& indices) {
  std::vector<float> result;
  for (const std::uint32_t index : indices) {
    const auto start = values.begin() + static_cast<std::ptrdiff_t>(index * components);
    result.insert(result.end(), start, start + static_cast<std::ptrdiff_t>(components));
  }
  return result;
}

void without_indices(GltfDocument& document) {
  MeshData mesh = sheet();
  mesh.positions = expanded(mesh.positions, 3, mesh.indices);
  mesh.normals = expanded(mesh.normals, 3, mesh.indices);
  mesh.texcoords = expanded(mesh.texcoords, 2, mesh.indices);
  mesh.colors = expanded(mesh.colors, 4, mesh.indices);
  add_mesh(document, float_attributes(document, mesh));
  place_twice(document, 0);
}

/// One strip a row.
void strips(GltfDocument& document) {
  const json attributes = float_attributes(document, sheet());
  json primitives = json::array();
  for (std::uint32_t row = 0; row < kRows; ++row) {
    std::vector<std::uint16_t> strip;
    for (std::uint32_t column = 0; column <= kColumns; ++column) {
      const auto a = static_cast<std::uint16_t>(row * (kColumns + 1) + column);
      strip.insert(strip.end(), {a, static_cast<std::uint16_t>(a + kColumns + 1)});
    }
    primitives.push_back(
        {{"attributes", attributes}, {"indices", document.accessor(strip, "SCALAR")}, {"mode", 5}});
  }
  document.append("meshes", {{"primitives", primitives}});
  place_twice(document, 0);
}

/// The rows as one strip, joined by triangles without area.
void joined_strip(GltfDocument& document) {
  std::vector<std::uint8_t> strip;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column <= kColumns; ++column) {
      const auto a = static_cast<std::uint8_t>(row * (kColumns + 1) + column);
      if (row > 0 && column == 0) strip.insert(strip.end(), {strip.back(), a});
      strip.insert(strip.end(), {a, static_cast<std::uint8_t>(a + kColumns + 1)});
    }
  }
  json& primitive = add_mesh(document, float_attributes(document, sheet()));
  primitive["indices"] = document.accessor(strip, "SCALAR");
  primitive["mode"] = 5;
  place_twice(document, 0);
}

/// One fan a quad.
void fans(GltfDocument& document) {
  const MeshData mesh = sheet();
  const json attributes = float_attributes(document, mesh);
  json primitives = json::array();
  for (std::size_t i = 0; i < mesh.indices.size(); i += 6) {
    const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    primitives.push_back(
        {{"attributes", attributes},
         {"indices", document.accessor(std::vector<std::uint32_t>{b, b + 1, c, a}, "SCALAR")},
         {"mode", 6}});
  }
  document.append("meshes", {{"primitives", primitives}});
  place_twice(document, 0);
}

void interleaved(GltfDocument& document) {
  const MeshData mesh = sheet();
  std::vector<float> all;
  for (std::size_t i = 0; i < mesh.count(); ++i) {
    for (const auto& [values, components] : {std::pair(&mesh.colors, 4),
                                             {&mesh.positions, 3},
                                             {&mesh.texcoords, 2},
                                             {&mesh.normals, 3}}) {
      for (int k = 0; k < components; ++k) {
        all.push_back(
            (*values)[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(k)]);
      }
    }
  }
  const std::size_t view = document.view(bytes_of(all));
  document.root["bufferViews"][view]["byteStride"] = 48;
  const auto part = [&](const char* type, int offset) {
    return document.append("accessors", {{"bufferView", view},
                                         {"componentType", 5126},
                                         {"type", type},
                                         {"count", mesh.count()},
                                         {"byteOffset", offset}});
  };
  json attributes = {{"COLOR_0", part("VEC4", 0)}};
  attributes["POSITION"] = part("VEC3", 16);
  attributes["TEXCOORD_0"] = part("VEC2", 28);
  attributes["NORMAL"] = part("VEC3", 36);
  add_mesh(document, attributes)["indices"] = document.accessor(mesh.indices, "SCALAR");
  place_twice(document, 0);
}

/// Every third vertex of an accessor is put right by its sparse part; without `base` all are, on
/// zeros.
void make_sparse(GltfDocument& document, std::size_t accessor, const std::vector<float>& values,
                 std::size_t components, bool base) {
  std::vector<float> right;
  std::vector<std::uint16_t> places;
  for (std::size_t i = 0; i < values.size() / components; i += base ? 3 : 1) {
    places.push_back(static_cast<std::uint16_t>(i));
    for (std::size_t k = 0; k < components; ++k) right.push_back(values[i * components + k]);
  }
  document.root["accessors"][accessor]["sparse"] = {
      {"count", places.size()},
      {"indices", {{"bufferView", document.view(bytes_of(places))}, {"componentType", 5123}}},
      {"values", {{"bufferView", document.view(bytes_of(right))}}}};
  if (!base) document.root["accessors"][accessor].erase("bufferView");
}

void sparse(GltfDocument& document, bool base) {
  const MeshData mesh = sheet();
  MeshData wrong = mesh;
  for (std::size_t i = 0; i < mesh.count(); i += 3) {
    wrong.positions[3 * i] = 77.0f;
    wrong.normals[3 * i + 1] = -5.0f;
    wrong.texcoords[2 * i] = 9.0f;
  }
  json& primitive = add_float_mesh(document, wrong);
  const json attributes = primitive["attributes"];
  make_sparse(document, attributes["POSITION"], mesh.positions, 3, base);
  make_sparse(document, attributes["NORMAL"], mesh.normals, 3, base);
  make_sparse(document, attributes["TEXCOORD_0"], mesh.texcoords, 2, base);
  place_twice(document, 0);
}

/// Values times `scale`, rounded, in elements that are padded to a multiple of four bytes.
template <typename T>
std::size_t add_quantised(GltfDocument& document, const std::vector<float>& values,
                          std::size_t components, double scale, double offset, bool normalized) {
  const std::size_t stride = (components * sizeof(T) + 3) / 4 * 4;
  const std::size_t count = values.size() / components;
  Bytes bytes(count * stride);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto code = static_cast<T>(std::lround(values[i] * scale + offset));
    const std::size_t at = i / components * stride + i % components * sizeof(T);
    std::memcpy(bytes.data() + at, &code, sizeof code);
  }
  const std::size_t view = document.view(bytes);
  document.root["bufferViews"][view]["byteStride"] = stride;
  const std::string type = "VEC" + std::to_string(components);
  return document.append("accessors", {{"bufferView", view},
                                       {"componentType", kComponentType<T>},
                                       {"type", type},
                                       {"count", count},
                                       {"normalized", normalized}});
}

void declare(GltfDocument& document, const char* extension) {
  document.root["extensionsUsed"].push_back(extension);
  document.root["extensionsRequired"].push_back(extension);
}

/// Normalised integers, positions through a node that maps [0, 1] to [-1, 1].
void quantised(GltfDocument& document) {
  const MeshData mesh = sheet();
  declare(document, "KHR_mesh_quantization");
  json attributes = {{"POSITION", add_quantised<std::uint16_t>(document, mesh.positions, 3, 32767.5,
                                                               32767.5, true)}};
  attributes["NORMAL"] = add_quantised<std::int8_t>(document, mesh.normals, 3, 127.0, 0.0, true);
  attributes["TEXCOORD_0"] =
      add_quantised<std::uint16_t>(document, mesh.texcoords, 2, 65535.0, 0.0, true);
  attributes["COLOR_0"] = add_quantised<std::uint8_t>(document, mesh.colors, 4, 255.0, 0.0, true);
  add_mesh(document, attributes)["indices"] = document.accessor(mesh.indices, "SCALAR");
  place_twice(document, 0,
              glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0)) *
                  glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)));
}

/// Plain integers: positions are multiples of 1/20000, normals of 1/32767.
void quantised_plainly(GltfDocument& document) {
  const MeshData mesh = sheet();
  declare(document, "KHR_mesh_quantization");
  json attributes = {
      {"POSITION", add_quantised<std::int16_t>(document, mesh.positions, 3, 20000.0, 0.0, false)}};
  attributes["NORMAL"] = add_quantised<std::int16_t>(document, mesh.normals, 3, 32767.0, 0.0, true);
  attributes["TEXCOORD_0"] =
      add_quantised<std::int16_t>(document, mesh.texcoords, 2, 32767.0, 0.0, true);
  attributes["COLOR_0"] =
      add_quantised<std::uint16_t>(document, mesh.colors, 4, 65535.0, 0.0, true);
  add_mesh(document, attributes)["indices"] = document.accessor(mesh.indices, "SCALAR");
  place_twice(document, 0, glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / 20000.0)));
}

/// Appends a bufferView of `bytes` that are packed, as gltfpack does it: the view itself lies in a
/// buffer that is not there.
std::size_t add_packed_view(GltfDocument& document, const Bytes& bytes, std::size_t stride,
                            const char* mode, const char* filter = "NONE") {
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

std::size_t add_packed(GltfDocument& document, const Bytes& bytes, std::size_t stride,
                       const char* type, int component_type, const char* mode = "ATTRIBUTES",
                       const char* filter = "NONE", bool normalized = false) {
  return document.append("accessors",
                         {{"bufferView", add_packed_view(document, bytes, stride, mode, filter)},
                          {"componentType", component_type},
                          {"type", type},
                          {"count", bytes.size() / stride},
                          {"normalized", normalized}});
}

/// `view` appends to buffers[0] and rewrites the array, so this comes last.
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

/// Positions by the exponential filter, normals by the octahedral one.
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

void copied(GltfDocument& document) {
  const MeshData mesh = sheet();
  for (std::size_t i = 0; i < 2; ++i) {
    add_float_mesh(document, mesh);
    document.append("nodes", {{"mesh", i}, {"matrix", as_json(kStands[i].matrix())}});
  }
}

/// Both copies by EXT_mesh_gpu_instancing, under a node that is moved and moved back by its parent.
/// With `packed` rotations are 16-bit integers in meshoptimizer's filter.
void instanced(GltfDocument& document, bool packed) {
  add_float_mesh(document, sheet());
  std::vector<float> translations, rotations, scales;
  for (const Stand& stand : kStands) {
    for (int i = 0; i < 3; ++i) {
      translations.push_back(static_cast<float>(stand.translation[i]));
      scales.push_back(static_cast<float>(stand.scale[i]));
    }
    for (const double part :
         {stand.rotation.x, stand.rotation.y, stand.rotation.z, stand.rotation.w}) {
      rotations.push_back(static_cast<float>(part));
    }
  }
  json attributes = {{"TRANSLATION", document.accessor(translations, "VEC3")},
                     {"SCALE", document.accessor(scales, "VEC3")}};
  if (packed) {
    attributes["ROTATION"] =
        add_packed(document, meshopt_filtered(as_vectors(rotations, 4), 8, "QUATERNION"), 8, "VEC4",
                   5122, "ATTRIBUTES", "QUATERNION", true);
    add_fallback_buffer(document);
  } else {
    attributes["ROTATION"] = document.accessor(rotations, "VEC4");
  }
  declare(document, "EXT_mesh_gpu_instancing");
  document.append("nodes",
                  {{"mesh", 0},
                   {"translation", {5, 6, 7}},
                   {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
  document.append("nodes", {{"children", {0}}, {"translation", {-5, -6, -7}}});
  document.root["scenes"] = {{{"nodes", {1}}}};
}

/// A skin for each copy: two joints that stand where the copy does, one half as large and bound so.
/// The nodes that show the meshes stand elsewhere, which is to be ignored.
void skinned(GltfDocument& document) {
  const MeshData mesh = sheet();
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (std::size_t i = 0; i < mesh.count(); ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(mesh.count());
    joints.insert(joints.end(), {1, 0, 0, 0});
    weights.insert(weights.end(), {share, 1.0f - share, 0.0f, 0.0f});
  }
  json& primitive = add_float_mesh(document, mesh);
  primitive["attributes"]["JOINTS_0"] = document.accessor(joints, "VEC4");
  primitive["attributes"]["WEIGHTS_0"] = document.accessor(weights, "VEC4");
  std::vector<float> binds;
  for (const float scale : {1.0f, 2.0f}) {
    const glm::mat4 bind = glm::scale(glm::mat4(1.0f), glm::vec3(scale));
    binds.insert(binds.end(), glm::value_ptr(bind), glm::value_ptr(bind) + 16);
  }
  const std::size_t matrices =
      document.append("accessors", {{"bufferView", document.view(bytes_of(binds))},
                                    {"componentType", 5126},
                                    {"type", "MAT4"},
                                    {"count", 2}});
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t first = 3 * i;  // joint, joint in it, mesh
    document.append("nodes", {{"matrix", as_json(kStands[i].matrix())}, {"children", {first + 1}}});
    document.append("nodes", {{"scale", {0.5, 0.5, 0.5}}});
    document.append("nodes", {{"mesh", 0}, {"skin", i}, {"translation", {50, 60, 70}}});
    document.append("skins", {{"joints", {first, first + 1}}, {"inverseBindMatrices", matrices}});
  }
}

/// Joints without inverse bind matrices, and four more influences a vertex.
void skinned_by_eight(GltfDocument& document) {
  const MeshData mesh = sheet();
  const std::vector<std::uint16_t> joints(4 * mesh.count(), 0);
  const std::vector<std::uint8_t> first(4 * mesh.count(), 51), second(4 * mesh.count(), 0);
  std::vector<std::uint8_t> rest = second;
  for (std::size_t i = 0; i < rest.size(); i += 4) rest[i + 3] = 51;
  json& primitive = add_float_mesh(document, mesh);
  primitive["attributes"]["JOINTS_0"] = primitive["attributes"]["JOINTS_1"] =
      document.accessor(joints, "VEC4");
  primitive["attributes"]["WEIGHTS_0"] = document.accessor(first, "VEC4", true);
  primitive["attributes"]["WEIGHTS_1"] = document.accessor(rest, "VEC4", true);
  for (std::size_t i = 0; i < 2; ++i) {
    document.append("nodes", {{"matrix", as_json(kStands[i].matrix())}});
    document.append("nodes", {{"mesh", 0}, {"skin", i}});
    document.append("skins", {{"joints", {2 * i}}});
  }
}

/// Two targets that bring a bent sheet back, one sparse; the node's weights win over the mesh's.
void morphed(GltfDocument& document) {
  const MeshData mesh = sheet();
  MeshData bent = mesh;
  std::vector<float> positions(mesh.positions.size(), 0.0f), normals = positions,
                                                             sparse = positions;
  for (std::size_t i = 0; i < mesh.count(); ++i) {
    const float bend = 0.25f * static_cast<float>(i % 4);
    bent.positions[3 * i + 2] += bend;
    positions[3 * i + 2] = -0.5f * bend;
    bent.normals[3 * i] += 0.5f;
    normals[3 * i] = -0.25f;
    if (i % 3 != 0) continue;
    bent.positions[3 * i] -= 2.0f;
    sparse[3 * i] = 0.5f;
  }
  json& primitive = add_float_mesh(document, bent);
  const json first = {{"POSITION", document.accessor(positions, "VEC3")},
                      {"NORMAL", document.accessor(normals, "VEC3")}};
  const json second = {{"POSITION", document.accessor(std::vector<float>(sparse.size()), "VEC3")}};
  make_sparse(document, second["POSITION"], sparse, 3, true);
  primitive["targets"] = {first, second};
  document.root["meshes"][0]["weights"] = {0.3, -7.0};
  place_twice(document, 0);
  for (json& node : document.root["nodes"]) node["weights"] = {2.0, 4.0};
}

std::filesystem::path write(const TemporaryFolder& folder, GltfDocument document,
                            const std::string& container) {
  if (document.root.contains("materials")) {
    for (json& mesh : document.root["meshes"]) {
      for (json& primitive : mesh["primitives"]) {
        if (!primitive.contains("material")) primitive["material"] = 0;
      }
    }
  }
  if (container == "glb") {
    document.write_glb(folder / "scene.glb");
    return folder / "scene.glb";
  }
  if (container == "bin") {
    std::filesystem::create_directory(folder / "a b");
    write_file(folder / "a b/mesh.bin", document.binary);
    document.root["buffers"][0]["uri"] = "a%20b/mesh.bin";
  }
  document.write_gltf(folder / "scene.gltf");
  return folder / "scene.gltf";
}

MeshVariant variant(std::string name, Build build, Precision precision = {},
                    const char* container = "uri") {
  return {std::move(name),
          [build = std::move(build), container = std::string(container)](
              const TemporaryFolder& folder, const std::function<void(GltfDocument&)>& furnish) {
            GltfDocument document;
            build(document);
            if (furnish) furnish(document);
            return write(folder, std::move(document), container);
          },
          precision};
}

template <typename... Arguments>
Build with(void (*build)(GltfDocument&, Arguments...), Arguments... arguments) {
  return [=](GltfDocument& document) { build(document, arguments...); };
}

}  // namespace

std::vector<MeshVariant> mesh_variants() {
  // Half a step of what is rounded, and what the uneven scales make of it in normals.
  const Precision fine{2.0 / 65535.0, 0.02, 1.0 / 65535.0, 0.5 / 255.0 + 1e-6};
  const Precision plain_steps{1.0 / 20000.0, 1e-4, 1.0 / 32767.0, 1.0 / 65535.0};
  const Precision filters{1e-6, 3e-4, 1e-6, 1e-6};
  const Precision draco{2.0 / 4096.0, 3e-3, 1.0 / 4096.0, 1.0 / 4096.0};
  const Precision turned{1e-4, 1e-4, 1e-6, 1e-6};
  return {
      variant("plain", plain),
      variant("in a .glb", plain, {}, "glb"),
      variant("in a .bin beside", plain, {}, "bin"),
      variant("8-bit indices", narrow_indices<std::uint8_t>),
      variant("16-bit indices", narrow_indices<std::uint16_t>),
      variant("without indices", without_indices),
      variant("strips", strips),
      variant("one strip", joined_strip),
      variant("fans", fans),
      variant("interleaved", interleaved),
      variant("sparse", with(sparse, true)),
      variant("sparse on zeros", with(sparse, false)),
      variant("quantised", quantised, fine),
      variant("quantised, not normalised", quantised_plainly, plain_steps),
      variant("meshopt", with(packed_by_meshopt, "TRIANGLES")),
      variant("meshopt, sequence of indices", with(packed_by_meshopt, "INDICES"), {}, "glb"),
      variant("meshopt, filtered", filtered_by_meshopt, filters),
      variant("Draco", with(packed_by_draco, false, 12), draco, "glb"),
      variant("Draco, sequential and exact", with(packed_by_draco, true, 0)),
      variant("copied", copied),
      variant("instanced", with(instanced, false)),
      variant("instanced, filtered by meshopt", with(instanced, true), turned),
      variant("skinned", skinned),
      variant("skinned by eight", skinned_by_eight),
      variant("morphed", morphed),
  };
}

}  // namespace ppm::test
