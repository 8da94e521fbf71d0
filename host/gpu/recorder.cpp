#include "recorder.hpp"

#include <algorithm>
#include <cstring>

#include "call.hpp"
#include "failure.hpp"

namespace ppm::gpu {
namespace {

constexpr std::uint64_t kFewestItems = 1024;  // below, the cost of a dispatch prevails
constexpr double kSubmissionSeconds = 0.5;    // drivers give up on submissions of several seconds
constexpr std::uint32_t kMaxCommands = 1024;  // of one submission
constexpr std::uint32_t kMaxSets = 512;       // of one submission
constexpr std::uint32_t kMaxDescriptors = 8192;  // of each kind and one submission
constexpr VkDeviceSize kReadbackBytes = VkDeviceSize{1} << 20;
constexpr std::uint64_t kLongestRead = 65536;

constexpr VkPipelineStageFlags kDeviceStages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                               VK_PIPELINE_STAGE_TRANSFER_BIT |
                                               VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
constexpr VkAccessFlags kWrites = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
constexpr VkAccessFlags kReads = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                                 VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;

void barrier(VkCommandBuffer commands, VkPipelineStageFlags to_stages, VkAccessFlags to_accesses) {
  VkMemoryBarrier memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  memory.srcAccessMask = kWrites;
  memory.dstAccessMask = to_accesses;
  vkCmdPipelineBarrier(commands, kDeviceStages, to_stages, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

}  // namespace

void full_barrier(VkCommandBuffer commands) {
  barrier(commands, kDeviceStages, kReads | kWrites);
}

void host_barrier(VkCommandBuffer commands) {
  barrier(commands, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

std::uint64_t items_per_dispatch(std::uint64_t count, std::uint32_t workgroup_size,
                                 double seconds_per_item, double milliseconds,
                                 std::uint64_t first_guess) {
  std::uint64_t limit = first_guess;
  const std::uint64_t most = kMaxGroups * workgroup_size;
  if (seconds_per_item > 0.0) {
    const double wanted = milliseconds * 1e-3 / seconds_per_item;
    limit = wanted < static_cast<double>(most) ? static_cast<std::uint64_t>(std::max(wanted, 0.0))
                                               : most;
  }
  limit = std::min(std::max(limit, kFewestItems), most);
  const std::uint64_t parts = divide_up(count, limit);
  const std::uint64_t even = divide_up(divide_up(count, parts), workgroup_size) * workgroup_size;
  return std::min(even, most);
}

void Recorder::Implementation::open() {
  create_pools();
  readback.create(device, "read back", kReadbackBytes, 0, Memory::host);
  open_counted();
}

void Recorder::Implementation::create_pools() {
  VkQueryPoolCreateInfo query_info{};
  query_info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  query_info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  query_info.queryCount = kMaxCommands + 1;
  PPM_VK_CALL(device.name(), vkCreateQueryPool, device.handle, &query_info, nullptr, &timestamps);
  device.set_name(VK_OBJECT_TYPE_QUERY_POOL, timestamps, "timestamps");
  const VkDescriptorPoolSize sizes[] = {
      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kMaxDescriptors},
      {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, kMaxDescriptors},
      {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kMaxDescriptors},
  };
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = kMaxSets;
  pool_info.poolSizeCount = 3;
  pool_info.pPoolSizes = sizes;
  PPM_VK_CALL(device.name(), vkCreateDescriptorPool, device.handle, &pool_info, nullptr,
              &descriptors);
  device.set_name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, descriptors, "bindings");
}

Recorder::Implementation::~Implementation() {
  vkDestroyQueryPool(device.handle, timestamps, nullptr);
  vkDestroyDescriptorPool(device.handle, descriptors, nullptr);
}

void Recorder::Implementation::run(const std::function<void(Recorder&)>& record) {
  next_slot = 0;
  begin();
  Recorder recorder(*this);
  try {
    record(recorder);
    flush();
  } catch (...) {
    device.recording = false;
    throw;
  }
  device.recording = false;
}

void Recorder::Implementation::begin() {
  commands.clear();
  reads.clear();
  sets = set_descriptors = 0;
  read_bytes = 0;
  expected_seconds = 0.0;
  PPM_VK_CALL(device.name(), vkResetDescriptorPool, device.handle, descriptors, 0);
  device.begin_commands();
  device.recording = true;
  vkCmdResetQueryPool(device.commands, timestamps, 0, kMaxCommands + 1);
  vkCmdWriteTimestamp(device.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timestamps, 0);
  for (const char* region : device.regions) device.begin_label(region);
}

void Recorder::Implementation::flush() {
  device.recording = false;
  for (std::size_t i = 0; i < device.regions.size(); ++i) device.end_label();
  read_slots();
  device.submit_and_wait();
  for (const Read& read : reads) {
    std::memcpy(read.destination, readback.mapped() + read.offset, read.bytes);
  }
  if (!commands.empty()) add_times();
  commands.clear();
}

// Every command waits for those before it; the ranges of one dispatch, too: validation cannot see
// that they write apart, and at the length they have, the wait is not noticed.
void Recorder::Implementation::prepare_command() {
  if (commands.size() == kMaxCommands || expected_seconds > kSubmissionSeconds) {
    flush();
    begin();
  }
  if (!commands.empty()) full_barrier(device.commands);
}

void Recorder::Implementation::finish_command(Kernel::Implementation* kernel, std::uint64_t items,
                                              double seconds, std::uint32_t slot) {
  commands.push_back({kernel, items, device.regions.empty() ? "" : device.regions.back(), slot});
  expected_seconds += seconds;
  vkCmdWriteTimestamp(device.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timestamps,
                      static_cast<std::uint32_t>(commands.size()));
}

// Command i took from timestamp i to i + 1, as barriers keep the commands apart.
void Recorder::Implementation::add_times() {
  std::vector<std::uint64_t> ticks(commands.size() + 1);
  PPM_VK_CALL(device.name(), vkGetQueryPoolResults, device.handle, timestamps, 0,
              static_cast<std::uint32_t>(ticks.size()), ticks.size() * sizeof(std::uint64_t),
              ticks.data(), sizeof(std::uint64_t),
              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  const std::uint32_t bits = device.physical.timestamp_bits;
  const std::uint64_t mask = bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
  const double seconds_per_tick =
      1e-9 * static_cast<double>(device.physical.properties.limits.timestampPeriod);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const double seconds = static_cast<double>((ticks[i + 1] - ticks[i]) & mask) * seconds_per_tick;
    Kernel::Implementation* const kernel = commands[i].kernel;
    const bool counted = commands[i].slot != kNoSlot;
    const std::uint64_t items = counted ? counted_items(commands[i]) : commands[i].items;
    device.region_times[commands[i].region].add(seconds, items);
    if (counted && items == 0) continue;  // nothing ran, and nothing is learnt
    device.times[kernel ? kernel->name : "copy"].add(seconds, items);
    if (kernel) kernel->learn(seconds, items);
  }
}

VkDescriptorSet Recorder::Implementation::allocate_set(const Kernel::Implementation& kernel) {
  std::uint32_t count = 0;
  for (const auto& [binding, length] : kernel.descriptor_counts) count += length;
  if (sets == kMaxSets || set_descriptors + count > kMaxDescriptors) {
    flush();
    begin();
  }
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = descriptors;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &kernel.set_layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  PPM_VK_CALL(device.name(), vkAllocateDescriptorSets, device.handle, &info, &set);
  ++sets;
  set_descriptors += count;
  return set;
}

VkDescriptorSet Recorder::Implementation::make_set(const Kernel::Implementation& kernel,
                                                   const BindingTable& table) {
  const auto& bindings = kernel.reflection.bindings;
  const VkDescriptorSet set = allocate_set(kernel);
  std::vector<VkDescriptorBufferInfo> ranges;
  std::vector<VkBufferView> views;
  ranges.reserve(set_descriptors);  // never fewer than are added: pointers stay valid
  views.reserve(set_descriptors);
  std::vector<VkWriteDescriptorSet> writes;
  for (const auto& [binding, type] : bindings) {
    const std::span<const Buffer> buffers = table.segments(binding);
    const std::string where = "kernel " + kernel.name + ", binding " + std::to_string(binding);
    PPM_ASSERT(!buffers.empty() && buffers.front(), where + ": no buffer is bound");
    PPM_ASSERT(buffers.size() == kernel.descriptor_counts.at(binding),
               where + ": made for " + std::to_string(kernel.descriptor_counts.at(binding)) +
                   " segments, bound are " + std::to_string(buffers.size()));
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = static_cast<std::uint32_t>(buffers.size());
    write.descriptorType = type;
    write.pBufferInfo = ranges.data() + ranges.size();
    write.pTexelBufferView = views.data() + views.size();
    for (const Buffer& buffer : buffers) {
      const Buffer::Implementation& bound = *buffer.implementation();
      PPM_ASSERT(&bound.device == &device,
                 where + ": " + bound.name + " belongs to another device");
      PPM_ASSERT(bound.serves_as(type), where + ": " + bound.name + " was made for another use");
      ranges.push_back({bound.raw.handle(), 0, VK_WHOLE_SIZE});
      views.push_back(bound.view);
    }
    writes.push_back(write);
  }
  vkUpdateDescriptorSets(device.handle, static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                         nullptr);
  return set;
}

void Recorder::Implementation::check_push(const Kernel::Implementation& kernel,
                                          std::size_t push_bytes) const {
  PPM_ASSERT(push_bytes == kernel.reflection.push_bytes,
             "kernel " + kernel.name + " has a push block of " +
                 std::to_string(kernel.reflection.push_bytes) + " bytes, not " +
                 std::to_string(push_bytes));
}

void Recorder::Implementation::dispatch(Kernel::Implementation& kernel, const BindingTable& table,
                                        std::byte* push, std::size_t push_bytes,
                                        std::uint64_t count) {
  check_push(kernel, push_bytes);
  PPM_ASSERT(count <= UINT32_MAX,
             "kernel " + kernel.name + ": " + std::to_string(count) + " items");
  if (count == 0) return;
  const std::uint32_t group = kernel.reflection.workgroup_size;
  const std::uint64_t step =
      items_per_dispatch(count, group, kernel.seconds_per_item,
                         device.options.dispatch_milliseconds, device.profile.first_guess_items);
  for (std::uint64_t first = 0; first < count; first += step) {
    const std::uint64_t items = std::min(step, count - first);
    const std::uint32_t range[2] = {static_cast<std::uint32_t>(first),
                                    static_cast<std::uint32_t>(items)};
    std::memcpy(push, range, sizeof range);
    bind(kernel, table, push, static_cast<std::uint32_t>(push_bytes));
    vkCmdDispatch(device.commands, static_cast<std::uint32_t>(divide_up(items, group)), 1, 1);
    device.end_label();
    finish_command(&kernel, items, expected_time(kernel, items));
  }
}

void Recorder::Implementation::bind(const Kernel::Implementation& kernel, const BindingTable& table,
                                    const std::byte* push, std::uint32_t push_bytes) {
  prepare_command();
  bind_set(kernel, make_set(kernel, table), push, push_bytes);
}

void Recorder::Implementation::bind_set(const Kernel::Implementation& kernel, VkDescriptorSet set,
                                        const std::byte* push, std::uint32_t push_bytes) {
  device.begin_label(kernel.name.c_str());
  vkCmdBindDescriptorSets(device.commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.layout, 0, 1,
                          &set, 0, nullptr);
  vkCmdBindPipeline(device.commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline);
  vkCmdPushConstants(device.commands, kernel.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes,
                     push);
}

// By experience; of a kernel that has never run, the time a dispatch may take.
double Recorder::Implementation::expected_time(const Kernel::Implementation& kernel,
                                               std::uint64_t items) const {
  if (kernel.seconds_per_item > 0.0) return kernel.seconds_per_item * static_cast<double>(items);
  return items > 0 ? device.options.dispatch_milliseconds * 1e-3 : 0.0;
}

void Recorder::Implementation::fill(const Buffer& buffer, std::uint32_t word, std::uint64_t bytes,
                                    std::uint64_t offset) {
  if (bytes == 0) return;
  PPM_ASSERT(bytes % 4 == 0 && offset % 4 == 0, "fill of " + buffer.name() + ": " +
                                                    std::to_string(bytes) + " bytes from " +
                                                    std::to_string(offset));
  buffer.implementation()->check_range(bytes, offset);
  prepare_command();
  vkCmdFillBuffer(device.commands, buffer.implementation()->raw.handle(), offset, bytes, word);
  finish_command(nullptr, 0, 0.0);
}

void Recorder::Implementation::copy(const Buffer& from, const Buffer& to,
                                    const VkBufferCopy& region) {
  if (region.size == 0) return;
  from.implementation()->check_range(region.size, region.srcOffset);
  to.implementation()->check_range(region.size, region.dstOffset);
  prepare_command();
  vkCmdCopyBuffer(device.commands, from.implementation()->raw.handle(),
                  to.implementation()->raw.handle(), 1, &region);
  finish_command(nullptr, 0, 0.0);
}

void Recorder::Implementation::read(const Buffer& buffer, void* destination, std::uint64_t bytes,
                                    std::uint64_t offset) {
  if (bytes == 0) return;
  PPM_ASSERT(bytes <= kLongestRead,
             "read of " + buffer.name() + ": " + std::to_string(bytes) + " bytes");
  buffer.implementation()->check_range(bytes, offset);
  if (read_bytes + bytes > kReadbackBytes) {
    flush();
    begin();
  }
  prepare_command();
  const VkBufferCopy region{offset, read_bytes, bytes};
  vkCmdCopyBuffer(device.commands, buffer.implementation()->raw.handle(), readback.handle(), 1,
                  &region);
  reads.push_back({destination, read_bytes, bytes});
  read_bytes += bytes;
  finish_command(nullptr, 0, 0.0);
}

void Recorder::fill(const Buffer& buffer, std::uint32_t word, std::uint64_t bytes,
                    std::uint64_t offset) {
  implementation_.fill(buffer, word, bytes, offset);
}

void Recorder::copy(const Buffer& from, const Buffer& to, std::uint64_t bytes,
                    std::uint64_t from_offset, std::uint64_t to_offset) {
  implementation_.copy(from, to, {from_offset, to_offset, bytes});
}

void Recorder::read(const Buffer& buffer, void* destination, std::uint64_t bytes,
                    std::uint64_t offset) {
  implementation_.read(buffer, destination, bytes, offset);
}

void Recorder::dispatch_bytes(const Kernel& kernel, const BindingTable& table, void* push,
                              std::size_t push_bytes, std::uint64_t count) {
  implementation_.dispatch(kernel.implementation(), table, static_cast<std::byte*>(push),
                           push_bytes, count);
}

void Recorder::dispatch_counted(const Kernel& kernel, const BindingTable& table, void* push,
                                std::size_t push_bytes, const DeviceCount& count) {
  implementation_.dispatch_counted(kernel.implementation(), table, static_cast<std::byte*>(push),
                                   push_bytes, count);
}

}  // namespace ppm::gpu
