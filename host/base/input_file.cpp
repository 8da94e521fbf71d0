#include "input_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace ppm {

std::string why_unreadable(const std::filesystem::path& file) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) {
    const bool is_hidden =
        code && code != std::errc::no_such_file_or_directory && code != std::errc::not_a_directory;
    return is_hidden ? "cannot be read: " + code.message() : "there is no such file";
  }
  if (std::filesystem::is_directory(status)) return "is a folder, not a regular file";
  if (!std::filesystem::is_regular_file(status)) return "is not a regular file";
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return "cannot be opened for reading: " + std::generic_category().message(errno);
  }
  close(descriptor);
  return {};
}

}  // namespace ppm
