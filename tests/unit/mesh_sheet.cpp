#include "mesh_sheet.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace ppm::test::variants {

using nlohmann::json;

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

glm::dmat4 Stand::matrix() const {
  return glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(rotation) *
         glm::scale(glm::dmat4(1.0), scale);
}

const Stand kStands[2] = {
    {{1.5, 0.25, -0.5}, glm::normalize(glm::dquat(0.9, 0.1, 0.3, -0.2)), {1.0, 0.75, 1.5}},
    {{-1.5, -0.5, 0.25}, glm::normalize(glm::dquat(0.8, -0.3, 0.1, 0.4)), {-1.25, 1.0, 0.5}}};

json as_json(const glm::dmat4& matrix) {
  json values = json::array();
  for (int i = 0; i < 16; ++i) values.push_back(glm::value_ptr(matrix)[i]);
  return values;
}

void place_twice(GltfDocument& document, std::size_t index, const glm::dmat4& inner) {
  for (const Stand& stand : kStands) {
    document.append("nodes", {{"mesh", index}, {"matrix", as_json(stand.matrix() * inner)}});
  }
}

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

void declare(GltfDocument& document, const char* extension) {
  document.root["extensionsUsed"].push_back(extension);
  document.root["extensionsRequired"].push_back(extension);
}

}  // namespace ppm::test::variants
