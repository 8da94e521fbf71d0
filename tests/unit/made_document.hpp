// glTF files put together accessor by accessor, so that tests can bend every part of them.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "load_gltf.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {

using Bytes = std::vector<std::uint8_t>;

/// glTF's componentType of a C++ type.
template <typename T>
inline constexpr int kComponentType = 0;
template <>
inline constexpr int kComponentType<std::int8_t> = 5120;
template <>
inline constexpr int kComponentType<std::uint8_t> = 5121;
template <>
inline constexpr int kComponentType<std::int16_t> = 5122;
template <>
inline constexpr int kComponentType<std::uint16_t> = 5123;
template <>
inline constexpr int kComponentType<std::uint32_t> = 5125;
template <>
inline constexpr int kComponentType<float> = 5126;

/// Values as they lie in memory.
template <typename T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A document with one buffer. `root` may be bent at will before it is written.
struct GltfDocument {
  nlohmann::json root = {{"asset", {{"version", "2.0"}}}};
  Bytes binary;

  /// Appends a bufferView and returns its index.
  std::size_t view(const Bytes& bytes);
  /// Appends an accessor of tightly packed `values` and returns its index.
  template <typename T>
  std::size_t accessor(const std::vector<T>& values, const char* type, bool normalized = false) {
    const std::size_t components = static_cast<std::size_t>(type[0] == 'S' ? 1 : type[3] - '0');
    nlohmann::json item = {{"bufferView", view(bytes_of(values))},
                           {"componentType", kComponentType<T>},
                           {"type", type},
                           {"count", values.size() / components}};
    if (normalized) item["normalized"] = true;
    return append("accessors", std::move(item));
  }
  /// Appends to a top-level array and returns the item's index.
  std::size_t append(const char* array, nlohmann::json item);
  /// Appends a mesh of one primitive with these attributes, and a node that holds it. Returns the
  /// primitive.
  nlohmann::json& mesh(nlohmann::json attributes);
  /// The same of the triangle (0,0,0), (1,0,0), (0,1,0).
  nlohmann::json& triangle();

  /// The buffer as a data URI.
  void write_gltf(const std::filesystem::path& file) const;
  void write_glb(const std::filesystem::path& file) const;
  Bytes glb() const;
};

/// A sound file with a little of everything that the loader reads: one mesh, a texture, a light, a
/// camera.
GltfDocument everything();
/// The same with this file as its image.
GltfDocument with_image(const Bytes& image);

/// A PNG file of RGBA texels, row-major from the top, 8 or 16 bits a channel.
Bytes png_of(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba);
Bytes png_of(std::uint32_t width, std::uint32_t height, const std::vector<std::uint16_t>& rgba);

/// A baseline JPEG file of 8 x 8 texels of code 128.
extern const char* const kGreyJpegBase64;

std::string base64(const Bytes& bytes);
void write_file(const std::filesystem::path& file, const Bytes& bytes);
void write_file(const std::filesystem::path& file, const std::string& text);

/// Writes the document as a .gltf file and loads it, quietly.
scene::Scene load(const GltfDocument& document, Log& log);
scene::Scene load(const GltfDocument& document);
/// The message with which a file is refused, or nothing where it loads. Throws what is no refusal.
std::string refusal(const std::filesystem::path& file);
/// How many of the log's warnings contain `fragment`.
std::size_t warnings_with(const Log& log, const std::string& fragment);

/// Corners back in world space, which frames cannot change.
std::array<glm::dvec3, 3> world_corners(const scene::Scene& scene, std::size_t triangle);
/// Fails the test unless the two lie within `tolerance` of each other.
void expect_near(glm::dvec3 actual, glm::dvec3 expected, double tolerance, const char* what);
/// Fails the test unless the triangle's corners are these in world space, but for one rounding to
/// float of working coordinates of at most 1: half an ulp is 6e-8.
void expect_corners(const scene::Scene& scene, std::size_t triangle,
                    const std::array<glm::dvec3, 3>& expected);
/// Of the front side, from the corners.
glm::vec3 geometric_normal(const scene::Triangle& triangle);

}  // namespace ppm::test
