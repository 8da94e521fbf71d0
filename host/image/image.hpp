// Pictures to files, through OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ppm::image {

/// Named facts stored with a picture where the format can hold them (EXR: one attribute each).
using Attribute = std::pair<std::string, std::variant<int, double, std::string>>;

/// A view of linear RGB, row-major from the top, 3 * width * height floats.
struct View {
  std::uint32_t width = 0, height = 0;
  std::span<const float> rgb;
};

/// Whether the extension is .exr, .png or .hdr, without regard to case.
bool has_known_extension(const std::filesystem::path& file);

/// Throws Failure unless the extension is one of .exr, .png, .hdr, the folder exists and a file can
/// be created in it.
void check_writable(const std::filesystem::path& file);

/// The byte a PNG holds for a radiance: radiance * 2^exposure clipped to [0,1], sRGB curve,
/// nearest; 0 for NaN.
std::uint8_t srgb_byte(float radiance, double exposure);

/// A whole PNG file of 8-bit sRGB codes, row-major from the top, 3 * width * height bytes.
std::string encode_png(std::uint32_t width, std::uint32_t height,
                       std::span<const std::uint8_t> rgb);

/// Writes the file whole or not at all (a temporary beside it, then a rename). EXR: 32-bit float
/// channels R, G, B, ZIP, attributes; HDR: RGBE, negative and NaN as 0; PNG: 8 bits, srgb_byte. The
/// same picture, attributes and exposure give the same bytes. Throws Failure naming the file.
void write(const std::filesystem::path& file, const View& picture, double exposure,
           const std::vector<Attribute>& attributes);

}  // namespace ppm::image
