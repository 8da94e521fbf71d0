// Compressed geometry that is broken or claims too much: one line that names the place.
#include <gtest/gtest.h>

#include "gltf_draco_header.hpp"
#include "made_document.hpp"
#include "mesh_variants.hpp"
#include "pack_mesh.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

/// A file, something wrong with it, and what the refusal must say.
struct Broken {
  const char* variant;
  std::function<void(GltfDocument&)> spoil;
  std::vector<std::string> fragments;
};

json& packed_view(GltfDocument& document, int number) {
  for (json& view : document.root["bufferViews"]) {
    if (view.contains("extensions") && number-- == 0) {
      return view["extensions"]["EXT_meshopt_compression"];
    }
  }
  throw std::out_of_range("compressed bufferView");
}

std::function<void(GltfDocument&)> meshopt(const char* key, json value, int number = 0) {
  return [=](GltfDocument& document) { packed_view(document, number)[key] = value; };
}

json& draco_of(GltfDocument& document) {
  return document.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
}

/// Overwrites a byte of the Draco stream.
std::function<void(GltfDocument&)> draco_byte(std::size_t at, std::uint8_t value) {
  return [=](GltfDocument& document) {
    const json& view = document.root["bufferViews"][draco_of(document)["bufferView"].get<int>()];
    document.binary[view["byteOffset"].get<std::size_t>() + at] = value;
  };
}

std::vector<Broken> broken_files() {
  constexpr const char* kView = "bufferViews[";
  constexpr const char* kDraco = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
  const std::string packed = "extensions.EXT_meshopt_compression";
  return {
      {"meshopt", meshopt("count", 2147483647), {kView, packed, "which cannot hold them"}},
      {"meshopt", meshopt("count", 4000000000u), {packed + ".count", "32 bits"}},
      {"meshopt", meshopt("count", -1), {packed + ".count", "negative"}},
      {"meshopt", meshopt("count", 3), {packed, "unpacks to 36 bytes"}},
      {"meshopt", meshopt("byteStride", 6), {packed + ".byteStride", "no stride"}},
      {"meshopt", meshopt("byteStride", 260), {packed + ".byteStride", "no stride"}},
      {"meshopt", meshopt("byteStride", 0), {packed + ".byteStride", "no stride"}},
      {"meshopt", meshopt("byteStride", 16), {packed}},
      {"meshopt", meshopt("byteLength", 1 << 30), {packed, "of a buffer of"}},
      {"meshopt", meshopt("byteLength", 20), {packed, "corrupt"}},
      {"meshopt", meshopt("byteOffset", 1 << 30), {packed, "of a buffer of"}},
      {"meshopt", meshopt("buffer", 7), {packed + ".buffer", "buffers[7]"}},
      {"meshopt", meshopt("buffer", "x"), {packed + ".buffer", "whole number"}},
      {"meshopt", meshopt("buffer", 1), {packed}},
      {"meshopt", meshopt("mode", "SOMETHING"), {packed + ".mode", "ATTRIBUTES"}},
      {"meshopt", meshopt("mode", 3), {packed + ".mode", "not a string"}},
      {"meshopt", meshopt("mode", "TRIANGLES"), {packed + ".byteStride", "size of indices"}},
      {"meshopt", meshopt("filter", "BLUR"), {packed + ".filter", "OCTAHEDRAL"}},
      {"meshopt", meshopt("filter", "QUATERNION"), {packed + ".byteStride", "filter"}},
      {"meshopt", meshopt("filter", "EXPONENTIAL", 4), {packed + ".filter", "filters indices"}},
      {"meshopt", meshopt("count", 100, 4), {packed + ".count", "triangles"}},
      {"meshopt", meshopt("mode", "INDICES", 4), {packed, "which cannot hold them"}},
      {"meshopt",
       [](GltfDocument& d) { packed_view(d, 0).erase("count"); },
       {packed, "has no count"}},
      {"meshopt",
       [](GltfDocument& d) { d.root["bufferViews"][1].erase("extensions"); },
       {kView, "of a buffer of 1"}},
      {"Draco, sequential and exact", draco_byte(0, 'X'), {kDraco, "Draco 2.2"}},
      {"Draco, sequential and exact", draco_byte(6, 1), {kDraco, "Draco 2.2"}},
      {"Draco, sequential and exact", draco_byte(7, 0), {kDraco, "Draco 2.2"}},
      {"Draco, sequential and exact", draco_byte(8, 7), {kDraco, "Draco 2.2"}},
      {"Draco, sequential and exact", draco_byte(11, 47), {"accessors[", "count", "corners"}},
      {"Draco, sequential and exact", draco_byte(12, 1), {"count", "1 vertices in the Draco"}},
      {"Draco",
       [](GltfDocument& d) { draco_of(d)["attributes"]["POSITION"] = 99; },
       {"attributes.POSITION", "not in the Draco stream"}},
      {"Draco",
       [](GltfDocument& d) { draco_of(d)["attributes"] = 1; },
       {"attributes", "no object"}},
      {"Draco",
       [](GltfDocument& d) { draco_of(d)["bufferView"] = 99; },
       {kDraco, "bufferViews[99]"}},
      {"Draco", [](GltfDocument& d) { draco_of(d).erase("bufferView"); }, {kDraco, "bufferView"}},
      {"Draco",
       [](GltfDocument& d) { d.root["meshes"][0]["primitives"][0].erase("indices"); },
       {"meshes[0].primitives[0]", "no indices"}},
      {"Draco",
       [](GltfDocument& d) {
         for (json& accessor : d.root["accessors"]) accessor["count"] = 1000000000;
       },
       {"accessors[", "count", "Draco stream"}},
      {"Draco",
       [](GltfDocument& d) {
         json& view = d.root["bufferViews"][draco_of(d)["bufferView"].get<int>()];
         view["byteLength"] = view["byteLength"].get<int>() / 2;
       },
       {kDraco, "corrupt"}},
  };
}

