#include "saved_files.hpp"

#include <algorithm>
#include <string>
#include <system_error>

namespace ppm::view {

std::vector<std::filesystem::path> saved_files(const std::vector<std::filesystem::path>& asked_for,
                                               const std::filesystem::path& scene) {
  if (!asked_for.empty()) return asked_for;
  for (unsigned number = 1;; ++number) {
    const std::string name = scene.stem().string() + "-" + std::to_string(number);
    const std::vector<std::filesystem::path> files = {name + ".exr", name + ".png"};
    const auto is_there = [](const std::filesystem::path& file) {
      std::error_code ignored;
      return std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
    };
    if (std::ranges::none_of(files, is_there)) return files;
  }
}

}  // namespace ppm::view
