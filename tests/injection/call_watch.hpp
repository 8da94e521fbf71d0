// The Vulkan calls of a rendering by the places in the source that they come from, and the faults
// that are put into them.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <source_location>
#include <string>
#include <thread>
#include <vector>

#include "call.hpp"

namespace ppm::test {

/// A place in the source from which Vulkan is called.
struct Site {
  std::string file;  ///< without folders
  std::uint32_t line = 0;
  std::string call;  ///< "vkCreateBuffer"
  auto operator<=>(const Site&) const = default;
};
std::ostream& operator<<(std::ostream& stream, const Site& site);

/// What the specification lets a call return, of what befalls renderings: VK_ERROR_DEVICE_LOST and
/// shortages of memory.
std::vector<VkResult> results_of(const std::string& call);

/// A chain of callers, so that the same site on behalf of two buffers is two of them.
using Path = std::uint64_t;

struct Fault {
  Site site;
  std::uint64_t number = 1;  ///< of this site's calls, or of those by `path`; from 1
  Path path = 0;             ///< 0: any
  VkResult result = VK_ERROR_DEVICE_LOST;
  bool stays = false;  ///< from then on all calls fail that may return it
};
std::ostream& operator<<(std::ostream& stream, const Fault& fault);

/// While it lives it counts the calls, and puts in `fault`. One at a time.
class CallWatch {
 public:
  explicit CallWatch(bool by_paths = false) : by_paths_(by_paths) { install(); }
  explicit CallWatch(const Fault& fault) : fault_(&fault), by_paths_(fault.path != 0) { install(); }
  ~CallWatch() { gpu::fault_injection() = {}; }
  CallWatch(const CallWatch&) = delete;
  CallWatch& operator=(const CallWatch&) = delete;

  const std::map<Site, std::uint64_t>& calls() const { return calls_; }
  /// The paths to each site, where they were asked for, in the order of their first calls.
  const std::vector<std::pair<Path, Site>>& paths() const { return paths_; }
  std::uint64_t calls_of(const std::string& function) const;
  /// Sites of calls that were made to fail; empty: the fault was not reached.
  const std::set<Site>& failed() const { return failed_; }

  /// What vkDeviceWaitIdle does when it is made to fail: a lost device has come to rest.
  std::function<void()> wait_idle;

 private:
  void install();
  bool chooses(const char* call, const std::source_location& place);
  bool is_due(const Site& site, std::uint64_t number);

  const Fault* fault_ = nullptr;
  bool by_paths_;
  std::thread::id thread_ = std::this_thread::get_id();
  int outer_ = 0;  // frames of the stack above what is watched
  std::mutex access_;
  std::map<Site, std::uint64_t> calls_;
  std::map<Path, std::uint64_t> calls_by_path_;
  std::vector<std::pair<Path, Site>> paths_;
  std::set<Site> failed_;
};

}  // namespace ppm::test
