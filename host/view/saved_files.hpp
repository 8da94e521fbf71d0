// Which files a picture is written to.
#pragma once

#include <filesystem>
#include <vector>

namespace ppm::view {

/// Those that were asked for; where none were, NAME-1.exr and NAME-1.png in the current folder,
/// after the scene, with the first number that neither has yet.
std::vector<std::filesystem::path> saved_files(const std::vector<std::filesystem::path>& asked_for,
                                               const std::filesystem::path& scene);

}  // namespace ppm::view
