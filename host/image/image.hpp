// Pictures to files, through OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tone.hpp"

namespace ppm::image {

/// Named facts stored with a picture where the format can hold them (EXR: one attribute each).
using Attribute = std::pair<std::string, std::variant<int, double, std::string>>;

/// A view of linear RGB, row-major from the top, 3 * width * height floats.
struct View {
  std::uint32_t width = 0, height = 0;
  std::span<const float> rgb;
};

/// How a picture is put into files; each matters to some formats alone.
struct Encoding {
  double exposure = 0.0;     ///< PNG: radiance times 2^exposure
  Tone tone = Tone::linear;  ///< PNG
  bool half = false;         ///< EXR: 16-bit floats instead of 32
};

/// What is told of a picture's pixels beside their radiance.
struct Layer {
  std::string name;                   ///< in file names: "albedo"
  std::vector<std::string> channels;  ///< in EXR: "Albedo.R" ...; 1 or 3
  std::vector<float> values;          ///< one a channel and pixel, row-major from the top
  bool precise = false;               ///< positions and the like: 32 bits even with Encoding::half
};

/// The extensions of pictures, ".exr, .png, .hdr or .pfm", without regard to case.
bool has_known_extension(const std::filesystem::path& file);

/// Whether such a file takes layers: .exr and .pfm.
bool takes_layers(const std::filesystem::path& file);

/// Where the layer of this name goes beside a picture: for "p.pfm" to "p.albedo.pfm"; an EXR holds
/// it itself.
std::filesystem::path layer_file(const std::filesystem::path& picture, const std::string& layer);

/// Throws Failure unless the extension is one of those, the folder exists and a file can be created
/// in it.
void check_writable(const std::filesystem::path& file);

/// The byte a PNG holds for a radiance: radiance * 2^exposure clipped to [0,1], sRGB curve,
/// nearest; 0 for NaN.
std::uint8_t srgb_byte(float radiance, double exposure);

/// The bytes a PNG holds for a picture, 3 a pixel: exposed, tone-mapped, clipped and encoded like
/// srgb_byte.
std::vector<std::uint8_t> srgb_bytes(std::span<const float> rgb, const Encoding& encoding);

/// A whole PNG file of 8-bit sRGB codes, row-major from the top, 3 * width * height bytes.
std::string encode_png(std::uint32_t width, std::uint32_t height,
                       std::span<const std::uint8_t> rgb);

/// Writes the file whole or not at all (a temporary beside it, then a rename). EXR: channels R, G,
/// B of 32-bit floats, or of 16 bits, where what is larger than 65504 is written as 65504; ZIP,
/// attributes, layers as more channels. HDR: RGBE, negative and NaN as 0. PNG: 8 bits, srgb_bytes.
/// PFM: 32-bit floats, layers as files beside it. The same picture, attributes, layers and encoding
/// give the same bytes. Throws Failure naming the file.
void write(const std::filesystem::path& file, const View& picture, const Encoding& encoding,
           const std::vector<Attribute>& attributes, std::span<const Layer> layers = {});

}  // namespace ppm::image
