#include "made_document.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "failure.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

void put_little_endian(Bytes& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift & 0xffu));
}

void put_big_endian(Bytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift & 0xffu));
}

void put(Bytes& out, const std::string& text) {
  out.insert(out.end(), text.begin(), text.end());
}

/// CRC-32 of PNG and zip (ISO 3309).
std::uint32_t crc32(const Bytes& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

std::uint32_t adler32(const Bytes& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

void put_png_chunk(Bytes& out, const std::string& type, const Bytes& data) {
  put_big_endian(out, static_cast<std::uint32_t>(data.size()));
  Bytes body(type.begin(), type.end());
  body.insert(body.end(), data.begin(), data.end());
  out.insert(out.end(), body.begin(), body.end());
  put_big_endian(out, crc32(body));
}

/// One stored (uncompressed) deflate block in a zlib stream; at most 65535 bytes.
Bytes zlib_stored(const Bytes& data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  if (size > 65535) throw std::invalid_argument("too large for one stored block");
  Bytes out{0x78, 0x01, 0x01};
  out.push_back(static_cast<std::uint8_t>(size & 0xffu));
  out.push_back(static_cast<std::uint8_t>(size >> 8));
  out.push_back(static_cast<std::uint8_t>(~size & 0xffu));
  out.push_back(static_cast<std::uint8_t>(~size >> 8 & 0xffu));
  out.insert(out.end(), data.begin(), data.end());
  put_big_endian(out, adler32(data));
  return out;
}

Bytes png_of_bytes(std::uint32_t width, std::uint32_t height, std::uint8_t bits,
                   const std::vector<std::uint8_t>& rgba) {
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  put_big_endian(header, width);
  put_big_endian(header, height);
  header.insert(header.end(), {bits, 6, 0, 0, 0});  // RGBA, no interlacing
  put_png_chunk(out, "IHDR", header);
  Bytes rows;
  const std::size_t row_bytes = std::size_t{4} * width * bits / 8;
  for (std::size_t start = 0; start < rgba.size(); start += row_bytes) {
    rows.push_back(0);  // no filter
    for (std::size_t i = start; i < start + row_bytes; ++i) rows.push_back(rgba[i]);
  }
  put_png_chunk(out, "IDAT", zlib_stored(rows));
  put_png_chunk(out, "IEND", {});
  return out;
}

}  // namespace

std::size_t GltfDocument::append(const char* array, json item) {
  root[array].push_back(std::move(item));
  return root[array].size() - 1;
}

std::size_t GltfDocument::view(const Bytes& bytes) {
  while (binary.size() % 4 != 0) binary.push_back(0);
  const std::size_t offset = binary.size();
  binary.insert(binary.end(), bytes.begin(), bytes.end());
  root["buffers"] = json::array({{{"byteLength", binary.size()}}});
  return append("bufferViews",
                {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

json& GltfDocument::mesh(json attributes) {
  const std::size_t index =
      append("meshes", {{"primitives", json::array({{{"attributes", std::move(attributes)}}})}});
  append("nodes", {{"mesh", index}});
  return root["meshes"][index]["primitives"][0];
}

json& GltfDocument::triangle() {
  return mesh({{"POSITION", accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}});
}

void GltfDocument::write_gltf(const std::filesystem::path& file) const {
  json whole = root;
  const json::json_pointer first("/buffers/0");
  const bool has_place = whole["buffers"].is_array() && whole.contains(first);
  if (!binary.empty() && has_place && whole[first].is_object() && !whole[first].contains("uri")) {
    whole[first]["uri"] = "data:application/octet-stream;base64," + base64(binary);
  }
  write_file(file, whole.dump());
}

Bytes GltfDocument::glb() const {
  std::string text = root.dump();
  while (text.size() % 4 != 0) text += ' ';
  Bytes padded = binary;
  while (padded.size() % 4 != 0) padded.push_back(0);
  Bytes out;
  put(out, "glTF");
  put_little_endian(out, 2);
  put_little_endian(out, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + padded.size()));
  put_little_endian(out, static_cast<std::uint32_t>(text.size()));
  put(out, "JSON");
  put(out, text);
  put_little_endian(out, static_cast<std::uint32_t>(padded.size()));
  put(out, std::string("BIN\0", 4));
  out.insert(out.end(), padded.begin(), padded.end());
  return out;
}

void GltfDocument::write_glb(const std::filesystem::path& file) const {
  write_file(file, glb());
}

GltfDocument everything() {
  GltfDocument document;
  json& root = document.root;
  json& primitive = document.triangle();
  primitive["attributes"]["NORMAL"] = document.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  primitive["attributes"]["TEXCOORD_0"] =
      document.accessor<std::uint16_t>({0, 0, 65535, 0, 0, 65535}, "VEC2", true);
  primitive["attributes"]["COLOR_0"] =
      document.accessor<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255}, "VEC3", true);
  primitive["indices"] = document.accessor<std::uint16_t>({0, 1, 2, 2, 1, 0}, "SCALAR");
  primitive["material"] = 0;
  root["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", document.view({1, 0})}, {"componentType", 5123}}},
      {"values", {{"bufferView", document.view(bytes_of<float>({2, 0, 0}))}}}};
  root["materials"] = {
      {{"pbrMetallicRoughness", {{"metallicFactor", 0.5}, {"baseColorTexture", {{"index", 0}}}}},
       {"extensions",
        {{"KHR_materials_volume", {{"thicknessFactor", 1}, {"attenuationDistance", 2}}}}}}};
  document.append("textures", {{"source", 0}, {"sampler", 0}});
  document.append("samplers", {{"wrapS", 33071}});
  document.append(
      "images", {{"mimeType", "image/png"},
                 {"bufferView",
                  document.view(png_of(2, 1, std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}))}});
  root["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"intensity", 5}, {"spot", json::object()}}};
  document.append("cameras",
                  {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  document.append("nodes", {{"camera", 0}, {"rotation", {0, 0, 0, 1}}, {"children", {0}}});
  document.append(
      "nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"scale", {1, 2, 3}}});
  root["scenes"] = {{{"nodes", {1, 2}}}};
  root["scene"] = 0;
  return document;
}

GltfDocument with_image(const Bytes& image) {
  GltfDocument document = everything();
  document.root["images"][0]["bufferView"] = document.view(image);
  return document;
}

Bytes png_of(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba) {
  return png_of_bytes(width, height, 8, rgba);
}

Bytes png_of(std::uint32_t width, std::uint32_t height, const std::vector<std::uint16_t>& rgba) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint16_t code : rgba) {
    bytes.push_back(static_cast<std::uint8_t>(code >> 8));
    bytes.push_back(static_cast<std::uint8_t>(code & 0xffu));
  }
  return png_of_bytes(width, height, 16, bytes);
}

const char* const kGreyJpegBase64 =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsL"
    "EBYQERMUFRUVDA8XGBYUGBIUFRT/2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQU"
    "FBQUFBQUFBQUFBQUFBQUFBQUFBT/wAARCAAIAAgDASIAAhEBAxEB/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcI"
    "CQoL/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRol"
    "JicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ip"
    "qrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/8QAHwEAAwEBAQEBAQEBAQAAAAAA"
    "AAECAwQFBgcICQoL/8QAtREAAgECBAQDBAcFBAQAAQJ3AAECAxEEBSExBhJBUQdhcRMiMoEIFEKRobHBCSMzUvAVYnLR"
    "ChYkNOEl8RcYGRomJygpKjU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6goOEhYaHiImKkpOUlZaX"
    "mJmaoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4uPk5ebn6Onq8vP09fb3+Pn6/9oADAMBAAIRAxEA"
    "PwAooooA/9k=";

std::string base64(const Bytes& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = std::uint32_t{bytes[i]} << 16;
    if (i + 1 < bytes.size()) bits |= std::uint32_t{bytes[i + 1]} << 8;
    if (i + 2 < bytes.size()) bits |= bytes[i + 2];
    for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[bits >> shift & 63u];
  }
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  for (std::size_t i = 0; i < padding; ++i) text[text.size() - 1 - i] = '=';
  return text;
}

