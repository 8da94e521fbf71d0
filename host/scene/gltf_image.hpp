// PNG and JPEG images to linear light.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gltf_document.hpp"

namespace ppm::scene::gltf {

/// Linear RGBA as IEEE half floats, row-major from the top.
struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<glm::u16vec4> texels;
};

/// Decodes an element of `images`; its colours are sRGB (IEC 61966-2-1), its alpha is linear.
/// Throws Failure where the data is missing or corrupt, or has more than `texel_budget` texels.
Image decode_image(const Element<tinygltf::Image>& image, std::uint64_t texel_budget);

}  // namespace ppm::scene::gltf
