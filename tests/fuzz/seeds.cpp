#include "seeds.hpp"

#include <OpenImageIO/imageio.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "mesh_variants.hpp"

namespace ppm::fuzz {
namespace {

using namespace test;
using nlohmann::json;

constexpr std::size_t kLargestSeed = 12000;

Bytes text_of(const GltfDocument& document) {
  json whole = document.root;
  if (!document.binary.empty()) {
    whole["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(document.binary);
  }
  const std::string text = whole.dump();
  return {text.begin(), text.end()};
}

const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

/// A square of four vertices with every attribute that a vertex may have.
json all_attributes(GltfDocument& document) {
  return {{"POSITION", document.accessor<float>(kSquare, "VEC3")},
          {"NORMAL", document.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
          {"TANGENT",
           document.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, "VEC4")},
          {"TEXCOORD_0", document.accessor<float>({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2")},
          {"TEXCOORD_1",
           document.accessor<std::uint8_t>({0, 0, 255, 0, 0, 255, 255, 255}, "VEC2", true)},
          {"COLOR_0",
           document.accessor<std::uint16_t>(std::vector<std::uint16_t>(16, 65535), "VEC4", true)}};
}

/// Strips and fans with and without indices of each width; signed quantised positions, a matrix.
GltfDocument topologies() {
  GltfDocument document;
  document.mesh(all_attributes(document))["mode"] = 5;
  json& fan = document.mesh({{"POSITION", document.accessor<float>(kSquare, "VEC3")}});
  fan["mode"] = 6;
  fan["indices"] = document.accessor<std::uint8_t>({0, 1, 3, 2}, "SCALAR");
  json& wide = document.mesh({{"POSITION", document.accessor<float>(kSquare, "VEC3")}});
  wide["indices"] = document.accessor<std::uint32_t>({0, 1, 3}, "SCALAR");
  document.mesh({{"POSITION", document.accessor<std::int16_t>(
                                  {0, 0, 0, 0, 127, 0, 0, 0, 0, 127, 0, 0}, "VEC4", true)}});
  json& quantised = document.root["meshes"][3]["primitives"][0];
  document.root["accessors"][quantised["attributes"]["POSITION"].get<std::size_t>()]["type"] =
      "VEC3";
  document.root["bufferViews"].back()["byteStride"] = 8;
  document.root["nodes"][0]["matrix"] = {-2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1};
  document.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  document.root["extensionsUsed"] = {"KHR_mesh_quantization"};
  return document;
}

/// Every texture slot and every material extension that might be read.
GltfDocument materials() {
  GltfDocument document;
  json& primitive = document.mesh(all_attributes(document));
  primitive["mode"] = 5;
  primitive["material"] = 0;
  document.append(
      "images", {{"mimeType", "image/png"},
                 {"bufferView",
                  document.view(png_of(2, 2, std::vector<std::uint8_t>(16, std::uint8_t{200})))}});
  document.append("images", {{"uri", std::string("data:image/jpeg;base64,") + kGreyJpegBase64}});
  document.append("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
  document.append("textures", {{"source", 0}, {"sampler", 0}});
  document.append("textures", {{"source", 1}});
  const json transformed = {{"index", 0},
                            {"texCoord", 1},
                            {"extensions",
                             {{"KHR_texture_transform",
                               {{"offset", {0.25, 0.5}}, {"rotation", 1.5}, {"scale", {2, -1}}}}}}};
  const json plain = {{"index", 1}};
  json normal = transformed;
  normal["scale"] = 0.5;
  document.root["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorFactor", {1, 0.5, 0.25, 0.75}},
         {"baseColorTexture", transformed},
         {"metallicRoughnessTexture", plain},
         {"roughnessFactor", 0.4}}},
       {"normalTexture", normal},
       {"occlusionTexture", plain},
       {"emissiveTexture", plain},
       {"emissiveFactor", {1, 1, 1}},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.3},
       {"doubleSided", true},
       {"extras", {{"priority", 2}}},
       {"extensions",
        {{"KHR_materials_transmission",
          {{"transmissionFactor", 0.5}, {"transmissionTexture", plain}}},
         {"KHR_materials_volume",
          {{"thicknessFactor", 1},
           {"attenuationDistance", 2},
           {"attenuationColor", {1, 0.5, 0.1}},
           {"thicknessTexture", plain}}},
         {"KHR_materials_ior", {{"ior", 1.33}}},
         {"KHR_materials_dispersion", {{"dispersion", 0.5}}},
         {"KHR_materials_specular",
          {{"specularFactor", 0.5},
           {"specularTexture", plain},
           {"specularColorFactor", {1, 0.5, 2}},
           {"specularColorTexture", plain}}},
         {"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}},
         {"KHR_materials_clearcoat",
          {{"clearcoatFactor", 1},
           {"clearcoatRoughnessFactor", 0.1},
           {"clearcoatTexture", plain},
           {"clearcoatRoughnessTexture", plain},
           {"clearcoatNormalTexture", normal}}}}}},
      {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_unlit", json::object()}}}}};
  document.triangle()["material"] = 1;
  return document;
}

/// Lights of all kinds with everything they may say, both kinds of cameras, two scenes.
GltfDocument lights_and_cameras() {
  GltfDocument document;
  document.triangle();
  document.root["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 5}, {"range", 3}, {"color", {1, 0.5, 0.25}}},
      {{"type", "directional"}, {"intensity", 5}},
      {{"type", "spot"},
       {"intensity", 5},
       {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.7}}}}};
  for (int i = 0; i < 3; ++i) {
    document.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  document.append("cameras",
                  {{"type", "orthographic"},
                   {"name", "flat"},
                   {"orthographic", {{"xmag", 2}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 10}}}});
  document.append("cameras", {{"type", "perspective"},
                              {"perspective",
                               {{"yfov", 1}, {"znear", 0.1}, {"zfar", 10}, {"aspectRatio", 1.5}}}});
  document.append("nodes", {{"camera", 0}, {"translation", {0, 0, 5}}});
  document.append("nodes", {{"camera", 1}, {"translation", {0, 0, 5}}, {"children", {0, 1}}});
  document.root["scenes"] = {{{"nodes", {2, 3, 4, 5}}}, {{"nodes", {5}}}};
  document.root["scene"] = 1;
  return document;
}

/// A skin, morph targets with weights (one of them sparse), an animation.
GltfDocument poses() {
  GltfDocument document;
  json attributes = {
      {"POSITION", document.accessor<float>(kSquare, "VEC3")},
      {"JOINTS_0",
       document.accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4")},
      {"WEIGHTS_0",
       document.accessor<float>({1, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4")}};
  const std::size_t moved = document.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  document.append("accessors",
                  {{"componentType", 5126},
                   {"type", "VEC3"},
                   {"count", 4},
                   {"sparse",
                    {{"count", 1},
                     {"indices", {{"bufferView", document.view({2, 0})}, {"componentType", 5123}}},
                     {"values", {{"bufferView", document.view(bytes_of<float>({2, 0, 0}))}}}}}});
  const std::size_t sparse = document.root["accessors"].size() - 1;
  json& primitive = document.mesh(attributes);
  primitive["mode"] = 5;
  primitive["targets"] = {{{"POSITION", moved}}, {{"POSITION", sparse}, {"NORMAL", moved}}};
  document.root["meshes"][0]["weights"] = {0.5, 0.25};
  document.root["nodes"][0]["skin"] = 0;
  document.root["nodes"][0]["weights"] = {1, 0};
  const std::vector<float> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::vector<float> matrices = identity;
  matrices.insert(matrices.end(), identity.begin(), identity.end());
  const std::size_t view = document.view(bytes_of(matrices));
  document.append("accessors",
                  {{"bufferView", view}, {"componentType", 5126}, {"type", "MAT4"}, {"count", 2}});
  document.append("nodes", {{"translation", {0, 1, 0}}, {"children", {2}}});
  document.append("nodes", {{"rotation", {0, 0, 0.6, 0.8}}, {"scale", {1, 2, 1}}});
  document.append("skins", {{"joints", {1, 2}},
                            {"skeleton", 1},
                            {"inverseBindMatrices", document.root["accessors"].size() - 1}});
  const std::size_t times = document.accessor<float>({0, 1}, "SCALAR");
  const std::size_t weights = document.accessor<float>({0, 0, 1, 1}, "SCALAR");
  document.append(
      "animations",
      {{"samplers", {{{"input", times}, {"output", weights}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  document.root["scenes"] = {{{"nodes", {0, 1}}}};
  return document;
}

/// Instances of a node's mesh by EXT_mesh_gpu_instancing; an environment of EXT_lights_image_based.
GltfDocument instances() {
  GltfDocument document;
  document.triangle();
  document.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", document.accessor<float>({0, 0, 0, 2, 0, 0}, "VEC3")},
      {"ROTATION", document.accessor<std::int8_t>({0, 0, 0, 127, 0, 127, 0, 0}, "VEC4", true)},
      {"SCALE", document.accessor<float>({1, 1, 1, 2, -1, 1}, "VEC3")}};
  document.append(
      "images",
      {{"mimeType", "image/png"},
       {"bufferView", document.view(png_of(1, 1, std::vector<std::uint8_t>{9, 9, 9, 255}))}});
  document.root["extensions"]["EXT_lights_image_based"]["lights"] = {
      {{"intensity", 2},
       {"rotation", {0, 0, 0, 1}},
       {"irradianceCoefficients",
        json(std::vector<std::vector<double>>(9, std::vector<double>(3, 0.5)))},
       {"specularImageSize", 1},
       {"specularImages", json::array({json::array({0, 0, 0, 0, 0, 0})})}}};
  document.root["scenes"] = {
      {{"nodes", {0}}, {"extensions", {{"EXT_lights_image_based", {{"light", 0}}}}}}};
  document.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "EXT_lights_image_based"};
  document.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return document;
}

/// Buffers beside the file, a compressed view whose plain twin need not be there.
GltfDocument compressed() {
  GltfDocument document;
  document.root["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_draco_mesh_compression"};
  json& primitive = document.triangle();
  document.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0},          {"byteOffset", 0}, {"byteLength", 36}, {"byteStride", 12},
      {"mode", "ATTRIBUTES"}, {"count", 3},      {"filter", "NONE"}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                           {"attributes", {{"POSITION", 0}}}};
  return document;
}

Bytes content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A picture of 4 x 4 texels in a file of this kind, which must be one that OpenImageIO writes.
Bytes picture(const char* extension, OIIO::TypeDesc type) {
  const TemporaryFolder folder;
  const std::string file = (folder / "a").string() + extension;
  const std::vector<float> texels(4 * 4 * 3, 0.5f);
  const auto output = OIIO::ImageOutput::create(file);
  const OIIO::ImageSpec spec(4, 4, 3, type);
  if (!output || !output->open(file, spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, texels.data()) || !output->close()) {
    throw std::runtime_error("cannot write " + file + ": " + OIIO::geterror());
  }
  return content(file);
}

}  // namespace

std::vector<Seed> seeds() {
  GltfDocument beside = everything();
  beside.root["buffers"].push_back({{"byteLength", 36}, {"uri", "beside.bin"}});
  beside.root["bufferViews"][1]["buffer"] = 1;
  beside.root["bufferViews"][1]["byteOffset"] = 0;
  std::vector<Seed> all{{"everything.glb", everything().glb()},
                        {"everything.gltf", text_of(everything())},
                        {"topologies.glb", topologies().glb()},
                        {"materials.glb", materials().glb()},
                        {"materials.gltf", text_of(materials())},
                        {"lights.glb", lights_and_cameras().glb()},
                        {"poses.glb", poses().glb()},
                        {"instances.glb", instances().glb()},
                        {"compressed.glb", compressed().glb()},
                        {"beside.glb", beside.glb()}};
  for (const auto& [extension, type] :
       {std::pair(".tif", OIIO::TypeDesc::UINT8), std::pair(".tif", OIIO::TypeDesc::FLOAT),
        std::pair(".bmp", OIIO::TypeDesc::UINT8), std::pair(".webp", OIIO::TypeDesc::UINT8),
        std::pair(".exr", OIIO::TypeDesc::HALF), std::pair(".hdr", OIIO::TypeDesc::FLOAT),
        std::pair(".png", OIIO::TypeDesc::UINT16), std::pair(".jpg", OIIO::TypeDesc::UINT8)}) {
    const std::string name = "image" + std::to_string(all.size()) + extension + ".glb";
    all.push_back({name, with_image(picture(extension, type)).glb()});
  }
  for (const MeshVariant& variant : mesh_variants()) {
    const TemporaryFolder folder;
    const Bytes bytes = content(variant.write(folder, [](GltfDocument&) {}));
    if (bytes.size() > kLargestSeed) continue;
    all.push_back({"variant" + std::to_string(all.size()) + ".glb", bytes});
  }
  return all;
}

}  // namespace ppm::fuzz
