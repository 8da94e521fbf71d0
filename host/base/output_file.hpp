// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace ppm {

/// Throws Failure unless `file` could be written by write_whole: its folder exists and lets a file
/// be created, and what may stand there already is a regular file. Leaves nothing behind.
void check_creatable(const std::filesystem::path& file);

/// Writes `bytes` to a temporary beside `file`, syncs it and renames it over `file` (through a
/// symbolic link). On any error the temporary is removed, an older `file` stays as it was and
/// Failure names file and cause.
void write_whole(const std::filesystem::path& file, std::string_view bytes);

}  // namespace ppm
