// How the commands of a run are recorded, cut into submissions, and timed.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "implementation.hpp"

namespace ppm::gpu {

/// What kernels and copies wrote before becomes visible to kernels and copies after.
void full_barrier(VkCommandBuffer commands);
/// What kernels and copies wrote becomes visible to the host.
void host_barrier(VkCommandBuffer commands);

/// Items of one dispatch: as many as `milliseconds` allow by `seconds_per_item` (0: not known, then
/// `first_guess`), at least a few, at most what 65535 workgroups hold; `count` cut evenly, in whole
/// workgroups.
std::uint64_t items_per_dispatch(std::uint64_t count, std::uint32_t workgroup_size,
                                 double seconds_per_item, double milliseconds,
                                 std::uint64_t first_guess);

/// One for each device. Holds as many commands, descriptors and bytes read back as its pools do;
/// whatever more a run records goes to another submission.
struct Recorder::Implementation {
  explicit Implementation(Device::Implementation& owner) : device(owner) {}
  ~Implementation();
  void open();

  void run(const std::function<void(Recorder&)>& record);
  void dispatch(Kernel::Implementation& kernel, const BindingTable& table, std::byte* push,
                std::size_t push_bytes, std::uint64_t count);
  void fill(const Buffer& buffer, std::uint32_t word, std::uint64_t bytes, std::uint64_t offset);
  void copy(const Buffer& from, const Buffer& to, const VkBufferCopy& region);
  void read(const Buffer& buffer, void* destination, std::uint64_t bytes, std::uint64_t offset);

 private:
  struct Command {
    Kernel::Implementation* kernel;  // null: a copy or fill
    std::uint64_t items;
    const char* region;
  };
  struct Read {
    void* destination;
    std::uint64_t offset, bytes;
  };

  void create_pools();
  /// A new submission, within the regions that are open.
  void begin();
  /// Ends the regions in this command buffer, though they may go on in the next, and submits it.
  void flush();
  void finish_command(Kernel::Implementation* kernel, std::uint64_t items, double expected_seconds);
  void prepare_command();
  VkDescriptorSet make_set(const Kernel::Implementation& kernel, const BindingTable& table);
  void dispatch_range(Kernel::Implementation& kernel, const std::byte* push,
                      std::uint32_t push_bytes, std::uint64_t items);
  void add_times();

  Device::Implementation& device;
  VkQueryPool timestamps = VK_NULL_HANDLE;
  VkDescriptorPool descriptors = VK_NULL_HANDLE;
  RawBuffer readback;
  std::vector<Command> commands;
  std::vector<Read> reads;
  std::uint32_t sets = 0, set_descriptors = 0;
  std::uint64_t read_bytes = 0;
  double expected_seconds = 0.0;  // of the commands recorded since the last submission
};

}  // namespace ppm::gpu
