// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace ppm {

/// Throws Failure unless `file` could be written by write_whole: its folder exists and lets a file
/// be created, and what may stand there already is a regular file. Leaves nothing behind, and takes
/// away what programs left that were killed in write_whole.
void check_creatable(const std::filesystem::path& file);

/// Writes `pieces`, one after the other, to a temporary beside `file`, syncs it, renames it over
/// `file` (through a symbolic link) and syncs the folder. On any error the temporary is removed, an
/// older `file` stays as it was and Failure names file and cause.
void write_whole(const std::filesystem::path& file, std::span<const std::string_view> pieces);
void write_whole(const std::filesystem::path& file, std::string_view bytes);

}  // namespace ppm
