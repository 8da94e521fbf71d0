#include "gltf_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace ppm::test {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126, kUnsignedInt = 5125;            // glTF accessor.componentType
constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;  // glTF bufferView.target

json as_json(glm::dvec3 v) {
  return json::array({v.x, v.y, v.z});
}

json as_json(const glm::dmat4& m) {
  json values = json::array();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) values.push_back(m[column][row]);
  return values;
}

/// Looks along its -Z from `eye` towards `direction`, as glTF's cameras and lights do.
glm::dmat4 looking(glm::dvec3 eye, glm::dvec3 direction, glm::dvec3 up) {
  const glm::dvec3 back = -glm::normalize(direction);
  if (glm::length(glm::cross(up, back)) < 1e-9 * glm::length(up)) up = {back.y, back.z, back.x};
  const glm::dvec3 right = glm::normalize(glm::cross(up, back));
  return {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(back, 0.0),
          glm::dvec4(eye, 1.0)};
}

void append_word(std::vector<std::uint8_t>& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

void append_chunk(std::vector<std::uint8_t>& bytes, std::uint32_t type,
                  std::vector<std::uint8_t> data, std::uint8_t padding) {
  data.resize((data.size() + 3) / 4 * 4, padding);
  append_word(bytes, static_cast<std::uint32_t>(data.size()));
  append_word(bytes, type);
  bytes.insert(bytes.end(), data.begin(), data.end());
}

/// Icosahedron: the 12 points (0, ±1, ±phi) and their cyclic shifts, scaled to the unit sphere.
Mesh icosahedron() {
  Mesh mesh;
  const float a = 1.0f / std::sqrt(1.0f + std::numbers::phi_v<float> * std::numbers::phi_v<float>);
  const float b = std::numbers::phi_v<float> * a;
  mesh.positions = {{-a, b, 0},  {a, b, 0},  {-a, -b, 0}, {a, -b, 0}, {0, -a, b},  {0, a, b},
                    {0, -a, -b}, {0, a, -b}, {b, 0, -a},  {b, 0, a},  {-b, 0, -a}, {-b, 0, a}};
  mesh.indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                  4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                  6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  return mesh;
}

Mesh subdivided(const Mesh& coarse) {
  Mesh fine;
  fine.positions = coarse.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] = middles.try_emplace(
        {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(fine.positions.size()));
    if (is_new) fine.positions.push_back(glm::normalize(fine.positions[a] + fine.positions[b]));
    return entry->second;
  };
  for (std::size_t i = 0; i < coarse.indices.size(); i += 3) {
    const std::uint32_t a = coarse.indices[i], b = coarse.indices[i + 1], c = coarse.indices[i + 2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    const auto triangles = {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca};
    fine.indices.insert(fine.indices.end(), triangles);
  }
  return fine;
}

}  // namespace

Mesh quad(glm::vec3 corner, glm::vec3 edge_u, glm::vec3 edge_v) {
  Mesh mesh;
  mesh.positions = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

Mesh box(glm::vec3 low, glm::vec3 high) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.positions.emplace_back((corner & 1) != 0 ? high.x : low.x,
                                (corner & 2) != 0 ? high.y : low.y,
                                (corner & 4) != 0 ? high.z : low.z);
  mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return mesh;
}

Mesh icosphere(unsigned subdivisions, Shading shading) {
  Mesh mesh = icosahedron();
  for (unsigned i = 0; i < subdivisions; ++i) mesh = subdivided(mesh);
  if (shading == Shading::smooth) mesh.normals = mesh.positions;
  return mesh;
}

Mesh disc(unsigned segments) {
  Mesh mesh;
  mesh.positions.emplace_back(0.0f);
  for (unsigned i = 0; i < segments; ++i) {
    const float angle =
        2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(segments);
    mesh.positions.emplace_back(std::sin(angle), 0.0f, std::cos(angle));
    const auto triangle = {0u, i + 1, (i + 1) % segments + 1};
    mesh.indices.insert(mesh.indices.end(), triangle);
  }
  return mesh;
}