void write_file(const std::filesystem::path& file, const Bytes& bytes) {
  std::filesystem::remove(file);  // some file systems flush to disk what is overwritten in place
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  write_file(file, Bytes(text.begin(), text.end()));
}

scene::Scene load(const GltfDocument& document, Log& log) {
  const TemporaryFolder folder;
  document.write_gltf(folder / "scene.gltf");
  return scene::load_gltf(folder / "scene.gltf", log);
}

scene::Scene load(const GltfDocument& document) {
  Log log(Verbosity::quiet);
  return load(document, log);
}

std::string refusal(const std::filesystem::path& file) {
  Log log(Verbosity::quiet);
  try {
    scene::load_gltf(file, log);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

std::size_t warnings_with(const Log& log, const std::string& fragment) {
  std::size_t count = 0;
  for (const std::string& warning : log.warnings())
    count += warning.find(fragment) != std::string::npos;
  return count;
}

std::array<glm::dvec3, 3> world_corners(const scene::Scene& scene, std::size_t triangle) {
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = scene.frame.to_world(glm::dvec3(scene.triangles.at(triangle).corners[i].position));
  }
  return corners;
}

void expect_near(glm::dvec3 actual, glm::dvec3 expected, double tolerance, const char* what) {
  EXPECT_LE(glm::length(actual - expected), tolerance)
      << what << ": (" << actual.x << ", " << actual.y << ", " << actual.z << ") instead of ("
      << expected.x << ", " << expected.y << ", " << expected.z << ")";
}

void expect_corners(const scene::Scene& scene, std::size_t triangle,
                    const std::array<glm::dvec3, 3>& expected) {
  const std::array<glm::dvec3, 3> actual = world_corners(scene, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_near(actual[i], expected[i], 1e-7 / scene.frame.scale, "corner");
  }
}

glm::vec3 geometric_normal(const scene::Triangle& triangle) {
  const auto& c = triangle.corners;
  return glm::normalize(glm::cross(c[1].position - c[0].position, c[2].position - c[0].position));
}

}  // namespace ppm::test
