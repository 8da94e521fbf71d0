// Image files to texels.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gltf_document.hpp"

namespace ppm::scene::gltf {

/// RGBA, row-major from the top, in one of the two.
struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<glm::u8vec4> rgba8;    ///< codes as in the file
  std::vector<glm::u16vec4> halves;  ///< files of more than 8 bits: linear light, IEEE half floats
};

struct ImageSize {
  std::uint32_t width = 0, height = 0;
  std::uint64_t bytes = 0;  ///< of its texels
};

/// What decode_image would make of an element of `images`, from its header. Throws Failure where
/// the data is missing or is no image, or its texels would take more than `byte_budget` bytes.
ImageSize measure_image(const Element<tinygltf::Image>& image, std::uint64_t byte_budget);

/// Decodes an element of `images`, whatever its mimeType says: PNG, JPEG, WebP, TIFF, BMP, OpenEXR
/// and Radiance HDR. With `srgb` the colours of integers of 16 bits are decoded to linear light
/// (IEC 61966-2-1); alpha and floats are linear in any case. Throws Failure where the data is
/// missing or corrupt.
Image decode_image(const Element<tinygltf::Image>& image, bool srgb);

}  // namespace ppm::scene::gltf
