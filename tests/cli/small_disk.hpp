// A disk of its own that can be full.
#pragma once

#include <filesystem>
#include <string>

namespace ppm::test {

/// A file system in memory at `folder`, which it creates. Where the process may not mount one it
/// does so in a name space of its own, as ordinary users may on most systems; then for the rest of
/// the process.
class SmallDisk {
 public:
  /// `size` as mount takes it: "4k".
  SmallDisk(std::filesystem::path folder, const std::string& size);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  /// Whether it could be mounted.
  bool is_there() const { return is_there_; }

  /// Takes all the space that is left; also what others let go of meanwhile, for some milliseconds.
  void fill() const;
  void free() const;

 private:
  bool mount_it(const std::string& size) const;

  std::filesystem::path folder_;
  bool is_there_ = false;
};

}  // namespace ppm::test
