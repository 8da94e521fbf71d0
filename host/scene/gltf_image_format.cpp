#include "gltf_image_format.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace ppm::scene::gltf {
namespace {

constexpr std::ptrdiff_t kMostScans =
    200;  // a progressive JPEG of a few KB can ask for hours of them
constexpr std::int64_t kLargestSide = 16384;
constexpr std::size_t kLongestName = 255;

bool has_at(ByteView bytes, std::size_t at, std::string_view text) {
  return bytes.size() >= at + text.size() && std::memcmp(&bytes[at], text.data(), text.size()) == 0;
}

/// How often the marker that begins a scan stands in a JPEG; in coded data it cannot.
std::ptrdiff_t scan_count(ByteView bytes) {
  std::ptrdiff_t count = 0;
  for (std::size_t i = 1; i < bytes.size(); ++i) count += bytes[i - 1] == 0xff && bytes[i] == 0xda;
  return count;
}

/// Whether the chunks of a PNG file are all there. Where libpng meets the end of a file early,
/// OpenImageIO 2.4 jumps away from a string that it then leaks.
bool is_whole_png(ByteView bytes) {
  constexpr std::size_t kChunkBytes = 12;  // length, type and checksum around the data
  bool has_data = false;
  for (std::size_t at = 8; at + kChunkBytes <= bytes.size();) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | bytes[at + i];
    if (length > bytes.size() - at - kChunkBytes) return false;
    if (has_at(bytes, at + 4, "IEND")) return has_data;
    has_data = has_data || has_at(bytes, at + 4, "IDAT");
    at += kChunkBytes + length;
  }
  return false;
}

std::int64_t little_endian(ByteView bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{bytes[at + i]} << (8 * i);
  return static_cast<std::int32_t>(value);
}

/// The end of the zero-terminated text at `at`, or nothing.
std::optional<std::size_t> end_of_text(ByteView bytes, std::size_t at) {
  const std::size_t last = std::min(bytes.size(), at + kLongestName + 1);
  for (std::size_t i = at; i < last; ++i) {
    if (bytes[i] == 0) return i;
  }
  return std::nullopt;
}

/// Of an OpenEXR file of one part, whose header is a list of (name, type, size, value): OpenEXR
/// makes tables as long as the data window is high before it knows whether the file holds them.
std::string danger_in_exr(ByteView bytes) {
  constexpr std::uint8_t kMultiPart = 0x10, kDeep = 0x08;
  if (bytes.size() < 8 || (bytes[5] & (kMultiPart | kDeep)) != 0) return "has several parts";
  std::size_t at = 8;
  while (at < bytes.size() && bytes[at] != 0) {
    const auto name_end = end_of_text(bytes, at);
    const auto type_end = name_end ? end_of_text(bytes, *name_end + 1) : std::nullopt;
    if (!type_end || *type_end + 5 > bytes.size()) break;
    const std::int64_t size = little_endian(bytes, *type_end + 1);
    const std::size_t value = *type_end + 5;
    if (size < 0 || static_cast<std::size_t>(size) > bytes.size() - value) break;
    const bool is_window = has_at(bytes, at, std::string_view("dataWindow\0", 11)) ||
                           has_at(bytes, at, std::string_view("displayWindow\0", 14));
    if (is_window && size == 16) {
      for (std::size_t axis = 0; axis < 8; axis += 4) {
        const std::int64_t side =
            little_endian(bytes, value + 8 + axis) + 1 - little_endian(bytes, value + axis);
        if (side < 1 || side > kLargestSide) return "its texels are too many";
      }
    }
    const bool has_tiles = has_at(bytes, at, std::string_view("tiles\0", 6));
    if (has_tiles && size == 9 &&
        (little_endian(bytes, value) < 1 || little_endian(bytes, value) > kLargestSide ||
         little_endian(bytes, value + 4) < 1 || little_endian(bytes, value + 4) > kLargestSide)) {
      return "its tiles are too large";
    }
    at = value + static_cast<std::size_t>(size);
  }
  return at < bytes.size() && bytes[at] == 0 ? "" : "is corrupt: its header is cut short";
}

}  // namespace

const char* image_format_of(ByteView bytes) {
  if (has_at(bytes, 0, "\x89PNG\r\n\x1a\n")) return "png";
  if (has_at(bytes, 0, "\xff\xd8\xff")) return "jpeg";
  if (has_at(bytes, 0, "RIFF") && has_at(bytes, 8, "WEBP")) return "webp";
  if (has_at(bytes, 0, std::string_view("II*\0", 4)) ||
      has_at(bytes, 0, std::string_view("MM\0*", 4))) {
    return "tiff";
  }
  if (has_at(bytes, 0, "BM")) return "bmp";
  if (has_at(bytes, 0, "\x76\x2f\x31\x01")) return "openexr";
  if (has_at(bytes, 0, "#?RADIANCE") || has_at(bytes, 0, "#?RGBE")) return "hdr";
  return nullptr;
}

std::string danger_in_image(ByteView bytes, const std::string& format) {
  if (format == "png" && !is_whole_png(bytes)) return "is corrupt: its PNG file is cut short";
  if (format == "jpeg" && scan_count(bytes) > kMostScans) {
    return "has more than " + std::to_string(kMostScans) + " scans";
  }
  return format == "openexr" ? danger_in_exr(bytes) : "";
}

}  // namespace ppm::scene::gltf
