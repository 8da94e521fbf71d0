// A disk of its own that can be full.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace ppm::test {

/// A file system in memory. Where the user may not mount one, a process in a name space of its own
/// does and holds it, which most systems let everybody do.
class SmallDisk {
 public:
  /// Creates `folder`, to mount it there. `size` as mount takes it: "4k".
  SmallDisk(std::filesystem::path folder, const std::string& size);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  /// Whether it could be mounted.
  bool is_there() const { return is_mounted_ || holder_ > 0; }
  /// The folder as all processes of this user see it.
  const std::filesystem::path& path() const { return path_; }

  /// Takes all the space that is left; also what others let go of meanwhile, for some milliseconds.
  void fill() const;
  void free() const;

 private:
  void hold_it(const std::string& folder, const std::string& options);

  std::filesystem::path path_;
  bool is_mounted_ = false;
  pid_t holder_ = -1;
};

}  // namespace ppm::test
