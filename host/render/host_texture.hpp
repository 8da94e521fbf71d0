// Textures looked up on the host, as the kernels do it (shaders/lib/texture.glsl).
#pragma once

#include <cstdint>

#include "scene.hpp"

namespace ppm::render {

/// A texel in linear light; `x` and `y` within the texture.
glm::dvec4 texel_of(const scene::Texture& texture, std::uint32_t x, std::uint32_t y);

/// A column or row within `size` for one that may lie anywhere.
std::uint32_t wrapped(std::int64_t coordinate, std::uint32_t size, scene::Wrap wrap);

/// Wrapped and filtered, in linear light.
glm::dvec4 sample(const scene::Texture& texture, glm::dvec2 texcoord);

/// The texture's coordinates for those of the mesh.
glm::dvec2 transformed(const scene::TextureUse& use, glm::dvec2 texcoord);

}  // namespace ppm::render
