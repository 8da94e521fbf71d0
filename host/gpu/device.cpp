#include "device.hpp"

#include <algorithm>

#include "call.hpp"
#include "failure.hpp"
#include "implementation.hpp"
#include "recorder.hpp"

namespace ppm::gpu {

std::vector<DeviceDescription> list_devices() {
  const Instance instance(false);
  std::vector<DeviceDescription> descriptions;
  for (PhysicalDevice& device : describe_all(instance)) {
    descriptions.push_back(std::move(device.description));
  }
  return descriptions;
}

void Device::Implementation::open(const DeviceOptions& chosen) {
  options = chosen;
  instance = std::make_unique<Instance>(options.validation);
  physical = choose(describe_all(*instance), options.selector);
  profile = device_profile(physical.properties.deviceType);
  vkGetPhysicalDeviceMemoryProperties(physical.handle, &memory);
  create_device();
  create_commands();
  recorder = std::make_unique<Recorder::Implementation>(*this);
  recorder->open();
}

void Device::Implementation::create_device() {
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue_info{};
  queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue_info.queueFamilyIndex = physical.queue_family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  VkPhysicalDeviceVulkan12Features features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  features.scalarBlockLayout = VK_TRUE;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue_info;
  PPM_VK_CALL(name(), vkCreateDevice, physical.handle, &info, nullptr, &handle);
  vkGetDeviceQueue(handle, physical.queue_family, 0, &queue);
  if (instance->names_objects()) find_debug_calls();
  set_name(VK_OBJECT_TYPE_QUEUE, queue, "compute");
}

void Device::Implementation::find_debug_calls() {
  set_object_name = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
      vkGetDeviceProcAddr(handle, "vkSetDebugUtilsObjectNameEXT"));
  cmd_begin_label = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
      vkGetDeviceProcAddr(handle, "vkCmdBeginDebugUtilsLabelEXT"));
  cmd_end_label = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
      vkGetDeviceProcAddr(handle, "vkCmdEndDebugUtilsLabelEXT"));
}

void Device::Implementation::create_commands() {
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.queueFamilyIndex = physical.queue_family;
  PPM_VK_CALL(name(), vkCreateCommandPool, handle, &pool_info, nullptr, &command_pool);
  VkCommandBufferAllocateInfo buffer_info{};
  buffer_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  buffer_info.commandPool = command_pool;
  buffer_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  buffer_info.commandBufferCount = 1;
  PPM_VK_CALL(name(), vkAllocateCommandBuffers, handle, &buffer_info, &commands);
  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  PPM_VK_CALL(name(), vkCreateFence, handle, &fence_info, nullptr, &fence);
  set_name(VK_OBJECT_TYPE_COMMAND_POOL, command_pool, "commands");
  set_name(VK_OBJECT_TYPE_COMMAND_BUFFER, commands, "commands");
  set_name(VK_OBJECT_TYPE_FENCE, fence, "submission");
}

Device::Implementation::~Implementation() {
  if (handle == VK_NULL_HANDLE) return;
  recorder.reset();
  staging_buffer.reset();
  for (const auto& [key, shared] : pipelines) {
    vkDestroyPipeline(handle, shared.pipeline, nullptr);
    vkDestroyPipelineLayout(handle, shared.layout, nullptr);
    vkDestroyDescriptorSetLayout(handle, shared.set_layout, nullptr);
  }
  vkDestroyFence(handle, fence, nullptr);
  vkDestroyCommandPool(handle, command_pool, nullptr);
  vkDestroyDevice(handle, nullptr);
}

void Device::Implementation::set_name_of(VkObjectType type, std::uint64_t object,
                                         const std::string& text) const {
  if (!set_object_name) return;
  VkDebugUtilsObjectNameInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
  info.objectType = type;
  info.objectHandle = object;
  info.pObjectName = text.c_str();
  const char* const call = "vkSetDebugUtilsObjectNameEXT";
  require_success(name(), call, PPM_VK_TRY_AS(call, set_object_name, handle, &info));
}

void Device::Implementation::begin_label(const char* text) const {
  if (!cmd_begin_label) return;
  VkDebugUtilsLabelEXT label{};
  label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
  label.pLabelName = text;
  cmd_begin_label(commands, &label);
}

void Device::Implementation::end_label() const {
  if (cmd_end_label) cmd_end_label(commands);
}

void Device::Implementation::begin_commands() {
  PPM_ASSERT(!recording,
             "buffers cannot be uploaded or downloaded while commands are being recorded");
  PPM_VK_CALL(name(), vkResetCommandPool, handle, command_pool, 0);
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  PPM_VK_CALL(name(), vkBeginCommandBuffer, commands, &info);
  // What earlier submissions wrote becomes visible to this one.
  full_barrier(commands);
}

void Device::Implementation::submit_and_wait() {
  host_barrier(commands);
  PPM_VK_CALL(name(), vkEndCommandBuffer, commands);
  PPM_VK_CALL(name(), vkResetFences, handle, 1, &fence);
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands;
  PPM_VK_CALL(name(), vkQueueSubmit, queue, 1, &info, fence);
  const VkResult waited = PPM_VK_TRY(vkWaitForFences, handle, 1, &fence, VK_TRUE, UINT64_MAX);
  // The caller may free what the commands use, so that they must have ended even now.
  if (waited < 0) (void)PPM_VK_TRY(vkDeviceWaitIdle, handle);
  require_success(name(), "vkWaitForFences", waited);
}

RawBuffer& Device::Implementation::staging() {
  if (!staging_buffer) {
    auto buffer = std::make_unique<RawBuffer>();
    buffer->create(*this, "staging", kStagingBytes, 0, Memory::host);
    staging_buffer = std::move(buffer);
  }
  return *staging_buffer;
}

Device::Device(const DeviceOptions& options) : implementation_(std::make_unique<Implementation>()) {
  implementation_->open(options);
}

Device::~Device() = default;

const DeviceDescription& Device::description() const {
  return implementation_->physical.description;
}

const DeviceProfile& Device::profile() const {
  return implementation_->profile;
}

std::uint64_t Device::max_storage_bytes() const {
  const PhysicalDevice& device = implementation_->physical;
  const std::uint64_t range = device.properties.limits.maxStorageBufferRange;
  return std::min(range, device.max_allocation) / 16 * 16;
}

std::uint64_t Device::max_texels() const {
  const PhysicalDevice& device = implementation_->physical;
  const std::uint64_t elements = device.properties.limits.maxTexelBufferElements;
  return std::min(elements, device.max_allocation / 16);
}

void Device::run(const std::function<void(Recorder&)>& record) {
  implementation_->recorder->run(record);
}

const std::map<std::string, KernelTime>& Device::times() const {
  return implementation_->times;
}
const std::map<std::string, KernelTime>& Device::region_times() const {
  return implementation_->region_times;
}
bool Device::shares_host_memory() const {
  const VkPhysicalDeviceType type = implementation_->physical.properties.deviceType;
  return type == VK_PHYSICAL_DEVICE_TYPE_CPU || type == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
}
std::uint64_t Device::free_bytes() const {
  return free_device_bytes(implementation_->physical);
}
std::uint64_t Device::allocated_bytes() const {
  return implementation_->allocated_bytes;
}
std::uint64_t Device::peak_bytes() const {
  return implementation_->peak_bytes;
}
const std::string& Device::memory_note() const {
  return implementation_->memory_note;
}
std::uint64_t Device::validation_messages() const {
  return implementation_->instance->messages();
}

}  // namespace ppm::gpu
