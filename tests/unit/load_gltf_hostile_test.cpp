// Broken and hostile files: each is refused with one line that names the place, and no file
// whatsoever does anything but load or be refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "load_gltf.hpp"
#include "made_document.hpp"
#include "malformed.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

constexpr double kMostSeconds = 5.0;

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

/// The line must be `FILE: place: what is wrong: what would mend it`, and come at once.
void expect_refused(const std::filesystem::path& file, const Malformed& row) {
  const auto start = std::chrono::steady_clock::now();
  const std::string message = refusal(file);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  SCOPED_TRACE(std::string(row.name) + ": \"" + message + "\"");
  EXPECT_LT(spent.count(), kMostSeconds);
  const std::string& place = row.place;
  const std::string prefix = file.string() + ": " + place + (place.empty() ? "" : ": ");
  ASSERT_TRUE(message.starts_with(prefix)) << "the place is not " << place;
  const std::string rest = message.substr(prefix.size());
  const std::size_t words = rest.find(row.words);
  ASSERT_NE(words, std::string::npos) << "not a word of " << row.words;
  EXPECT_NE(rest.find(": ", words), std::string::npos) << "no remedy";
  EXPECT_TRUE(std::ranges::none_of(
      message, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }));
  EXPECT_LT(message.size(), file.string().size() + 500);
}

class Table : public ::testing::TestWithParam<std::vector<Malformed> (*)()> {};

TEST_P(Table, MalformedDocumentsAreRefused) {
  const TemporaryFolder folder;
  const std::vector<Malformed> rows = GetParam()();
  EXPECT_GT(rows.size(), 40u);
  for (const Malformed& row : rows) {
    GltfDocument document = everything();
    row.fault(document.root);
    document.write_gltf(folder / "broken.gltf");
    expect_refused(folder / "broken.gltf", row);
  }
}

INSTANTIATE_TEST_SUITE_P(LoadGltfHostile, Table,
                         ::testing::Values(malformed_structure, malformed_geometry,
                                           malformed_appearance));

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

TEST(LoadGltfHostile, NamesAndExtrasMayBeAnything) {
  GltfDocument document = everything();
  json& root = document.root;
  root["nodes"][1]["name"] = 3;
  root["materials"][0]["name"] = json::array();
  root["materials"][0]["extras"] = 3;
  root["meshes"][0]["extras"] = {{"a", {{"b", {1e300, -1, 4294967296}}}}};
  root["asset"]["generator"] = nullptr;
  root["unheard-of"] = {1, 2};
  const scene::Scene scene = load(document);
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.materials.at(0).name, "");
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
      {"short.bin", "has 8 bytes, but byteLength claims 36"},
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

// glTF lets a file be longer than its buffer; percent-encoded names and folders below are files,
// too.
TEST(LoadGltfHostile, FilesBesideMayBeLonger) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a folder");
  GltfDocument document;
  document.triangle();
  document.root["buffers"].push_back(
      {{"byteLength", 4}, {"uri", "data:application/octet-stream;base64,AAAAAA=="}});
  document.root["buffers"].push_back({{"byteLength", 4}, {"uri", "last.bin"}});
  document.root["buffers"][0]["uri"] = "a%20folder/100%25.bin";
  Bytes longer = document.binary;
  longer.resize(longer.size() + 3);
  write_file(folder / "a folder/100%.bin", longer);
  write_file(folder / "last.bin", Bytes(9));
  document.write_gltf(folder / "a.gltf");
  EXPECT_EQ(refusal(folder / "a.gltf"), "");
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
      {"no number", text("{\"asset\": NaN}"), "cannot be read"},
      {"infinity", text("{\"asset\": -Infinity}"), "cannot be read"},
      {"comment", text("{/* glTF */ \"asset\": {\"version\": \"2.0\"}}"), "cannot be read"},
      {"quotes", text("{'asset': {}}"), "cannot be read"},
      {"two documents", text("{\"asset\": {\"version\": \"2.0\"}} {}"), "cannot be read"},
      {"utf-16", text(std::string("{\0\"\0a\0", 6)), "cannot be read"},
      {"zeros", Bytes(1000, 0), "neither"},
      {"web page", text("<!DOCTYPE html>"), "neither"},
      {"trailing comma", text("{\"asset\": {},}"), "cannot be read"},
      {"not utf-8", text("{\"asset\": \"\xff\xfe\"}"), "cannot be read"},
      {"infinite number", text("{\"asset\": {\"version\": 1e999}}"), "cannot be read"},
      {"asset null", text("{\"asset\": null}"), "asset: is not"},
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

TEST(LoadGltfHostile, EveryBeginningOfAContainerIsCutShort) {
  const Bytes good = everything().glb();
  const TemporaryFolder folder;
  for (std::size_t size = 4; size < good.size(); size += size < 30 ? 1 : 37) {
    write_file(folder / "a.glb", Bytes(good.begin(), good.begin() + static_cast<long>(size)));
    const std::string message = refusal(folder / "a.glb");
    ASSERT_NE(message.find(size < 20 ? "ends within its header" : "is cut short"),
              std::string::npos)
        << size << ": " << message;
  }
}

// What is legal is no reason to refuse, however odd.
TEST(LoadGltfHostile, DeepAndWideGraphsLoad) {
  GltfDocument deep, wide;
  for (GltfDocument* document : {&deep, &wide}) document->triangle();
  json children = json::array();
  for (int i = 1; i <= 100000; ++i) {
    deep.append("nodes", {{"children", {i - 1}}});
    wide.append("nodes", json::object());
    children.push_back(i);
  }
  wide.root["nodes"][0]["children"] = children;
  for (const GltfDocument* document : {&deep, &wide}) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(load(*document).triangles.size(), 1u);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    EXPECT_LT(spent.count(), kMostSeconds);
  }
}

// A node without extent shows nothing; the others do. Triangles without area are counted.
TEST(LoadGltfHostile, SingularTransformsHideTheirMeshes) {
  for (const json& scale : {json{0, 0, 0}, json{1, 0, 0}, json{1, 1e-300, 1}}) {
    GltfDocument document;
    document.triangle();
    document.append("nodes", {{"mesh", 0}, {"scale", scale}});
    Log log(Verbosity::quiet);
    EXPECT_EQ(load(document, log).triangles.size(), 1u) << scale;
    EXPECT_EQ(warnings_with(log, "1 triangles without area were left out"), 1u) << scale;
    EXPECT_EQ(log.warnings().size(), 1u);
  }
}

Bytes bytes_of_text(const std::string& text) {
  return {text.begin(), text.end()};
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
      {"bmp header", {'B', 'M', 0, 0, 0, 1, 0, 0, 0, 0}, "images[0]: "},
      {"tiff header", {'I', 'I', '*', 0, 8, 0, 0, 0, 0xff, 0xff}, "images[0]: "},
      {"webp header",
       {'R', 'I', 'F', 'F', 0xff, 0xff, 0xff, 0xff, 'W', 'E', 'B', 'P', 'V', 'P', '8', 'L'},
       "images[0]: "},
      {"exr header", {0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0, 'c', 'h'}, "images[0]: "},
      {"hdr of 10^12 texels",
       bytes_of_text("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 1000000\n"),
       "images[0]: "},
      {"hdr without texels",
       bytes_of_text("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 10000 +X 10000\n"), "images[0]: "},
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
