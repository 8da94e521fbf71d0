#include "pfm.hpp"

#include <bit>
#include <cstring>

#include "failure.hpp"

namespace ppm::image {

std::string pfm_file(std::uint32_t width, std::uint32_t height, std::size_t channels,
                     std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little);
  PPM_ASSERT((channels == 1 || channels == 3) && values.size() == channels * width * height,
             std::to_string(values.size()));
  std::string file = (channels == 3 ? "PF\n" : "Pf\n") + std::to_string(width) + " " +
                     std::to_string(height) + "\n-1.0\n";
  const std::size_t row = channels * width, header = file.size();
  file.resize(header + values.size_bytes());
  for (std::size_t y = 0; y < height; ++y) {
    std::memcpy(&file[header + (height - 1 - y) * row * sizeof(float)], &values[y * row],
                row * sizeof(float));
  }
  return file;
}

}  // namespace ppm::image
