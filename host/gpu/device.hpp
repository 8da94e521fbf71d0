// The Vulkan device: which there are, which is chosen, and the one queue everything runs on.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "device_profile.hpp"

namespace ppm::gpu {

/// One physical device as `ppm-vk devices` prints it.
struct DeviceDescription {
  std::uint32_t index = 0;         ///< what --device takes
  std::string name, type, driver;  ///< type: discrete GPU, integrated GPU, virtual GPU, CPU, other
  std::string api_version;         ///< "1.3.230"
  std::uint64_t memory_bytes = 0;  ///< largest device-local heap
  std::vector<std::string>
      obstacles;  ///< why it cannot serve, each naming the missing thing; empty if it can
};

struct DeviceOptions {
  /// Index, or a part of the name without regard to case; empty: the best (discrete, integrated,
  /// virtual, CPU).
  std::string selector;
  /// Khronos validation with synchronization validation; messages are printed and counted.
  bool validation = false;
  /// No dispatch is meant to take longer than this many milliseconds.
  double dispatch_milliseconds = 50.0;
};

/// All devices; throws Failure when there is no Vulkan loader or no driver, saying what to install.
std::vector<DeviceDescription> list_devices();

class Recorder;

/// GPU time by label (kernel name, "copy"; region): seconds, commands, and the items that kernels
/// ran over. Filled by Device::run.
struct KernelTime {
  double seconds = 0.0;
  std::uint64_t dispatches = 0;
  std::uint64_t items = 0;
  /// Of the first command, during which some drivers compile; counted above, too.
  double first_seconds = 0.0;
  void add(double more_seconds, std::uint64_t more_items) {
    if (dispatches == 0) first_seconds = more_seconds;
    seconds += more_seconds;
    items += more_items;
    ++dispatches;
  }
};

/// Owns instance, logical device, queue, command pool and the account of memory.
/// Every failing Vulkan call throws Failure(device name, call name, result name, remedy).
class Device {
 public:
  explicit Device(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceDescription& description() const;
  const DeviceProfile& profile() const;
  std::uint64_t max_storage_bytes() const;  ///< largest range a storage buffer may have
  std::uint64_t max_texels() const;         ///< largest uniform texel buffer, in 16-byte texels

  /// Records commands, submits them, waits; then results of Recorder::read are in place and timings
  /// are added.
  void run(const std::function<void(Recorder&)>& record);

  /// Times since construction, by kernel name.
  const std::map<std::string, KernelTime>& times() const;
  /// The same by region (region.hpp); "" is what ran outside of any.
  const std::map<std::string, KernelTime>& region_times() const;

  /// Whether what is allocated on the device is taken from the host's memory.
  bool shares_host_memory() const;
  /// What the driver says is left of its largest heap (VK_EXT_memory_budget), or its size.
  std::uint64_t free_bytes() const;
  std::uint64_t allocated_bytes() const;  ///< now, by our own account
  std::uint64_t peak_bytes() const;
  /// Tells of the first buffer that went to host memory because the device's was full; empty: none
  /// did.
  const std::string& memory_note() const;
  /// Messages of validation so far; 0 without validation.
  std::uint64_t validation_messages() const;

  struct Implementation;
  Implementation& implementation() { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ppm::gpu
