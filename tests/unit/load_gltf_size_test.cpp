// What the loader says of a scene's size before it allocates: all of it, and in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "failure.hpp"
#include "made_document.hpp"
#include "mesh_variants.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::Scene;
using scene::SceneSize;

/// The sizes that a loader asked about, and what it loaded.
struct Asked {
  std::vector<SceneSize> sizes;  ///< the last one complete
  Scene scene;
};

Asked asked_for(const std::filesystem::path& file) {
  Asked asked;
  bool is_complete = false;
  Log log(Verbosity::quiet);
  scene::LoadOptions options;
  options.admit = [&](const SceneSize& size, const Scene* known) {
    EXPECT_FALSE(is_complete) << "asked again";
    is_complete = known != nullptr;
    asked.sizes.push_back(size);
  };
  asked.scene = load_gltf(file, log, options);
  EXPECT_TRUE(is_complete);
  return asked;
}

/// The message with which a loader ends that is refused once `is_too_much`.
std::string refused_when(const std::filesystem::path& file,
                         const std::function<bool(const SceneSize&)>& is_too_much) {
  Log log(Verbosity::quiet);
  scene::LoadOptions options;
  options.admit = [&](const SceneSize& size, const Scene*) {
    if (is_too_much(size)) throw Failure("", "", "too much", "");
  };
  try {
    load_gltf(file, log, options);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

void furnish(GltfDocument& document) {
  document.root["extensionsUsed"].push_back("KHR_lights_punctual");
  document.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  document.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  if (document.root.contains("scenes")) {
    document.root["scenes"][0]["nodes"].push_back(document.root["nodes"].size() - 1);
  }
  document.append("materials", {{"emissiveFactor", {1, 1, 1}}, {"normalTexture", {{"index", 0}}}});
  document.append("textures", {{"source", 0}});
  const Bytes png = png_of(3, 2, std::vector<std::uint8_t>(24, 200));
  document.append("images", {{"bufferView", document.view(png)}, {"mimeType", "image/png"}});
}

// However the mesh is said: nothing is counted twice or forgotten.
TEST(LoadGltfSize, IsCompleteBeforeTheSceneIsThere) {
  for (const MeshVariant& variant : mesh_variants()) {
    if (variant.name.starts_with("meshopt") || variant.name.find("by meshopt") != std::string::npos)
      continue;  // `view` must not follow their fallback buffer
    const TemporaryFolder folder;
    const Asked asked = asked_for(variant.write(folder, furnish));
    SceneSize expected = SceneSize::of(asked.scene);
    // Those that have no area, in one of the variants, are known to be none only later.
    expected.lights += asked.scene.findings.triangles_without_area;
    EXPECT_EQ(asked.sizes.back(), expected) << variant.name;
    EXPECT_EQ(expected.lights, expected.triangles + 1) << variant.name;
    EXPECT_TRUE(asked.sizes.back().details) << variant.name;
    EXPECT_EQ(asked.sizes.back().texture_bytes, 24u) << variant.name;
    EXPECT_EQ(asked.sizes.back().materials, 1u) << variant.name;
  }
}

// By hand: 35 vertices of 12 floats, 144 indices of 2 bytes.
TEST(LoadGltfSize, HoldsWhatCompressedGeometryUnpacksTo) {
  int seen = 0;
  for (const MeshVariant& variant : mesh_variants()) {
    const bool is_whole = variant.name.starts_with("Draco") || variant.name == "meshopt" ||
                          variant.name == "meshopt, sequence of indices";
    if (!is_whole) continue;
    ++seen;
    const TemporaryFolder folder;
    const Asked asked = asked_for(variant.write(folder, nullptr));
    EXPECT_EQ(asked.sizes.back().decoded_bytes, 35u * 48 + 144 * 2) << variant.name;
    EXPECT_EQ(asked.sizes.back(), SceneSize::of(asked.scene)) << variant.name;
  }
  EXPECT_EQ(seen, 4);
}

// Streams that are broken behind their headers: who refuses the size never finds out.
TEST(LoadGltfSize, IsSaidBeforeGeometryIsUnpacked) {
  const auto spoil = [](GltfDocument& document) {
    for (json& view : document.root["bufferViews"]) {
      if (view.contains("extensions")) {
        view["extensions"]["EXT_meshopt_compression"]["byteLength"] = 20;
        return;
      }
    }
    json& view = document.root["bufferViews"].back();  // the only one
    view["byteLength"] = view["byteLength"].get<int>() / 2;
  };
  int seen = 0;
  for (const MeshVariant& variant : mesh_variants()) {
    if (variant.name != "Draco" && variant.name != "meshopt") continue;
    ++seen;
    const TemporaryFolder folder;
    const std::filesystem::path file = variant.write(folder, spoil);
    EXPECT_NE(refused_when(file, [](const SceneSize&) { return false; }).find("corrupt"),
              std::string::npos);
    EXPECT_NE(refused_when(file, [](const SceneSize& size) { return size.decoded_bytes > 0; })
                  .find("too much"),
              std::string::npos);
  }
  EXPECT_EQ(seen, 2);
}

// Two textures of which the second cannot be decoded: their sum is asked for before the first is.
TEST(LoadGltfSize, HoldsAllTexturesBeforeAnyIsDecoded) {
  GltfDocument document;
  document.triangle()["material"] = document.append(
      "materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                    {"emissiveFactor", {1, 1, 1}},
                    {"emissiveTexture", {{"index", 1}}}});
  std::vector<std::uint16_t> noise(4800);  // which does not fit into the file's first bytes
  std::uint32_t state = 1;
  for (std::uint16_t& value : noise) value = static_cast<std::uint16_t>((state *= 48271) >> 8);
  for (int i = 0; i < 2; ++i) {
    Bytes png = png_of(40, 30, noise);
    if (i == 1) std::fill_n(png.begin() + 1000, 2000, std::uint8_t{0x55});
    document.append("textures", {{"source", i}});
    document.append("images", {{"bufferView", document.view(png)}, {"mimeType", "image/png"}});
  }
  const TemporaryFolder folder;
  document.write_glb(folder / "s.glb");
  EXPECT_NE(refused_when(folder / "s.glb", [](const SceneSize&) { return false; }).find("corrupt"),
            std::string::npos);
  std::vector<std::uint64_t> asked;
  EXPECT_NE(refused_when(folder / "s.glb",
                         [&](const SceneSize& size) {
                           asked.push_back(size.texture_bytes);
                           return size.texture_bytes > 1200 * 8;
                         })
                .find("too much"),
            std::string::npos);
  EXPECT_EQ(asked.back(), 2u * 1200 * 8);
}

}  // namespace
}  // namespace ppm::test
