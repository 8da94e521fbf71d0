// Four floats at once, by the vector extension that GCC and Clang share.
#pragma once

#include <bit>
#include <cstdint>

namespace ppm::bvh {

using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

inline Float4 splat(float value) {
  return Float4{value, value, value, value};
}
inline Float4 minimum(Float4 a, Float4 b) {
  return a < b ? a : b;
}
inline Float4 maximum(Float4 a, Float4 b) {
  return a > b ? a : b;
}

/// A box of which lanes 0 to 2 count; starts inverted, so that growing it by anything yields that
/// thing.
struct Box {
  Float4 lower = splat(3.402823466e38f);
  Float4 upper = splat(-3.402823466e38f);

  void grow(Float4 lower_corner, Float4 upper_corner) {
    lower = minimum(lower, lower_corner);
    upper = maximum(upper, upper_corner);
  }
  void grow(const Box& box) { grow(box.lower, box.upper); }

  /// Half the surface; only for boxes that hold something.
  float half_area() const {
    const Float4 size = upper - lower;
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }
};

/// A triangle as the builder sees it: its box. The fourth lanes carry the triangle's index, as the
/// bits of an ordinary number (arithmetic on denormal ones would be slow).
struct Primitive {
  Float4 lower;
  Float4 upper;

  static constexpr std::uint32_t kIndexTag = 0x40000000u;
  static constexpr std::uint32_t kIndexLimit = 1u << 29;

  static float tag(std::uint32_t index) { return std::bit_cast<float>(index | kIndexTag); }
  std::uint32_t index() const { return std::bit_cast<std::uint32_t>(lower[3]) & ~kIndexTag; }
  /// Twice the centre.
  Float4 centroid() const { return lower + upper; }
};

}  // namespace ppm::bvh
