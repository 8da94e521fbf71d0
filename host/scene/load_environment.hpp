// Environment maps from files (Radiance .hdr, OpenEXR .exr).
#pragma once

#include <cstdint>
#include <filesystem>

#include "log.hpp"
#include "scene.hpp"

namespace ppm::scene {

/// Whether the extension is .hdr or .exr, without regard to case.
bool is_environment_file(const std::filesystem::path& file);

/// How many texels the file has, from its header. Throws Failure as load_environment does.
std::uint64_t environment_texels(const std::filesystem::path& file);

/// Reads a map over longitude and latitude, twice as wide as high, as linear radiance: its first
/// three channels, or its only one. Texels that are negative, infinite or no numbers are clamped,
/// with one warning. Throws Failure where the file is missing, corrupt, of another shape or larger
/// than the renderer takes; nothing is allocated before its size is checked.
Environment load_environment(const std::filesystem::path& file, Log& log);

}  // namespace ppm::scene
