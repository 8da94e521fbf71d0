// The sheet twice by copies, instances, skins and morph targets.
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "mesh_sheet.hpp"
#include "pack_mesh.hpp"

namespace ppm::test::variants {

using nlohmann::json;

void copied(GltfDocument& document) {
  const MeshData mesh = sheet();
  for (std::size_t i = 0; i < 2; ++i) {
    add_float_mesh(document, mesh);
    document.append("nodes", {{"mesh", i}, {"matrix", as_json(kStands[i].matrix())}});
  }
}

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

}  // namespace ppm::test::variants
