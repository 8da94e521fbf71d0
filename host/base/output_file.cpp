#include "output_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
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
  // A rename asks the folder alone, but whoever took the right to write had a reason.
  if (faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0) fail(file, "cannot write", errno);
  return fs::is_symlink(fs::symlink_status(file, ignored)) ? fs::canonical(file) : file;
}

/// A file in the making; removed unless it was renamed to its target.
class Temporary {
 public:
  explicit Temporary(const fs::path& file) : file_(file), target_(resolve_target(file)) {
    path_ = target_.parent_path() / (beginning_of_name() + std::to_string(getpid()));
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

  /// Those that programs left which were killed while they wrote this file.
  void remove_leftovers() const {
    const std::string beginning = beginning_of_name();
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (!name.starts_with(beginning)) continue;
      pid_t process = 0;
      const char* const last = name.data() + name.size();
      const auto [rest, fault] = std::from_chars(name.data() + beginning.size(), last, process);
      if (fault != std::errc{} || rest != last || process <= 0) continue;
      if (kill(process, 0) != 0 && errno == ESRCH) unlink(entry->path().c_str());
    }
  }

  void rename_to_target() {
    if (fsync(descriptor_) != 0) fail(file_, "cannot write", errno);
    const int closed = close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(file_, "cannot write", errno);
    if (rename(path_.c_str(), target_.c_str()) != 0) fail(file_, "cannot replace", errno);
    path_.clear();
    sync_folder();
  }

 private:
  std::string beginning_of_name() const { return "." + target_.filename().string() + ".part-"; }

  /// The file is there and whole; without this a power failure might bring the older one back. Not
  /// every file system can, and none needs to.
  void sync_folder() const {
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    close(descriptor);
  }

  fs::path file_, target_, path_;
  int descriptor_ = -1;
};

}  // namespace

void check_creatable(const fs::path& file) {
  if (!file.has_filename()) {
    throw Failure(file.string(), "cannot write", "it names a folder", "name a file");
  }
  Temporary(file).remove_leftovers();
}

void write_whole(const fs::path& file, std::span<const std::string_view> pieces) {
  Temporary temporary(file);
  for (const std::string_view piece : pieces) temporary.write(piece);
  temporary.rename_to_target();
}

void write_whole(const fs::path& file, std::string_view bytes) {
  write_whole(file, std::span(&bytes, 1));
}

}  // namespace ppm
