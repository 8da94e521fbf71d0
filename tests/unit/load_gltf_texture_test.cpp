// Textures: image files of every kind, samplers, coordinates and what materials make of them.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "load_gltf.hpp"
#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;
using scene::Material;
using scene::Scene;
using scene::Texture;
using scene::TextureUse;
using scene::Wrap;

/// A document of one triangle with this material, whose texture 0 shows this image file.
GltfDocument with_textured_material(json material, const Bytes& image) {
  GltfDocument document;
  document.triangle()["material"] = document.append("materials", std::move(material));
  document.append("textures", {{"source", 0}});
  document.append("images", {{"bufferView", document.view(image)}, {"mimeType", "image/png"}});
  return document;
}

/// The image is the material's base colour.
GltfDocument with_texture(const Bytes& image, json sampler = json()) {
  GltfDocument document = with_textured_material(
      {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}, image);
  if (!sampler.is_null()) {
    document.root["textures"][0]["sampler"] = document.append("samplers", std::move(sampler));
  }
  return document;
}

Bytes small_png() {
  return png_of(1, 1, std::vector<std::uint8_t>{1, 2, 3, 255});
}

double srgb_to_linear(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

TEST(LoadGltfTextures, CodesOfEightBitsStay) {
  const std::vector<std::uint8_t> rgba{0,  10, 11, 0,  255, 128, 188, 255,  //
                                       64, 1,  2,  51, 200, 100, 50,  128};
  const Scene scene = load(with_texture(png_of(2, 2, rgba)));
  ASSERT_EQ(scene.materials[0].base_color_texture, (TextureUse{0, 0, {1, 0, 0}, {0, 1, 0}}));
  const Texture& texture = scene.textures.at(0);
  EXPECT_EQ(texture.width, 2u);
  EXPECT_EQ(texture.height, 2u);
  EXPECT_TRUE(texture.srgb);
  EXPECT_TRUE(texture.halves.empty());
  ASSERT_EQ(texture.rgba8.size(), 4u);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(texture.rgba8[i / 4][static_cast<int>(i % 4)], rgba[i]) << i;
  }
}

TEST(LoadGltfTextures, ThoseOfSixteenBitsBecomeLinearHalfFloats) {
  const std::vector<std::uint16_t> rgba{32767, 1000, 65535, 49151};
  const Texture texture = load(with_texture(png_of(1, 1, rgba))).textures.at(0);
  EXPECT_FALSE(texture.srgb);
  EXPECT_TRUE(texture.rgba8.empty());
  const glm::vec4 texel(glm::unpackHalf4x16(std::bit_cast<std::uint64_t>(texture.halves.at(0))));
  EXPECT_NEAR(texel.x, srgb_to_linear(32767.0 / 65535.0), 0x1p-14);
  EXPECT_NEAR(texel.y, 1000.0 / 65535.0 / 12.92, 0x1p-21);
  EXPECT_EQ(texel.z, 1.0f);
  EXPECT_NEAR(texel.w, 0.75, 0x1p-12);
}

TEST(LoadGltfTextures, Jpeg) {
  GltfDocument document = with_texture({});
  document.root["images"][0] = {{"uri", std::string("data:image/jpeg;base64,") + kGreyJpegBase64}};
  const Texture texture = load(document).textures.at(0);
  ASSERT_EQ(texture.rgba8.size(), 64u);
  for (const glm::u8vec4 texel : texture.rgba8) {
    EXPECT_EQ(texel.y, 128);
    EXPECT_EQ(texel.w, 255);
  }
}

