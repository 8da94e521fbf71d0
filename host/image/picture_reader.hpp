// Pictures from files, through OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ppm::image {

/// Linear RGB as the file holds it, row-major from the top, 3 * width * height floats. Throws
/// Failure, which names the file, unless it is a picture of exactly this size with at least three
/// channels whose first three hold numbers; what is not finite stays so.
std::vector<float> read_rgb(const std::filesystem::path& file, std::uint32_t width,
                            std::uint32_t height);

}  // namespace ppm::image
