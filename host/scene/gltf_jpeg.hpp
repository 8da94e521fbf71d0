// JPEG files to 8-bit texels, by libjpeg-turbo: of the decoders at hand the one that withstands
// hostile files.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ppm::scene::gltf {

struct JpegSize {
  std::uint32_t width = 0, height = 0;
};

struct JpegTexels {
  std::vector<std::uint8_t> rgba;  ///< as encoded, row-major from the top, alpha 255
  bool damaged = false;            ///< parts were missing or wrong and are made up
};

/// The size that the file states, or nothing where it is no JPEG.
std::optional<JpegSize> jpeg_size(std::span<const std::uint8_t> file);

/// Decodes a file whose size the caller has found acceptable. Nothing where that cannot be done.
std::optional<JpegTexels> decode_jpeg(std::span<const std::uint8_t> file);

}  // namespace ppm::scene::gltf
