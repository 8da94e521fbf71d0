#include "small_disk.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <thread>

namespace ppm::test {
namespace {

const char* const kFiller = "filler";

void write_to(const char* file, const std::string& text) {
  std::ofstream(file) << text;
}

/// A user is the same one within.
bool enter_own_name_space() {
  const std::string user = std::to_string(geteuid()), group = std::to_string(getegid());
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  write_to("/proc/self/setgroups", "deny");
  write_to("/proc/self/uid_map", user + " " + user + " 1");
  write_to("/proc/self/gid_map", group + " " + group + " 1");
  return true;
}

}  // namespace

bool SmallDisk::mount_it(const std::string& size) const {
  return mount("ppm-vk-test", folder_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
}

SmallDisk::SmallDisk(std::filesystem::path folder, const std::string& size)
    : folder_(std::move(folder)) {
  std::filesystem::create_directory(folder_);
  is_there_ = mount_it(size) || (enter_own_name_space() && mount_it(size));
}

SmallDisk::~SmallDisk() {
  if (is_there_) umount2(folder_.c_str(), MNT_DETACH);
}

void SmallDisk::fill() const {
  const std::array<char, 512> zeros{};
  const int file =
      open((folder_ / kFiller).c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file < 0) return;
  for (int times = 0; times < 4; ++times) {
    while (write(file, zeros.data(), zeros.size()) > 0) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  close(file);
}

void SmallDisk::free() const {
  std::filesystem::remove(folder_ / kFiller);
}

}  // namespace ppm::test