TEST(LoadGltfCompressed, BrokenStreamsAreRefusedInOneLine) {
  for (const Broken& broken : broken_files()) {
    for (const MeshVariant& variant : mesh_variants()) {
      if (variant.name != broken.variant) continue;
      const TemporaryFolder folder;
      const std::string message = refusal(variant.write(folder, broken.spoil));
      for (const std::string& fragment : broken.fragments) {
        EXPECT_NE(message.find(fragment), std::string::npos)
            << broken.variant << ": '" << message << "' lacks '" << fragment << "'";
      }
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

// Whatever single byte of a stream is wrong, the file is read or refused, never more.
TEST(LoadGltfCompressed, NoByteOfAStreamIsFatal) {
  for (const MeshVariant& variant : mesh_variants()) {
    const bool is_draco = variant.name.starts_with("Draco");
    if (!is_draco && !variant.name.starts_with("meshopt")) continue;
    for (int step = 0; step < 60; ++step) {
      const TemporaryFolder folder;
      refusal(variant.write(folder, [&](GltfDocument& document) {
        const std::size_t position =
            static_cast<std::size_t>(step) * (document.binary.size() - 1) / 59;
        document.binary[position] ^= static_cast<std::uint8_t>(1 + 37 * step);
      }));
    }
  }
}

// Nothing but the header says how much a Draco stream unpacks to.
TEST(LoadGltfCompressed, DracoSizesAreReadBeforeAnythingIsUnpacked) {
  DracoInput input;
  input.attributes["POSITION"] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  input.components["POSITION"] = 3;
  input.indices = {0, 1, 2, 2, 1, 3};
  for (const bool sequential : {false, true}) {
    const DracoOutput packed = draco_packed(input, sequential, 8);
    const auto sizes = scene::gltf::draco_sizes(packed.stream);
    ASSERT_TRUE(sizes);
    EXPECT_EQ(sizes->faces, 2u);
    EXPECT_EQ(sizes->vertices, 4u);
    for (std::size_t length = 0; length < 13; ++length) {
      EXPECT_FALSE(scene::gltf::draco_sizes(std::span(packed.stream).first(length))) << length;
    }
  }
  // Sequential: faces, then points, seven bits a byte.
  const std::vector<std::uint8_t> huge{'D', 'R',  'A',  'C',  'O',  2,    2,    1,    0,   0,
                                       0,   0xff, 0xff, 0xff, 0xff, 0x0f, 0x80, 0x80, 0x01};
  const auto claimed = scene::gltf::draco_sizes(huge);
  ASSERT_TRUE(claimed);
  EXPECT_EQ(claimed->faces, 4294967295u);
  EXPECT_EQ(claimed->vertices, 16384u);
  // The same behind metadata: one attribute's, with an entry "ab" of three bytes and a child "c".
  std::vector<std::uint8_t> described = huge;
  described[10] = 0x80;
  const std::vector<std::uint8_t> metadata{1, 0, 1, 2, 'a', 'b', 3, 1, 2, 3, 1, 1, 'c', 0, 0, 0, 0};
  described.insert(described.begin() + 11, metadata.begin(), metadata.end());
  const auto behind = scene::gltf::draco_sizes(described);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->faces, 4294967295u);
}

}  // namespace
}  // namespace ppm::test
