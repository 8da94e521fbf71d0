// Portable float maps, as denoisers read them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace ppm::image {

/// A whole PFM file, little-endian. `values`: row-major from the top, 1 or 3 channels a pixel; the
/// file has the bottom row first.
std::string pfm_file(std::uint32_t width, std::uint32_t height, std::size_t channels,
                     std::span<const float> values);

}  // namespace ppm::image
