#include "call_watch.hpp"

#include <execinfo.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <thread>

namespace ppm::test {
namespace {

/// Of the chain of callers below `outer` frames; all of it in another thread than the watch's.
Path path_here(int outer) {
  constexpr int kMost = 12;
  std::array<void*, 64> frames;
  const int count =
      std::min(backtrace(frames.data(), static_cast<int>(frames.size())) - outer, kMost);
  Path hash = 0xcbf29ce484222325;  // FNV-1a
  for (int i = 0; i < count; ++i) {
    hash = (hash ^ reinterpret_cast<Path>(frames[static_cast<std::size_t>(i)])) * 0x100000001b3;
  }
  return hash | 1u;
}

int depth_here() {
  std::array<void*, 64> frames;
  return backtrace(frames.data(), static_cast<int>(frames.size()));
}

}  // namespace

std::ostream& operator<<(std::ostream& stream, const Site& site) {
  return stream << site.call << " at " << site.file << ':' << site.line;
}

std::ostream& operator<<(std::ostream& stream, const Fault& fault) {
  return stream << gpu::result_name(fault.result) << (fault.stays ? ", for good," : "")
                << " from call " << fault.number << (fault.path ? " on one path" : "") << " of "
                << fault.site;
}

// Vulkan 1.3.239; all others of the program's calls return either shortage.
std::vector<VkResult> results_of(const std::string& call) {
  const VkResult host = VK_ERROR_OUT_OF_HOST_MEMORY, device = VK_ERROR_OUT_OF_DEVICE_MEMORY,
                 lost = VK_ERROR_DEVICE_LOST;
  static const std::map<std::string, std::vector<VkResult>> table = {
      {"vkCreateDevice", {host, device, lost}},
      {"vkQueueSubmit", {host, device, lost}},
      {"vkWaitForFences", {host, device, lost}},
      {"vkDeviceWaitIdle", {host, device, lost}},
      {"vkGetQueryPoolResults", {host, device, lost}},
      {"vkResetCommandPool", {device}},
      {"vkResetFences", {device}},
      {"vkCreateDebugUtilsMessengerEXT", {host}},
      // It never fails; what it returns is checked all the same.
      {"vkResetDescriptorPool", {device}},
  };
  const auto found = table.find(call);
  return found == table.end() ? std::vector<VkResult>{host, device} : found->second;
}

void CallWatch::install() {
  outer_ = depth_here();
  gpu::fault_injection() = {};
  if (fault_) gpu::fault_injection().result = fault_->result;
  gpu::fault_injection().chooses = [this](const char* call, const std::source_location& place) {
    return chooses(call, place);
  };
}

std::uint64_t CallWatch::calls_of(const std::string& function) const {
  std::uint64_t sum = 0;
  for (const auto& [site, count] : calls_) sum += site.call == function ? count : 0;
  return sum;
}

bool CallWatch::is_due(const Site& site, std::uint64_t number) {
  if (!fault_) return false;
  if (!failed_.empty()) {
    const auto results = results_of(site.call);
    return fault_->stays && std::ranges::find(results, fault_->result) != results.end();
  }
  return site == fault_->site && number == fault_->number;
}

bool CallWatch::chooses(const char* call, const std::source_location& place) {
  std::string file = place.file_name();
  const Site site{file.substr(file.find_last_of('/') + 1), place.line(), call};
  const std::scoped_lock lock(access_);
  std::uint64_t number = ++calls_[site];
  if (by_paths_ && (!fault_ || site == fault_->site)) {
    const Path path = path_here(std::this_thread::get_id() == thread_ ? outer_ : 0);
    const std::uint64_t on_path = ++calls_by_path_[path];
    if (on_path == 1) paths_.emplace_back(path, site);
    if (fault_) number = path == fault_->path ? on_path : 0;
  }
  if (!is_due(site, number)) return false;
  failed_.insert(site);
  if (site.call == "vkDeviceWaitIdle" && wait_idle) wait_idle();
  return true;
}

}  // namespace ppm::test
