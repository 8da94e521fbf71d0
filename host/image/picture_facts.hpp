// What one of our EXRs says of itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "image.hpp"

namespace ppm::image {

struct PictureFacts {
  std::uint32_t width = 0, height = 0;
  std::vector<std::pair<std::string, std::string>> channels;  ///< name and type, "float" or "half"
  std::vector<Attribute> attributes;                          ///< those of ours, "ppm-vk:..."
};

/// Reads the head of the file and no pixels. Throws Failure, which names it, where it is no picture
/// or none that ppm-vk wrote.
PictureFacts read_facts(const std::filesystem::path& file);

}  // namespace ppm::image