/// A file of 5 x 3 texels in which row, column and channel can be told apart, written by
/// OpenImageIO.
Bytes file_of(const char* format, OIIO::TypeDesc type, int channels, int tile) {
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  OIIO::ImageSpec spec(5, 3, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("compression", std::string(format) == "webp" ? "lossless" : "zip");
  spec.tile_width = spec.tile_height = tile;
  std::vector<float> values;
  for (int i = 0; i < 15 * channels; ++i) {
    const bool is_alpha = channels == 4 && i % 4 == 3;
    values.push_back(is_alpha ? 1.0f : static_cast<float>(i * 4) / 255.0f);
  }
  const auto output = OIIO::ImageOutput::create(format);
  const bool written = output && output->set_ioproxy(&memory) &&
                       output->open(std::string("image.") + format, spec) &&
                       output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close();
  EXPECT_TRUE(written) << format << ": " << (output ? output->geterror() : OIIO::geterror());
  return bytes;
}

TEST(LoadGltfTextures, FormatsAreToldByTheirBytes) {
  struct Case {
    const char* format;
    OIIO::TypeDesc::BASETYPE type;
    int channels, tile;
    double tolerance;  // of RGBE's shared exponent and of halves; 0 for bytes
  };
  const Case cases[] = {{"png", OIIO::TypeDesc::UINT8, 3, 0, 0.0},
                        {"tiff", OIIO::TypeDesc::UINT8, 4, 0, 0.0},
                        {"tiff", OIIO::TypeDesc::UINT8, 3, 16, 0.0},
                        {"tiff", OIIO::TypeDesc::FLOAT, 3, 0, 1e-3},
                        {"bmp", OIIO::TypeDesc::UINT8, 3, 0, 0.0},
                        {"openexr", OIIO::TypeDesc::HALF, 4, 0, 1e-3},
                        {"openexr", OIIO::TypeDesc::FLOAT, 3, 16, 1e-3},
                        {"hdr", OIIO::TypeDesc::FLOAT, 3, 0, 1e-2},
                        {"webp", OIIO::TypeDesc::UINT8, 4, 0, 0.0}};
  for (const auto& [format, type, channels, tile, tolerance] : cases) {
    SCOPED_TRACE(format);
    GltfDocument document = with_texture(file_of(format, type, channels, tile));
    const Texture texture = load(document).textures.at(0);
    EXPECT_EQ(texture.width, 5u);
    EXPECT_EQ(texture.height, 3u);
    EXPECT_EQ(texture.srgb, tolerance == 0.0);
    for (std::size_t i = 0; i < 15; ++i) {
      for (int c = 0; c < 3; ++c) {
        const double expected = static_cast<double>(static_cast<int>(i) * channels + c) * 4.0;
        if (tolerance == 0.0) {
          // OpenImageIO 2.4 cannot write WebP without loss.
          EXPECT_NEAR(texture.rgba8.at(i)[c], expected, format == std::string("webp") ? 8.0 : 0.0);
        } else {
          const float value = glm::unpackHalf1x16(texture.halves.at(i)[c]);
          EXPECT_NEAR(value, expected / 255.0, tolerance) << i;
        }
      }
    }
  }
}

TEST(LoadGltfTextures, NoMoreIsAllocatedThanAFileCanHold) {
  // 16384 x 16384 texels in a file of some 300 bytes: of an OpenEXR file the data window is said.
  Bytes exr = file_of("openexr", OIIO::TypeDesc::HALF, 3, 0);
  const std::string name("dataWindow\0box2i\0\x10\0\0\0", 21);
  const auto at = std::search(exr.begin(), exr.end(), name.begin(), name.end());
  ASSERT_NE(at, exr.end());
  for (const std::uint8_t high : Bytes{0x3f, 0x7f}) {
    Bytes lying = exr;
    lying[static_cast<std::size_t>(at - exr.begin()) + 21 + 12 + (high == 0x3f ? 1 : 3)] = high;
    const TemporaryFolder folder;
    with_texture(lying).write_glb(folder / "scene.glb");
    EXPECT_NE(refusal(folder / "scene.glb"), "") << int(high);
  }
}

// Whatever one byte of a file becomes and wherever it ends: it is read, or refused in one line.
// Under the sanitizers this looks for what the libraries do besides.
TEST(LoadGltfTextures, BrokenFilesOfEveryFormatAreReadOrRefused) {
  struct Case {
    const char* format;
    OIIO::TypeDesc::BASETYPE type;
    int tile;
  };
  const TemporaryFolder folder;
  const auto file = folder / "scene.glb";
  std::uint32_t state = 1;
  for (const auto& [format, type, tile] :
       {Case{"tiff", OIIO::TypeDesc::UINT8, 0}, Case{"tiff", OIIO::TypeDesc::FLOAT, 16},
        Case{"bmp", OIIO::TypeDesc::UINT8, 0}, Case{"openexr", OIIO::TypeDesc::HALF, 0},
        Case{"openexr", OIIO::TypeDesc::FLOAT, 16}, Case{"hdr", OIIO::TypeDesc::FLOAT, 0},
        Case{"webp", OIIO::TypeDesc::UINT8, 0}}) {
    const Bytes whole = file_of(format, type, 3, tile);
    std::size_t refused = 0;
    for (int i = 0; i < 120; ++i) {
      SCOPED_TRACE(std::string(format) + " " + std::to_string(i));
      state = state * 1664525u + 1013904223u;
      Bytes broken = whole;
      if (i % 8 == 0) {
        broken.resize(whole.size() * (state >> 8 & 0xffu) / 256);
      } else {
        // Headers come first, and have most to lie about.
        const std::size_t reach =
            i % 2 == 0 ? whole.size() : std::min<std::size_t>(whole.size(), 200);
        broken[(state >> 8) % reach] = i % 3 == 0 ? 0xff : static_cast<std::uint8_t>(state >> 3);
      }
      with_texture(broken).write_glb(file);
      refused += refusal(file).empty() ? 0u : 1u;  // throws what is no refusal
    }
    EXPECT_GT(refused, 15u) << format;
  }
}

TEST(LoadGltfTextures, WebpComesBeforeTheTexturesOwnSource) {
  GltfDocument document = with_texture(small_png());
  const Bytes webp = file_of("webp", OIIO::TypeDesc::UINT8, 4, 0);
  document.append("images", {{"bufferView", document.view(webp)}, {"mimeType", "image/webp"}});
  document.root["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 1}}}};
  document.root["extensionsUsed"] = document.root["extensionsRequired"] = {"EXT_texture_webp"};
  EXPECT_EQ(load(document).textures.at(0).width, 5u);
  document.root["textures"][0].erase("source");
  EXPECT_EQ(load(document).textures.at(0).width, 5u);
}

TEST(LoadGltfTextures, BasisUniversalIsRefusedWhereRequiredAndElseTheOtherSourceIsRead) {
  GltfDocument document = with_texture(small_png());
  document.root["textures"][0]["extensions"] = {{"KHR_texture_basisu", {{"source", 1}}}};
  document.root["extensionsUsed"] = {"KHR_texture_basisu"};
  Log log(Verbosity::quiet);
  EXPECT_EQ(load(document, log).textures.size(), 1u);
  EXPECT_EQ(warnings_with(log, "KHR_texture_basisu"), 1u);
  document.root["extensionsRequired"] = {"KHR_texture_basisu"};
  const TemporaryFolder folder;
  document.write_gltf(folder / "scene.gltf");
  EXPECT_NE(refusal(folder / "scene.gltf").find("KHR_texture_basisu"), std::string::npos);
}

TEST(LoadGltfTextures, Samplers) {
  const Texture plain = load(with_texture(small_png())).textures.at(0);
  EXPECT_EQ(plain.wrap_s, Wrap::repeat);
  EXPECT_EQ(plain.wrap_t, Wrap::repeat);
  EXPECT_FALSE(plain.nearest);
  const Texture other =
      load(with_texture(small_png(), {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}))
          .textures.at(0);
  EXPECT_EQ(other.wrap_s, Wrap::clamp_to_edge);
  EXPECT_EQ(other.wrap_t, Wrap::mirrored_repeat);
  EXPECT_TRUE(other.nearest);
}

TEST(LoadGltfTextures, AreSharedAndMayBeFilesOrDataUris) {
  const glm::u8vec4 texel(1, 2, 3, 255);
  GltfDocument document = with_texture(small_png());
  document.triangle()["material"] = document.append("materials", document.root["materials"][0]);
  document.append("textures", {{"source", 0}});
  document.root["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
  EXPECT_EQ(load(document).textures.size(), 1u);
  document.root["images"][0] = {{"uri", "data:image/png;base64," + base64(small_png())}};
  EXPECT_EQ(load(document).textures.at(0).rgba8.at(0), texel);

  const TemporaryFolder folder;
  Log log(Verbosity::quiet);
  write_file(folder / "a wh\xc3\xafte%.png", small_png());
  document.root["images"][0] = {{"uri", "a%20wh%C3%AFte%25.png"}};
  document.write_gltf(folder / "scene.gltf");
  EXPECT_EQ(scene::load_gltf(folder / "scene.gltf", log).textures.at(0).rgba8.at(0), texel);
}

TEST(LoadGltfTextures, TheSameImageMayBeColoursAndData) {
  const Scene scene = load(with_textured_material(
      {{"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
       {"emissiveTexture", {{"index", 0}}},
       {"emissiveFactor", {1, 1, 1}}},
      small_png()));
  ASSERT_EQ(scene.textures.size(), 2u);
  const Material& material = scene.materials[0];
  EXPECT_TRUE(scene.textures[material.base_color_texture.value().texture].srgb);
  EXPECT_FALSE(scene.textures[material.metallic_roughness_texture.value().texture].srgb);
  EXPECT_EQ(material.emissive_texture.value().texture, material.base_color_texture.value().texture);
}

TEST(LoadGltfTextures, EveryUse) {
  const json texture = {{"index", 0}};
  const Material material =
      load(with_textured_material(
               {{"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                {"extensions",
                 {{"KHR_materials_specular",
                   {{"specularTexture", texture}, {"specularColorTexture", texture}}},
                  {"KHR_materials_transmission",
                   {{"transmissionFactor", 1}, {"transmissionTexture", texture}}},
                  {"KHR_materials_clearcoat",
                   {{"clearcoatFactor", 1},
                    {"clearcoatTexture", texture},
                    {"clearcoatRoughnessTexture", texture}}}}}},
               small_png()))
          .materials.at(0);
  EXPECT_EQ(material.normal_scale, 0.5f);
  for (const scene::OptionalTextureUse* use :
       {&material.normal_texture, &material.specular_texture, &material.transmission_texture,
        &material.clearcoat_texture, &material.clearcoat_roughness_texture}) {
    EXPECT_EQ(use->value().texture, material.normal_texture.value().texture);
  }
  EXPECT_NE(material.specular_color_texture.value().texture,
            material.specular_texture.value().texture);
}

TEST(LoadGltfTextures, AlphaModesWithoutEffectAreOpaque) {
  struct Case {
    const char* mode;
    double factor;
    std::uint8_t texel;
    bool stays;
  };
  for (const auto& [mode, factor, texel, stays] :
       {Case{"BLEND", 1.0, 255, false}, Case{"BLEND", 0.5, 255, true},
        Case{"BLEND", 1.0, 254, true}, Case{"MASK", 1.0, 128, false}, Case{"MASK", 1.0, 127, true},
        Case{"MASK", 0.5, 254, true}, Case{"OPAQUE", 0.5, 0, false}}) {
    const Bytes image = png_of(2, 1, std::vector<std::uint8_t>{0, 0, 0, 255, 0, 0, 0, texel});
    const Scene scene = load(with_textured_material(
        {{"alphaMode", mode},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 1, 1, factor}}, {"baseColorTexture", {{"index", 0}}}}}},
        image));
    EXPECT_EQ(scene.materials[0].alpha_mode != scene::AlphaMode::opaque, stays)
        << mode << " " << factor << " " << int(texel);
  }
}

