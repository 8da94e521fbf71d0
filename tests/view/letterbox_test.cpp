// A picture in a frame: where it goes, what is under the cursor, what is shown.
#include "letterbox.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace ppm::view {
namespace {

constexpr glm::uvec2 kSizes[] = {{1, 1}, {4, 3}, {640, 480}, {333, 77}, {50, 900}, {1920, 1080}};

TEST(ViewLetterbox, IsTheLargestInTheMiddle) {
  for (const glm::uvec2 picture : kSizes) {
    for (const glm::uvec2 frame : kSizes) {
      const Box box = letterbox(picture, frame);
      EXPECT_TRUE(box.size.x == frame.x || box.size.y == frame.y);
      for (const int axis : {0, 1}) {
        ASSERT_LE(box.corner[axis] + box.size[axis], frame[axis]);
        const unsigned behind = frame[axis] - box.corner[axis] - box.size[axis];
        EXPECT_LE(behind - box.corner[axis], 1u);
      }
      // The shape, to half a pixel of either side.
      const glm::dvec2 shape(picture), size(box.size);
      const double scale = std::min(frame.x / shape.x, frame.y / shape.y);
      EXPECT_LE(std::abs(size.x - std::max(scale * shape.x, 0.5)), 0.5 + 1e-9);
      EXPECT_LE(std::abs(size.y - std::max(scale * shape.y, 0.5)), 0.5 + 1e-9);
    }
  }
}

TEST(ViewLetterbox, CursorFindsEveryPixelInItsMiddle) {
  for (const glm::uvec2 picture : {glm::uvec2(4, 3), {33, 7}}) {
    for (const glm::uvec2 frame : {glm::uvec2(100, 100), {33, 7}, {70, 200}}) {
      const Box box = letterbox(picture, frame);
      const glm::dvec2 size = glm::dvec2(box.size) / glm::dvec2(picture);
      for (unsigned y = 0; y < picture.y; ++y) {
        for (unsigned x = 0; x < picture.x; ++x) {
          const glm::dvec2 middle = glm::dvec2(box.corner) + (glm::dvec2(x, y) + 0.5) * size;
          const auto found = pixel_at(middle, box, picture);
          ASSERT_TRUE(found);
          EXPECT_EQ(*found, glm::uvec2(x, y));
        }
      }
      EXPECT_FALSE(pixel_at(glm::dvec2(box.corner) - 0.01, box, picture));
      EXPECT_FALSE(pixel_at(glm::dvec2(box.corner + box.size), box, picture));
    }
  }
  EXPECT_FALSE(pixel_at({std::nan(""), 1.0}, letterbox({4, 3}, {4, 3}), {4, 3}));
}

/// Channels that name their pixel.
render::Picture numbered(unsigned width, unsigned height) {
  render::Picture picture{width, height, {}};
  for (unsigned y = 0; y < height; ++y) {
    for (unsigned x = 0; x < width; ++x) {
      const float values[] = {static_cast<float>(x) / static_cast<float>(width),
                              static_cast<float>(y) / static_cast<float>(height), 0.25f};
      picture.rgb.insert(picture.rgb.end(), std::begin(values), std::end(values));
    }
  }
  return picture;
}

using Bytes = std::array<int, 3>;

/// Of a frame, from its top left.
Bytes byte_at(const std::vector<std::uint8_t>& rgb, glm::uvec2 frame, unsigned x, unsigned y) {
  const std::size_t first = 3 * (std::size_t{frame.y - 1 - y} * frame.x + x);
  return {rgb.at(first), rgb.at(first + 1), rgb.at(first + 2)};
}

Bytes encoded(const render::Picture& picture, unsigned x, unsigned y, double exposure) {
  const float* const rgb = &picture.rgb[3 * (std::size_t{y} * picture.width + x)];
  return {image::srgb_byte(rgb[0], exposure), image::srgb_byte(rgb[1], exposure),
          image::srgb_byte(rgb[2], exposure)};
}

TEST(ViewLetterbox, ShowsWhatAPngHolds) {
  const render::Picture picture = numbered(7, 5);
  const image::Encoding encoding{.exposure = 0.5};
  const std::vector<std::uint8_t> rgb = framed(picture, {7, 5}, encoding);
  ASSERT_EQ(rgb.size(), 3u * 7 * 5);
  for (unsigned y = 0; y < 5; ++y) {
    for (unsigned x = 0; x < 7; ++x) {
      EXPECT_EQ(byte_at(rgb, {7, 5}, x, y), encoded(picture, x, y, 0.5)) << x << "," << y;
    }
  }
}

TEST(ViewLetterbox, EnlargesByRepetitionOnGrey) {
  const render::Picture picture = numbered(4, 3);
  const glm::uvec2 frame(12, 14);
  const std::vector<std::uint8_t> rgb = framed(picture, frame, {});
  for (unsigned y = 0; y < frame.y; ++y) {
    for (unsigned x = 0; x < frame.x; ++x) {
      const bool inside = y >= 2 && y < 11;  // 9 rows of 14, in the middle
      const Bytes expected = inside ? encoded(picture, x / 3, (y - 2) / 3, 0.0) : Bytes{32, 32, 32};
      EXPECT_EQ(byte_at(rgb, frame, x, y), expected) << x << "," << y;
    }
  }
}

TEST(ViewLetterbox, ShrinksByMeansOfRadiance) {
  render::Picture picture{4, 2, std::vector<float>(24, 0.0f)};
  for (const std::size_t pixel : {0u, 5u}) {  // one in each row of the left half
    for (std::size_t channel = 0; channel < 3; ++channel) picture.rgb[3 * pixel + channel] = 1.0f;
  }
  const std::vector<std::uint8_t> rgb = framed(picture, {2, 1}, {});
  const int half = image::srgb_byte(0.5f, 0.0);
  EXPECT_EQ(byte_at(rgb, {2, 1}, 0, 0), (Bytes{half, half, half}));
  EXPECT_EQ(byte_at(rgb, {2, 1}, 1, 0), (Bytes{0, 0, 0}));
}

}  // namespace
}  // namespace ppm::view
