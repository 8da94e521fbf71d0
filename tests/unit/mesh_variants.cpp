#include "mesh_variants.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "mesh_sheet.hpp"

namespace ppm::test {
namespace variants {
namespace {

using nlohmann::json;

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

}  // namespace
}  // namespace variants

namespace {

using nlohmann::json;
using Build = std::function<void(GltfDocument&)>;

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
  using namespace variants;
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
