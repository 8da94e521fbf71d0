#include "letterbox.hpp"

#include <algorithm>
#include <cmath>

namespace ppm::view {
namespace {

constexpr std::uint8_t kBackground = 32;

/// Elements [first, end) of a row of `from` that become element `i` of one of `to`.
struct Range {
  std::uint64_t first, end;
};

Range sources(std::uint64_t i, std::uint64_t from, std::uint64_t to) {
  if (to >= from) {
    const std::uint64_t nearest = (2 * i + 1) * from / (2 * to);
    return {nearest, nearest + 1};
  }
  return {i * from / to, ((i + 1) * from + to - 1) / to};
}

std::vector<float> resampled(const render::Picture& picture, glm::uvec2 size) {
  std::vector<float> result;
  result.reserve(std::size_t{3} * size.x * size.y);
  for (std::uint32_t y = 0; y < size.y; ++y) {
    const Range rows = sources(y, picture.height, size.y);
    for (std::uint32_t x = 0; x < size.x; ++x) {
      const Range columns = sources(x, picture.width, size.x);
      glm::vec3 sum(0.0f);
      for (std::uint64_t row = rows.first; row < rows.end; ++row) {
        for (std::uint64_t column = columns.first; column < columns.end; ++column) {
          const float* const rgb = &picture.rgb[3 * (row * picture.width + column)];
          sum += glm::vec3(rgb[0], rgb[1], rgb[2]);
        }
      }
      const auto count = (rows.end - rows.first) * (columns.end - columns.first);
      if (count > 1) sum /= static_cast<float>(count);
      result.insert(result.end(), {sum.x, sum.y, sum.z});
    }
  }
  return result;
}

}  // namespace

Box letterbox(glm::uvec2 picture, glm::uvec2 frame) {
  const glm::dvec2 shape(picture), room(frame);
  const double scale = std::min(room.x / shape.x, room.y / shape.y);
  Box box;
  box.size = glm::clamp(glm::uvec2(glm::round(scale * shape)), glm::uvec2(1), frame);
  box.corner = (frame - box.size) / 2u;
  return box;
}

std::optional<glm::uvec2> pixel_at(glm::dvec2 point, const Box& box, glm::uvec2 picture) {
  const glm::dvec2 share = (point - glm::dvec2(box.corner)) / glm::dvec2(box.size);
  if (!(share.x >= 0.0 && share.x < 1.0 && share.y >= 0.0 && share.y < 1.0)) return std::nullopt;
  return glm::min(glm::uvec2(share * glm::dvec2(picture)), picture - 1u);
}

std::vector<std::uint8_t> framed(const render::Picture& picture, glm::uvec2 frame,
                                 const image::Encoding& encoding) {
  const Box box = letterbox({picture.width, picture.height}, frame);
  const std::vector<std::uint8_t> shown = image::srgb_bytes(resampled(picture, box.size), encoding);
  std::vector<std::uint8_t> bytes(std::size_t{3} * frame.x * frame.y, kBackground);
  const std::size_t row_bytes = std::size_t{3} * box.size.x;
  for (std::size_t row = 0; row < box.size.y; ++row) {
    const std::size_t from_bottom = frame.y - 1 - (box.corner.y + row);
    std::copy_n(&shown[row * row_bytes], row_bytes,
                &bytes[3 * (from_bottom * frame.x + box.corner.x)]);
  }
  return bytes;
}

}  // namespace ppm::view