Mesh inside_out(Mesh mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  for (glm::vec3& normal : mesh.normals) normal = -normal;
  return mesh;
}

glm::dmat4 placed(glm::dvec3 position, double scale) {
  glm::dmat4 transform(scale);
  transform[3] = glm::dvec4(position, 1.0);
  return transform;
}

json lambert(glm::dvec3 albedo) {
  return {{"pbrMetallicRoughness",
           {{"baseColorFactor", {albedo.x, albedo.y, albedo.z, 1.0}}, {"metallicFactor", 0.0}}},
          {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0.0}}}}}};
}

json with_emission(json material, glm::dvec3 radiance) {
  const double strength = std::max({radiance.x, radiance.y, radiance.z, 1.0});
  material["emissiveFactor"] = as_json(radiance / strength);
  material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
  return material;
}

json emitter(glm::dvec3 radiance) {
  return with_emission(lambert(glm::dvec3(0.0)), radiance);
}

json metal(glm::dvec3 color, double roughness) {
  return {{"pbrMetallicRoughness",
           {{"baseColorFactor", {color.x, color.y, color.z, 1.0}},
            {"metallicFactor", 1.0},
            {"roughnessFactor", roughness}}}};
}

json thin_glass(double ior, glm::dvec3 tint) {
  json material = metal(tint, 0.0);
  material["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
  material["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}},
                            {"KHR_materials_ior", {{"ior", ior}}}};
  return material;
}

json glass(double ior, glm::dvec3 attenuation_color, std::optional<double> attenuation_distance) {
  json material = thin_glass(ior);
  json volume = {{"thicknessFactor", 1.0}};
  if (attenuation_distance) {
    volume["attenuationColor"] = as_json(attenuation_color);
    volume["attenuationDistance"] = *attenuation_distance;
  }
  material["extensions"]["KHR_materials_volume"] = std::move(volume);
  return material;
}

GltfWriter::GltfWriter()
    : document_{{"asset", {{"version", "2.0"}}},
                {"scene", 0},
                {"scenes", json::array({{{"nodes", json::array()}}})}} {}

void GltfWriter::declare(const std::string& extension) {
  json& used = document_["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

std::size_t GltfWriter::material(json material) {
  if (material.contains("extensions"))
    for (const auto& [extension, content] : material["extensions"].items()) declare(extension);
  document_["materials"].push_back(std::move(material));
  return document_["materials"].size() - 1;
}

template <class Vector>
std::size_t GltfWriter::accessor(const std::vector<Vector>& values, std::string_view type,
                                 int target) {
  const std::size_t offset = binary_.size(), bytes = values.size() * sizeof(Vector);
  binary_.resize(offset + bytes);
  std::memcpy(binary_.data() + offset, values.data(), bytes);
  document_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", target}});
  document_["accessors"].push_back(
      {{"bufferView", document_["bufferViews"].size() - 1},
       {"componentType", target == kArrayBuffer ? kFloat : kUnsignedInt},
       {"count", values.size()},
       {"type", type}});
  return document_["accessors"].size() - 1;
}

void GltfWriter::mesh(const Mesh& mesh, std::size_t material, const glm::dmat4& transform) {
  const std::size_t count = mesh.positions.size();
  const auto fits = [count](const auto& attribute) {
    return attribute.empty() || attribute.size() == count;
  };
  if (count == 0 || mesh.indices.empty() || mesh.indices.size() % 3 != 0 ||
      *std::max_element(mesh.indices.begin(), mesh.indices.end()) >= count || !fits(mesh.normals) ||
      !fits(mesh.texcoords) || !fits(mesh.colors))
    throw std::invalid_argument(
        "a mesh needs whole triangles of known corners, and an attribute "
        "none or one value per corner");

  json primitive = {{"material", material}};
  const std::size_t positions = accessor(mesh.positions, "VEC3", kArrayBuffer);
  glm::dvec3 low(mesh.positions[0]), high(mesh.positions[0]);
  for (const glm::vec3& position : mesh.positions) {
    low = glm::min(low, glm::dvec3(position));
    high = glm::max(high, glm::dvec3(position));
  }
  document_["accessors"][positions]["min"] = as_json(low);
  document_["accessors"][positions]["max"] = as_json(high);
  json& attributes = primitive["attributes"];
  attributes["POSITION"] = positions;
  if (!mesh.normals.empty()) attributes["NORMAL"] = accessor(mesh.normals, "VEC3", kArrayBuffer);
  if (!mesh.texcoords.empty())
    attributes["TEXCOORD_0"] = accessor(mesh.texcoords, "VEC2", kArrayBuffer);
  if (!mesh.colors.empty()) attributes["COLOR_0"] = accessor(mesh.colors, "VEC3", kArrayBuffer);
  primitive["indices"] = accessor(mesh.indices, "SCALAR", kElementBuffer);
  document_["meshes"].push_back({{"primitives", json::array({primitive})}});
  node({{"mesh", document_["meshes"].size() - 1}}, transform);
}

void GltfWriter::node(json node, const glm::dmat4& transform) {
  if (transform != glm::dmat4(1.0)) node["matrix"] = as_json(transform);
  document_["nodes"].push_back(std::move(node));
  document_["scenes"][0]["nodes"].push_back(document_["nodes"].size() - 1);
}

void GltfWriter::camera(std::string_view name, glm::dvec3 eye, glm::dvec3 target, double yfov,
                        std::optional<double> aspect, glm::dvec3 up) {
  json perspective = {{"yfov", yfov}, {"znear", 0.01}};
  if (aspect) perspective["aspectRatio"] = *aspect;
  document_["cameras"].push_back(
      {{"name", name}, {"type", "perspective"}, {"perspective", perspective}});
  node({{"name", name}, {"camera", document_["cameras"].size() - 1}},
       looking(eye, target - eye, up));
}

void GltfWriter::light(json light, const glm::dmat4& transform) {
  const std::string extension = "KHR_lights_punctual";
  declare(extension);
  json& lights = document_["extensions"][extension]["lights"];
  lights.push_back(std::move(light));
  json node_with_light;
  node_with_light["extensions"][extension]["light"] = lights.size() - 1;
  node(std::move(node_with_light), transform);
}

void GltfWriter::point_light(glm::dvec3 position, glm::dvec3 color, double intensity) {
  light({{"type", "point"}, {"color", as_json(color)}, {"intensity", intensity}}, placed(position));
}

void GltfWriter::spot_light(glm::dvec3 position, glm::dvec3 direction, glm::dvec3 color,
                            double intensity, double inner_cone_angle, double outer_cone_angle) {
  light({{"type", "spot"},
         {"color", as_json(color)},
         {"intensity", intensity},
         {"spot", {{"innerConeAngle", inner_cone_angle}, {"outerConeAngle", outer_cone_angle}}}},
        looking(position, direction, {0.0, 1.0, 0.0}));
}

void GltfWriter::directional_light(glm::dvec3 direction, glm::dvec3 color, double irradiance) {
  light({{"type", "directional"}, {"color", as_json(color)}, {"intensity", irradiance}},
        looking(glm::dvec3(0.0), direction, {0.0, 1.0, 0.0}));
}

void GltfWriter::write(const std::filesystem::path& file) const {
  json document = document_;
  if (!binary_.empty())
    document["buffers"] = json::array({{{"byteLength", (binary_.size() + 3) / 4 * 4}}});
  const std::string text = document.dump();

  std::vector<std::uint8_t> chunks;
  append_chunk(chunks, 0x4E4F534A, {text.begin(), text.end()}, ' ');
  if (!binary_.empty()) append_chunk(chunks, 0x004E4942, binary_, 0);
  std::vector<std::uint8_t> glb;
  append_word(glb, 0x46546C67);  // "glTF"
  append_word(glb, 2);
  append_word(glb, static_cast<std::uint32_t>(12 + chunks.size()));
  glb.insert(glb.end(), chunks.begin(), chunks.end());

  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace ppm::test
