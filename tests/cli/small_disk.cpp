#include "small_disk.hpp"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <utility>

namespace ppm::test {
namespace {

const char* const kFiller = "filler";

void write_to(const char* file, const std::string& text) {
  const int descriptor = open(file, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  [[maybe_unused]] const ssize_t written = write(descriptor, text.data(), text.size());
  close(descriptor);
}

bool mount_it(const std::string& folder, const std::string& options) {
  return mount("ppm-vk-test", folder.c_str(), "tmpfs", 0, options.c_str()) == 0;
}

}  // namespace

SmallDisk::SmallDisk(std::filesystem::path folder, const std::string& size)
    : path_(std::move(folder)) {
  std::filesystem::create_directory(path_);
  const std::string options = "size=" + size;
  is_mounted_ = mount_it(path_, options);
  if (!is_mounted_) hold_it(path_, options);
}

SmallDisk::~SmallDisk() {
  if (is_mounted_) umount2(path_.c_str(), MNT_DETACH);
  if (holder_ <= 0) return;
  kill(holder_, SIGKILL);
  waitpid(holder_, nullptr, 0);
}

// In a process of its own, since one with threads may not enter a name space of users.
void SmallDisk::hold_it(const std::string& folder, const std::string& options) {
  const std::string user = std::to_string(geteuid()), group = std::to_string(getegid());
  const std::string users = user + " " + user + " 1", groups = group + " " + group + " 1";
  int ready[2];
  if (pipe2(ready, O_CLOEXEC) != 0) return;
  const pid_t process = fork();
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) _exit(1);
    write_to("/proc/self/setgroups", "deny");
    write_to("/proc/self/uid_map", users);
    write_to("/proc/self/gid_map", groups);
    if (!mount_it(folder, options) || write(ready[1], "y", 1) != 1) _exit(1);
    while (true) pause();
  }
  close(ready[1]);
  char answer = 0;
  if (process > 0 && read(ready[0], &answer, 1) == 1) {
    holder_ = process;
    path_ = "/proc/" + std::to_string(process) + "/root" + folder;
  } else if (process > 0) {
    waitpid(process, nullptr, 0);
  }
  close(ready[0]);
}

void SmallDisk::fill() const {
  const std::array<char, 512> zeros{};
  const int file = open((path_ / kFiller).c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file < 0) return;
  for (int times = 0; times < 4; ++times) {
    while (write(file, zeros.data(), zeros.size()) > 0) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  close(file);
}

void SmallDisk::free() const {
  std::filesystem::remove(path_ / kFiller);
}

}  // namespace ppm::test
