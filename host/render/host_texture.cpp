#include "host_texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace ppm::render {
namespace {

/// IEC 61966-2-1 of the 256 codes.
const std::array<double, 256>& linear_of_srgb() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double code = static_cast<double>(i) / 255.0;
      values[i] = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    }
    return values;
  }();
  return table;
}

}  // namespace

glm::dvec4 texel_of(const scene::Texture& texture, std::uint32_t x, std::uint32_t y) {
  const std::size_t index = std::size_t{y} * texture.width + x;
  if (!texture.halves.empty()) {
    const glm::u16vec4 half = texture.halves[index];
    return glm::dvec4(glm::unpackHalf1x16(half.x), glm::unpackHalf1x16(half.y),
                      glm::unpackHalf1x16(half.z), glm::unpackHalf1x16(half.w));
  }
  const glm::u8vec4 code = texture.rgba8[index];
  if (!texture.srgb) return glm::dvec4(code) / 255.0;
  const auto& table = linear_of_srgb();
  return {table[code.r], table[code.g], table[code.b], code.a / 255.0};
}

std::uint32_t wrapped(std::int64_t coordinate, std::uint32_t size, scene::Wrap wrap) {
  const auto length = static_cast<std::int64_t>(size);
  if (wrap == scene::Wrap::clamp_to_edge) {
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(coordinate, 0, length - 1));
  }
  const std::int64_t period = wrap == scene::Wrap::mirrored_repeat ? 2 * length : length;
  const std::int64_t within = (coordinate % period + period) % period;
  return static_cast<std::uint32_t>(within < length ? within : period - 1 - within);
}

glm::dvec4 sample(const scene::Texture& texture, glm::dvec2 texcoord) {
  const glm::dvec2 position =
      texcoord * glm::dvec2(texture.width, texture.height) - (texture.nearest ? 0.0 : 0.5);
  const glm::dvec2 cell = glm::floor(position);
  const auto at = [&](int dx, int dy) {
    return texel_of(
        texture, wrapped(static_cast<std::int64_t>(cell.x) + dx, texture.width, texture.wrap_s),
        wrapped(static_cast<std::int64_t>(cell.y) + dy, texture.height, texture.wrap_t));
  };
  if (texture.nearest) return at(0, 0);
  const glm::dvec2 f = position - cell;
  return glm::mix(glm::mix(at(0, 0), at(1, 0), f.x), glm::mix(at(0, 1), at(1, 1), f.x), f.y);
}

glm::dvec2 transformed(const scene::TextureUse& use, glm::dvec2 texcoord) {
  const glm::dvec3 uv1(texcoord, 1.0);
  return {glm::dot(glm::dvec3(use.row_s), uv1), glm::dot(glm::dvec3(use.row_t), uv1)};
}

}  // namespace ppm::render
