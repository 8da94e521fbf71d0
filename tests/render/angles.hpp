// Pictures that depend on the angle of the eye ray alone.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "render_harness.hpp"

namespace ppm::test {

/// Mean over each block of `size` pixels of what `radiance` says of the cosine between the eye ray
/// and the vertical, for a camera of square pictures that looks straight down. 4 x 4 midpoints a
/// pixel.
inline std::vector<glm::dvec3> expected_blocks(const render::Settings& settings, std::uint32_t size,
                                               const std::function<glm::dvec3(double)>& radiance) {
  constexpr int kParts = 4;
  render::Picture picture{settings.width, settings.height, {}};
  const double half = std::tan(settings.camera.yfov / 2.0), pixels = settings.height;
  for (std::uint32_t y = 0; y < settings.height; ++y) {
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      glm::dvec3 sum(0.0);
      for (int part = 0; part < kParts * kParts; ++part) {
        const double u = (2.0 * (x + (part % kParts + 0.5) / kParts) / pixels - 1.0) * half;
        const double v = (2.0 * (y + (part / kParts + 0.5) / kParts) / pixels - 1.0) * half;
        sum += radiance(1.0 / std::sqrt(1.0 + u * u + v * v)) / double{kParts * kParts};
      }
      for (int channel = 0; channel < 3; ++channel)
        picture.rgb.push_back(static_cast<float>(sum[channel]));
    }
  }
  return block_means(picture, size);
}

}  // namespace ppm::test
