#include "output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "failure.hpp"

namespace ppm {
namespace {

namespace fs = std::filesystem;

const char* remedy_for(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "create the folder first";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space or write elsewhere";
    case ENAMETOOLONG:
      return "choose a shorter name";
    default:
      return "choose a folder that can be written";
  }
}

[[noreturn]] void fail(const fs::path& file, const char* deed, int error) {
  throw Failure(file.string(), deed, std::generic_category().message(error), remedy_for(error));
}

/// What a rename has to replace: the file itself, or what a symbolic link to a file points to.
fs::path resolve_target(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  if (!fs::exists(status)) return file;
  if (!fs::is_regular_file(status)) {
    throw Failure(file.string(), "cannot write",
                  fs::is_directory(status) ? "it is a folder" : "it is not a regular file",
                  "name a file");
  }
  return fs::is_symlink(fs::symlink_status(file, ignored)) ? fs::canonical(file) : file;
}

/// A file in the making; removed unless it was renamed to its target.
class Temporary {
 public:
  explicit Temporary(const fs::path& file) : file_(file), target_(resolve_target(file)) {
    const std::string name =
        "." + target_.filename().string() + ".part-" + std::to_string(getpid());
    path_ = target_.parent_path() / name;
    descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(file_, "cannot create", errno);
  }
  ~Temporary() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!path_.empty()) unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(file_, "cannot write", errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void rename_to_target() {
    if (fsync(descriptor_) != 0) fail(file_, "cannot write", errno);
    const int closed = close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(file_, "cannot write", errno);
    if (rename(path_.c_str(), target_.c_str()) != 0) fail(file_, "cannot replace", errno);
    path_.clear();
  }

 private:
  fs::path file_, target_, path_;
  int descriptor_ = -1;
};

}  // namespace

void check_creatable(const fs::path& file) {
  if (!file.has_filename()) {
    throw Failure(file.string(), "cannot write", "it names a folder", "name a file");
  }
  Temporary{file};
}

void write_whole(const fs::path& file, std::string_view bytes) {
  Temporary temporary(file);
  temporary.write(bytes);
  temporary.rename_to_target();
}

}  // namespace ppm
