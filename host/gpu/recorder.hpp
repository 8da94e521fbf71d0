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

/// What every device grants on an axis of workgroups.
constexpr std::uint64_t kMaxGroups = 65535;

constexpr std::uint64_t divide_up(std::uint64_t a, std::uint64_t b) {
  return (a + b - 1) / b;
}

/// Ranges of a dispatch of at most `most` items, when `expected` are likely: as many of `step`
/// items as those fill, but PPM_COUNTED_RANGES at most; the last may be longer, and is never longer
/// than kMaxGroups workgroups. `most` is what PPM_COUNTED_RANGES of those hold, at most.
struct CountedRanges {
  std::uint32_t step, ranges;
};
CountedRanges cut_counted(std::uint64_t most, std::uint64_t expected, std::uint32_t workgroup_size,
                          std::uint64_t step);

/// One for each device. Holds as many commands, descriptors and bytes read back as its pools do;
/// whatever more a run records goes to another submission.
struct Recorder::Implementation {
  explicit Implementation(Device::Implementation& owner) : device(owner), counts_kernel(owner) {}
  ~Implementation();
  void open();

  void run(const std::function<void(Recorder&)>& record);
  void dispatch(Kernel::Implementation& kernel, const BindingTable& table, std::byte* push,
                std::size_t push_bytes, std::uint64_t count);
  void dispatch_counted(Kernel::Implementation& kernel, const BindingTable& table, std::byte* push,
                        std::size_t push_bytes, const DeviceCount& count);
  void fill(const Buffer& buffer, std::uint32_t word, std::uint64_t bytes, std::uint64_t offset);
  void copy(const Buffer& from, const Buffer& to, const VkBufferCopy& region);
  void read(const Buffer& buffer, void* destination, std::uint64_t bytes, std::uint64_t offset);

 private:
  static constexpr std::uint32_t kNoSlot = UINT32_MAX;
  struct Command {
    Kernel::Implementation* kernel;  // null: a copy or fill
    std::uint64_t items;
    const char* region;
    std::uint32_t slot;  // of a counted dispatch, whose items are known at the end; else kNoSlot
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
  void finish_command(Kernel::Implementation* kernel, std::uint64_t items, double expected_seconds,
                      std::uint32_t slot = kNoSlot);
  void prepare_command();
  void check_push(const Kernel::Implementation& kernel, std::size_t push_bytes) const;
  VkDescriptorSet allocate_set(const Kernel::Implementation& kernel);
  /// All that comes before a dispatch: barrier, bindings, push constants; opens the kernel's label.
  void bind(const Kernel::Implementation& kernel, const BindingTable& table, const std::byte* push,
            std::uint32_t push_bytes);
  void bind_set(const Kernel::Implementation& kernel, VkDescriptorSet set, const std::byte* push,
                std::uint32_t push_bytes);
  double expected_time(const Kernel::Implementation& kernel, std::uint64_t items) const;

  void open_counted();
  std::uint32_t write_commands(const DeviceCount& count, const CountedRanges& cut,
                               std::uint32_t workgroup_size);
  /// At the end of a submission: what the counted dispatches' counts were.
  void read_slots();
  std::uint64_t counted_items(const Command& command) const;
  VkDescriptorSet make_set(const Kernel::Implementation& kernel, const BindingTable& table);
  void add_times();

  Device::Implementation& device;
  VkQueryPool timestamps = VK_NULL_HANDLE;
  VkDescriptorPool descriptors = VK_NULL_HANDLE;
  RawBuffer readback;
  Kernel::Implementation counts_kernel;
  RawBuffer command_slots, slots_readback;
  std::uint32_t next_slot = 0;
  std::vector<Command> commands;
  std::vector<Read> reads;
  std::uint32_t sets = 0, set_descriptors = 0;
  std::uint64_t read_bytes = 0;
  double expected_seconds = 0.0;  // of the commands recorded since the last submission
};

}  // namespace ppm::gpu