// The values are worked out by hand: first scaled, then turned counter-clockwise as one sees it
// where v points down, then moved.
TEST(LoadGltfTextures, Transforms) {
  const auto use_of = [](json transform) {
    const json info = {{"index", 0},
                       {"texCoord", 1},
                       {"extensions", {{"KHR_texture_transform", std::move(transform)}}}};
    return load(with_textured_material({{"pbrMetallicRoughness", {{"baseColorTexture", info}}}},
                                       small_png()))
        .materials.at(0)
        .base_color_texture.value();
  };
  const auto at = [](const TextureUse& use, float u, float v) {
    return glm::vec2(glm::dot(use.row_s, glm::vec3(u, v, 1)),
                     glm::dot(use.row_t, glm::vec3(u, v, 1)));
  };
  const TextureUse scaled = use_of({{"offset", {0.25, -1}}, {"scale", {2, -3}}});
  EXPECT_EQ(at(scaled, 1.0f, 1.0f), glm::vec2(2.25f, -4.0f));
  EXPECT_EQ(scaled.texcoord_set, 1u);
  // The specification's example, which shows the lower left quarter of the image: its corners.
  const TextureUse example =
      use_of({{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}});
  const auto expect_near = [](glm::vec2 a, glm::vec2 b) { EXPECT_LT(glm::length(a - b), 1e-6f); };
  expect_near(at(example, 0, 0), {0.0f, 1.0f});
  expect_near(at(example, 1, 0), {0.0f, 0.5f});
  expect_near(at(example, 0, 1), {0.5f, 1.0f});
  expect_near(at(example, 1, 1), {0.5f, 0.5f});
  // Not a similarity: scale comes before rotation. (1, 1) -> (2, 1) -> 30 degrees.
  const TextureUse turned = use_of({{"rotation", 0.5235987755982988}, {"scale", {2, 1}}});
  expect_near(at(turned, 1, 1), {2.2320508f, -0.1339746f});
  EXPECT_EQ(use_of({{"texCoord", 0}}).texcoord_set, 0u);
}

}  // namespace
}  // namespace ppm::test
