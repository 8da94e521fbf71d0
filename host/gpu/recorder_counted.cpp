// Dispatches whose items were counted on the device.
#include <algorithm>
#include <cstring>

#include "call.hpp"
#include "failure.hpp"
#include "ppm_gpu_shaders.hpp"
#include "recorder.hpp"
#include "shared/dispatch_counts.h"

namespace ppm::gpu {
namespace {

constexpr VkDeviceSize kCommandBytes = 3 * sizeof(std::uint32_t);
constexpr std::uint32_t kCommandSlots = 2048;
static_assert(kCommandSlots >= PPM_COUNTED_RANGES);

}  // namespace

CountedRanges cut_counted(std::uint64_t most, std::uint64_t expected, std::uint32_t workgroup_size,
                          std::uint64_t step) {
  const std::uint64_t longest = std::uint64_t{kMaxGroups} * workgroup_size;
  const auto ranges_of = [&](std::uint64_t length) {
    const std::uint64_t for_expected = divide_up(std::min(expected, most), length);
    // The last range takes all the rest.
    const std::uint64_t for_most = most > longest ? divide_up(most - longest, length) + 1 : 1;
    return std::max<std::uint64_t>({for_expected, for_most, 1});
  };
  if (ranges_of(step) > PPM_COUNTED_RANGES) {
    // Too many to be worth it: longer ones.
    step = divide_up(divide_up(most, PPM_COUNTED_RANGES), workgroup_size) * workgroup_size;
  }
  return {static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(ranges_of(step))};
}

void Recorder::Implementation::open_counted() {
  counts_kernel.open(shaders::dispatch_counts, {});
  command_slots.create(device, "dispatch commands", kCommandSlots * kCommandBytes,
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                       Memory::device);
  slots_readback.create(device, "dispatch commands read back", kCommandSlots * kCommandBytes, 0,
                        Memory::host);
}

void Recorder::Implementation::dispatch_counted(Kernel::Implementation& kernel,
                                                const BindingTable& table, std::byte* push,
                                                std::size_t push_bytes, const DeviceCount& count) {
  check_push(kernel, push_bytes);
  const std::uint32_t group = kernel.reflection.workgroup_size;
  PPM_ASSERT(count.most <= kMaxGroups * group * PPM_COUNTED_RANGES && count.rows > 0,
             "kernel " + kernel.name + ": " + std::to_string(count.most) + " items, " +
                 std::to_string(count.rows) + " rows");
  if (count.most == 0) return;
  const double seconds_per_item = kernel.seconds_per_item * count.rows;
  const std::uint64_t expected = std::max<std::uint64_t>(count.expected, 1);
  const CountedRanges cut = cut_counted(
      count.most, expected, group,
      items_per_dispatch(expected, group, seconds_per_item, device.options.dispatch_milliseconds,
                         device.profile.first_guess_items));
  const std::uint32_t first_slot = write_commands(count, cut, group);
  for (std::uint32_t range = 0; range < cut.ranges; ++range) {
    const std::uint64_t first = std::uint64_t{range} * cut.step;
    const bool last = range + 1 == cut.ranges;
    const std::uint32_t items[2] = {
        static_cast<std::uint32_t>(first),
        last ? static_cast<std::uint32_t>(count.most - std::min(first, count.most)) : cut.step};
    std::memcpy(push, items, sizeof items);
    bind(kernel, table, push, static_cast<std::uint32_t>(push_bytes));
    vkCmdDispatchIndirect(device.commands, command_slots.handle(),
                          (first_slot + range) * kCommandBytes);
    device.end_label();
    const std::uint64_t likely =
        expected > first ? std::min<std::uint64_t>(expected - first, cut.step) : 0;
    finish_command(&kernel, 0, expected_time(kernel, likely * count.rows), first_slot + range);
  }
}

// One small dispatch turns the counts into commands. Slots are never written twice in a submission,
// for what they held is read back at its end.
std::uint32_t Recorder::Implementation::write_commands(const DeviceCount& count,
                                                       const CountedRanges& cut,
                                                       std::uint32_t workgroup_size) {
  if (next_slot + cut.ranges > kCommandSlots) {
    flush();
    begin();
    next_slot = 0;
  }
  const std::uint32_t first_slot = next_slot;
  next_slot += cut.ranges;
  shared::DispatchCountsPush push{count.word, count.rows, static_cast<std::uint32_t>(count.most),
                                  cut.ranges, cut.step,   workgroup_size,
                                  first_slot};
  prepare_command();
  const VkDescriptorSet set = allocate_set(counts_kernel);
  const VkDescriptorBufferInfo buffers[2] = {
      {count.buffer.implementation()->raw.handle(), 0, VK_WHOLE_SIZE},
      {command_slots.handle(), 0, VK_WHOLE_SIZE}};
  VkWriteDescriptorSet writes[2]{};
  for (std::uint32_t i = 0; i < 2; ++i) {
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set;
    writes[i].dstBinding = i == 0 ? PPM_BIND_DISPATCH_WORDS : PPM_BIND_DISPATCH_COMMANDS;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &buffers[i];
  }
  vkUpdateDescriptorSets(device.handle, 2, writes, 0, nullptr);
  bind_set(counts_kernel, set, reinterpret_cast<const std::byte*>(&push), sizeof push);
  vkCmdDispatch(
      device.commands,
      static_cast<std::uint32_t>(divide_up(cut.ranges, counts_kernel.reflection.workgroup_size)), 1,
      1);
  device.end_label();
  finish_command(&counts_kernel, cut.ranges, 0.0);
  return first_slot;
}

void Recorder::Implementation::read_slots() {
  if (next_slot == 0) return;
  full_barrier(device.commands);
  const VkBufferCopy region{0, 0, next_slot * kCommandBytes};
  vkCmdCopyBuffer(device.commands, command_slots.handle(), slots_readback.handle(), 1, &region);
}

std::uint64_t Recorder::Implementation::counted_items(const Command& command) const {
  std::uint32_t groups[3];
  std::memcpy(groups, slots_readback.mapped() + command.slot * kCommandBytes, sizeof groups);
  return std::uint64_t{groups[0]} * groups[1] * command.kernel->reflection.workgroup_size;
}

}  // namespace ppm::gpu
