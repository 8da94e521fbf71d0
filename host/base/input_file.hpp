// Files that are about to be read.
#pragma once

#include <filesystem>
#include <string>

namespace ppm {

/// Why this file cannot be read from its beginning to its end, for people: "there is no such file",
/// "is a folder, not a regular file", "cannot be opened for reading: Permission denied" and the
/// like. Empty: it can. Never waits, as opening a pipe would.
std::string why_unreadable(const std::filesystem::path& file);

}  // namespace ppm
