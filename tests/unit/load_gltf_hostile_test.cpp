// Broken and hostile files: each is refused with one line that names the place, and no file
// whatsoever does anything but load or be refused.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "gltf_document.hpp"
#include "load_gltf.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

void expect_refused(const std::filesystem::path& file, const std::string& fragment,
                    const std::string& name) {
  const std::string message = refusal(file);
  EXPECT_NE(message.find(fragment), std::string::npos) << name << ": \"" << message << "\"";
  EXPECT_TRUE(message.starts_with(file.string())) << name << ": \"" << message << "\"";
  EXPECT_EQ(message.find('\n'), std::string::npos) << name;
  EXPECT_LT(message.size(), file.string().size() + 500) << name;
}

TEST(LoadGltfHostile, TheFileThatTheOthersBreakLoads) {
  const TemporaryFolder folder;
  everything().write_gltf(folder / "a.gltf");
  everything().write_glb(folder / "a.glb");
  EXPECT_EQ(refusal(folder / "a.gltf"), "");
  EXPECT_EQ(refusal(folder / "a.glb"), "");
}

struct Broken {
  const char* name;
  std::function<void(json&)> fault;
  const char* fragment;
};

std::vector<Broken> broken_documents() {
  const auto set = [](const char* pointer, json value) {
    return [=](json& root) { root[json::json_pointer(pointer)] = value; };
  };
  const auto drop = [](const char* parent, const char* key) {
    return [=](json& root) { root[json::json_pointer(parent)].erase(key); };
  };
  const char* const position = "meshes[0].primitives[0].attributes.POSITION";
  return {
      {"no asset", drop("", "asset"), "asset: is missing"},
      {"asset a list", set("/asset", json::array()), "asset: is missing"},
      {"old version", set("/asset/version", "1.0"), "asset.version"},
      {"newer minimum", set("/asset/minVersion", "2.1"), "asset.version"},
      {"unknown required", set("/extensionsRequired", {"KHR_draco_mesh_compression"}),
       "KHR_draco_mesh_compression"},
      {"meshopt required", set("/extensionsRequired", {"EXT_meshopt_compression"}),
       "EXT_meshopt_compression"},
      {"required not a list", set("/extensionsRequired", 3),
       "extensionsRequired: is not a JSON array"},
      {"scene out of range", set("/scene", 1), "scenes[1]"},
      {"negative scene", set("/scene", -2), "scene: is negative"},
      {"negative mesh", set("/nodes/0/mesh", -1), "nodes[0].mesh: is negative"},
      {"negative material", set("/meshes/0/primitives/0/material", -1),
       "meshes[0].primitives[0].material: is negative"},
      {"negative offset", set("/bufferViews/0/byteOffset", -4),
       "bufferViews[0].byteOffset: is negative"},
      {"negative fraction", set("/accessors/0/count", -0.5), "accessors[0].count: is negative"},
      {"root out of range", set("/scenes/0/nodes/0", 9), "scenes[0].nodes[0]: refers to nodes[9]"},
      {"no nodes", drop("", "nodes"), "scenes[0].nodes[0]: refers to nodes[1]"},
      {"empty scene", set("/scenes/0/nodes", json::array()), "no triangles"},
      {"own parent", set("/nodes/0/children", {0}), "nodes[0]: is reached twice"},
      {"cycle", set("/nodes/0/children", {1}), "is reached twice"},
      {"two parents", set("/nodes/2/children", {0}), "nodes[0]: is reached twice"},
      {"listed twice", set("/scenes/0/nodes", {1, 1}), "nodes[1]: is reached twice"},
      {"child out of range", set("/nodes/0/children", {77}), "nodes[0].children[0]"},
      {"child below zero", set("/nodes/0/children", {-1}), "nodes[0].children[0]"},
      {"index of 64 bits", set("/nodes/0/mesh", 4294967296), "nodes[0].mesh: is an integer beyond"},
      {"node not an object", set("/nodes/0", 5),
       "nodes[0]: `nodes' does not contain an JSON object"},
      {"nodes not an array", set("/nodes", json::object()), "nodes: is not a JSON array"},
      {"short matrix", set("/nodes/0/matrix", {1, 2}), "nodes[0].matrix: has 2 items"},
      {"projective matrix",
       set("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "affine"},
      {"no rotation", set("/nodes/0/rotation", {0, 0, 0, 0}), "nodes[0].rotation"},
      {"rotation a string", set("/nodes/0/rotation", {0, 0, 0, "1"}),
       "nodes[0].rotation: has 3 items"},
      {"scale null", set("/nodes/0/scale", {1, 1, nullptr}), "nodes[0].scale: has 2 items"},
      {"overflow", set("/nodes/0/scale", {1e308, 1, 1}), "overflow"},
      {"overflow of a chain",
       set("/nodes/1", {{"children", {0}},
                        {"matrix", {1e308, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e308, 0, 0, 1}}}),
       "overflow"},
      {"too large", set("/nodes/0/scale", {1e20, 1, 1}), "extent"},
      {"no extent", set("/nodes/0/scale", {0, 0, 0}), "extent"},
      {"only a line", set("/nodes/0/scale", {1, 0, 0}), "area"},
      {"mesh out of range", set("/nodes/0/mesh", 1), "nodes[0].mesh: refers to meshes[1]"},
      {"no primitives", drop("/meshes/0", "primitives"), "meshes[0].primitives: is empty"},
      {"empty mesh", set("/meshes/0/primitives", json::array()), "meshes[0].primitives: is empty"},
      {"no attributes", drop("/meshes/0/primitives/0", "attributes"),
       "'attributes' property is missing in Primitive"},
      {"mode", set("/meshes/0/primitives/0/mode", 7), "meshes[0].primitives[0].mode"},
      {"no position accessor", set("/meshes/0/primitives/0/attributes/POSITION", 99), position},
      {"position of two", set("/meshes/0/primitives/0/attributes/POSITION", 2), position},
      {"normal of two", set("/meshes/0/primitives/0/attributes/NORMAL", 2), "attributes.NORMAL"},
      {"fewer normals", set("/accessors/1/count", 2), "2 elements beside 3 positions"},
      {"signed indices", set("/accessors/4/componentType", 5122), "primitives[0].indices"},
      {"float indices", set("/meshes/0/primitives/0/indices", 0), "primitives[0].indices"},
      {"four indices", set("/accessors/4/count", 4), "whole triangles"},
      {"material out of range", set("/meshes/0/primitives/0/material", 1), "materials[1]"},
      {"huge count", set("/accessors/1/count", 100000000000000), "accessors[1]: needs"},
      {"count beyond all", set("/accessors/1/count", 1e30), "accessors[1]: 'count'"},
      {"negative count", set("/accessors/1/count", -3), "accessors[1].count: is negative"},
      {"no elements", set("/accessors/1/count", 0), "accessors[1]: is empty"},
      {"huge count of zeros",
       set("/accessors/1", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4000000000}}),
       "without a bufferView"},
      {"offset beyond", set("/accessors/1/byteOffset", 4), "accessors[1]: needs 40 bytes"},
      {"offset wraps", set("/accessors/1/byteOffset", 281474976710655), "accessors[1]: needs"},
      {"matrix accessor", set("/accessors/0/type", "MAT4"), "accessors[0]"},
      {"no such type", set("/accessors/0/type", "VEC9"), "accessors[0]: Unsupported `type`"},
      {"type a number", set("/accessors/0/type", 3),
       "accessors[0]: 'type' property is not a string"},
      {"doubles", set("/accessors/0/componentType", 5130), "accessors[0].componentType"},
      {"view out of range", set("/accessors/0/bufferView", 1000), "bufferViews[1000]"},
      {"stride too small", set("/bufferViews/0/byteStride", 4), "bufferViews[0].byteStride"},
      {"stride too large", set("/bufferViews/0/byteStride", 1000000),
       "bufferViews[0]: Invalid `byteStride'"},
      {"stride leads out", set("/bufferViews/0/byteStride", 16), "accessors[0]: needs 44 bytes"},
      {"view too long", set("/bufferViews/0/byteLength", 1000000), "bufferViews[0]: ends at byte"},
      {"view begins outside", set("/bufferViews/0/byteOffset", 281474976710656),
       "bufferViews[0]: ends at byte"},
      {"buffer out of range", set("/bufferViews/0/buffer", 1), "buffers[1]"},
      {"buffer claims more", set("/buffers/0/byteLength", 4000000000),
       "buffers[0]: Failed to decode"},
      {"buffers beyond memory",
       [](json& root) {
         for (int i = 0; i < 9; ++i) root["buffers"].push_back({{"byteLength", 500000000}});
       },
       "buffers: claim more than 4 GiB"},
      {"indices without data", drop("/accessors/4", "bufferView"),
       "meshes: accessor[4] invalid bufferView"},
      {"sparse counts backwards", set("/accessors/0/sparse/count", -1),
       "accessors[0].sparse.count: is negative"},
      {"sparse offset backwards", set("/accessors/0/sparse/values/byteOffset", -4),
       "accessors[0].sparse.values.byteOffset"},
      {"view of -1", set("/bufferViews/0/buffer", -1), "bufferViews[0].buffer: is negative"},
      {"sparse beyond", set("/accessors/0/sparse/count", 4), "accessors[0].sparse: substitutes"},
      {"sparse reads outside", set("/accessors/0/sparse/count", 2), "accessors[0].sparse"},
      {"sparse index type", set("/accessors/0/sparse/indices/componentType", 5126),
       "sparse.indices"},
      {"sparse index out of range", set("/accessors/0/sparse/indices/bufferView", 3),
       "sparse.indices: do not increase"},
      {"texture out of range", set("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 5),
       "baseColorTexture.index"},
      {"image out of range", set("/textures/0/source", 3), "textures[0].source"},
      {"sampler out of range", set("/textures/0/sampler", 3), "textures[0].sampler"},
      {"wrap mode", set("/samplers/0/wrapS", 1), "samplers[0].wrapS"},
      {"filter", set("/samplers/0/magFilter", 1), "samplers[0].magFilter"},
      {"image of nothing", set("/images/0", json::object()), "images[0]: Neither required"},
      {"no image", set("/images/0/bufferView", 0), "images[0]: is no PNG"},
      {"missing image file", set("/images/0", {{"uri", "none.png"}}),
       "images[0].uri: \"none.png\" cannot be read"},
      {"image with two sources", set("/images/0/uri", "none.png"), "images[0]: Only one of"},
      {"image beyond the buffer", set("/bufferViews/7/byteOffset", 1000000000000),
       "bufferViews[7]: ends at byte"},
      {"factor a string", set("/materials/0/extensions/KHR_materials_volume/thicknessFactor", "1"),
       "materials[0].extensions.KHR_materials_volume.thicknessFactor: is not a number"},
      {"colour of two", set("/materials/0/emissiveFactor", {1, 1}),
       "materials[0]: Array length of `emissiveFactor`"},
      {"light out of range", set("/nodes/2/extensions/KHR_lights_punctual/light", 1),
       "KHR_lights_punctual.light"},
      {"light type", set("/extensions/KHR_lights_punctual/lights/0/type", "area"),
       "lights[0].type"},
      {"bright light", set("/extensions/KHR_lights_punctual/lights/0/intensity", 1e300),
       "intensity overflows"},
      {"camera out of range", set("/nodes/1/camera", 1), "nodes[1].camera"},
      {"no camera type", drop("/cameras/0", "type"), "cameras[0]"},
      {"wide camera", set("/cameras/0/perspective/yfov", 3.2), "cameras[0].perspective.yfov"},
      {"narrow camera", set("/cameras/0/perspective/yfov", 0), "cameras[0].perspective.yfov"},
      {"flat camera", set("/cameras/0/perspective/aspectRatio", 1e-9), "perspective.aspectRatio"},
      {"triangle bomb",
       [](json& root) {
         // Zeros need no bytes: 5.6 million triangles, seven times over.
         root["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 16777215}};
         root["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}};
         for (int i = 0; i < 7; ++i) {
           root["nodes"].push_back({{"mesh", 0}});
           root["scenes"][0]["nodes"].push_back(root["nodes"].size() - 1);
         }
       },
       "triangles"},
  };
}

TEST(LoadGltfHostile, BrokenDocumentsAreRefused) {
  const TemporaryFolder folder;
  for (const Broken& broken : broken_documents()) {
    GltfDocument document = everything();
    broken.fault(document.root);
    document.write_gltf(folder / "broken.gltf");
    expect_refused(folder / "broken.gltf", broken.fragment, broken.name);
  }
}

TEST(LoadGltfHostile, BrokenNumbersInBuffersAreRefused) {
  const float infinity = std::numeric_limits<float>::infinity();
  const TemporaryFolder folder;
  for (const float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
    GltfDocument document;
    document.mesh({{"POSITION", document.accessor<float>({0, 0, 0, 1, 0, bad, 0, 1, 0}, "VEC3")}});
    document.write_gltf(folder / "a.gltf");
    expect_refused(folder / "a.gltf", "attributes.POSITION: vertex 1 (accessors[0]) is not finite",
                   "position");
  }
  GltfDocument document;
  document.triangle()["indices"] = document.accessor<std::uint8_t>({0, 1, 3}, "SCALAR");
  document.write_gltf(folder / "a.gltf");
  expect_refused(folder / "a.gltf", "primitives[0].indices: index 3 exceeds the 3 vertices",
                 "index");
}

// tinygltf takes optional members of another type as absent.
TEST(LoadGltfHostile, OptionalMembersOfAnotherTypeAreAbsent) {
  GltfDocument document = everything();
  json& root = document.root;
  root["scene"] = "0";
  root["nodes"][1]["name"] = 3;
  root["materials"][0]["name"] = 3;
  root["materials"][0]["doubleSided"] = 1;
  root["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = "0.5";
  root["cameras"][0]["perspective"]["aspectRatio"] = json::array();
  const scene::Scene scene = load(document);
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.materials.at(0).name, "");
  EXPECT_FALSE(scene.materials[0].double_sided);
  EXPECT_EQ(scene.materials[0].metallic, 1.0f);
  EXPECT_FALSE(scene.cameras.at(0).aspect.has_value());
}

TEST(LoadGltfHostile, UrisThatLeadElsewhereAreRefused) {
  const TemporaryFolder folder;
  write_file(folder / "short.bin", std::string(8, 'x'));
  std::filesystem::create_directory(folder / "folder.bin");
  // The folder that the program was started in is no place to look.
  const TemporaryFolder current;
  write_file(current / "elsewhere.bin", std::string(36, 'x'));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(current / "");
  const std::vector<std::pair<const char*, const char*>> uris{
      {"../secret.bin", "outside"},
      {"a/../../secret.bin", "outside"},
      {"%2e%2e/secret.bin", "outside"},
      {"/etc/passwd", "outside"},
      {"..\\secret.bin", "outside"},
      {"file:///etc/passwd", "scheme"},
      {"http://example.org/a.bin", "scheme"},
      {"%4", "no such file"},
      {"%zz.bin", "not a file name"},
      {"a%00.bin", "not a file name"},
      {"", "'uri' is missing"},
      {"missing.bin", "no such file"},
      {"folder.bin", "not a regular file"},
      {"elsewhere.bin", "no such file"},
      {"short.bin", "requestedBytes 36, but got 8"},
      {"data:application/octet-stream;base64", "scheme"},
      {"data:text/plain,hello", "scheme"},
      {"data:application/octet-stream;base64,", "Failed to decode"},
      {"data:application/octet-stream;base64,AAA*", "Failed to decode"},
      {"data:application/octet-stream;base64,AAAAA", "Failed to decode"},
  };
  for (const auto& [uri, fragment] : uris) {
    GltfDocument document;
    document.triangle();
    document.root["buffers"][0]["uri"] = uri;
    document.write_gltf(folder / "a.gltf");
    expect_refused(folder / "a.gltf", "buffers[0]", uri);
    expect_refused(folder / "a.gltf", fragment, uri);
  }
  std::filesystem::current_path(before);
}

TEST(LoadGltfHostile, BrokenContainersAreRefused) {
  const Bytes good = everything().glb();
  const auto patched = [&](std::size_t at, std::uint8_t value) {
    Bytes bytes = good;
    bytes[at] = value;
    return bytes;
  };
  const auto text = [](const std::string& content) {
    return Bytes(content.begin(), content.end());
  };
  const Bytes lying_header{'g',  'l',  'T',  'F',  2,    0,    0,   0,   0xff, 0xff,
                           0xff, 0xff, 0xf0, 0xff, 0xff, 0xff, 'J', 'S', 'O',  'N'};
  Bytes lying_chunk = lying_header;
  lying_chunk[8] = 20;
  lying_chunk[9] = lying_chunk[10] = lying_chunk[11] = 0;
  Bytes long_chunk = good;  // its second chunk ends as many bytes behind the file as its header has
  const std::size_t second = 20 + good[12] + (std::size_t{good[13]} << 8);
  long_chunk[second] = static_cast<std::uint8_t>(long_chunk[second] + 8);
  const std::vector<std::tuple<const char*, Bytes, const char*>> files{
      {"empty", {}, "neither"},
      {"blank", text(" \n\t"), "neither"},
      {"picture", png_of(1, 1, std::vector<std::uint8_t>{1, 2, 3, 4}), "neither"},
      {"array", text("[]"), "neither"},
      {"only magic", text("glTF"), "within its header"},
      {"header of 4 GB", lying_header, "header claims 4294967295 bytes"},
      {"chunk of 4 GB", lying_chunk, "chunk claims 4294967280 bytes"},
      {"version 1", patched(4, 1), "version 1"},
      {"first chunk", patched(16, 'X'), "not JSON"},
      {"cut", Bytes(good.begin(), good.end() - 20), "cut short"},
      {"long chunk", long_chunk, "a chunk claims"},
      {"no json", text("{\"asset\":"), "cannot be read"},
      {"trailing comma", text("{\"asset\": {},}"), "cannot be read"},
      {"not utf-8", text("{\"asset\": \"\xff\xfe\"}"), "cannot be read"},
      {"infinite number", text("{\"asset\": {\"version\": 1e999}}"), "cannot be read"},
      {"asset null", text("{\"asset\": null}"), "asset: is missing"},
      {"deep arrays", text("{\"asset\": " + std::string(100000, '[')), "nested deeper"},
      {"deep closed arrays",
       text("{\"asset\":" + std::string(100000, '[') + std::string(100000, ']') + "}"),
       "nested deeper"},
      {"long token", text("{\"asset\": " + std::string(100000, 'a') + "}"), "cannot be read"},
      {"long string", text("{\"" + std::string(100000, 'a')), "cannot be read"},
  };
  const TemporaryFolder folder;
  for (const auto& [name, bytes, fragment] : files) {
    write_file(folder / "a.glb", bytes);
    expect_refused(folder / "a.glb", fragment, name);
  }
  expect_refused(folder / "none.gltf", "no such file", "missing");
  std::filesystem::create_directory(folder / "folder.gltf");
  expect_refused(folder / "folder.gltf", "not a regular file", "folder");
}

TEST(LoadGltfHostile, BrokenImagesAreRefused) {
  const Bytes good = png_of(2, 1, std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8});
  Bytes bent = good;
  bent[bent.size() - 17] ^= 0xff;  // before the checksum of the texels and the empty last chunk
  const TemporaryFolder folder;
  const std::vector<std::tuple<const char*, Bytes, const char*>> images{
      {"long", png_of(20000, 10, std::vector<std::uint8_t>{}), "20000 x 10 texels are too many"},
      {"huge", png_of(100000, 100000, std::vector<std::uint8_t>{}), "texels are too many"},
      {"without texels", png_of(16384, 16384, std::vector<std::uint8_t>{}), "is corrupt"},
      {"no size", png_of(0, 0, std::vector<std::uint8_t>{}), "images[0]"},
      {"cut", Bytes(good.begin(), good.end() - 30), "is corrupt"},
      {"bent", bent, "is corrupt"},
      {"empty", {}, "images[0]"},
      {"jpeg header", {0xff, 0xd8, 0xff, 0xe0, 0x00, 0x10}, "images[0]: is corrupt"},
  };
  for (const auto& [name, image, fragment] : images) {
    with_image(image).write_gltf(folder / "a.gltf");
    testing::internal::CaptureStderr();
    expect_refused(folder / "a.gltf", fragment, name);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name;
  }
}

}  // namespace
}  // namespace ppm::test
