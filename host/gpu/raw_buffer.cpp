#include "raw_buffer.hpp"

#include <algorithm>

#include "call.hpp"
#include "failure.hpp"
#include "implementation.hpp"
#include "memory_shortage.hpp"

namespace ppm::gpu {
namespace {

constexpr VkMemoryPropertyFlags kReadableByHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                  VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
                                                  VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
constexpr VkMemoryPropertyFlags kMappable =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
// Such memory asks for features or images that are not used here.
constexpr VkMemoryPropertyFlags kUnfit =
    VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT | VK_MEMORY_PROPERTY_PROTECTED_BIT |
    VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD | VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD;

std::string megabytes(VkDeviceSize bytes) {
  return std::to_string((bytes + (VkDeviceSize{1} << 20) - 1) >> 20) + " MiB";
}

bool is_shortage(VkResult result) {
  return result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_TOO_MANY_OBJECTS;
}

}  // namespace

std::vector<std::uint32_t> memory_candidates(const VkPhysicalDeviceMemoryProperties& properties,
                                             std::uint32_t type_bits, Memory kind) {
  std::vector<std::uint32_t> candidates;
  const auto add_all_with = [&](VkMemoryPropertyFlags flags) {
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
      const VkMemoryPropertyFlags has = properties.memoryTypes[i].propertyFlags;
      if (!(type_bits >> i & 1u) || (has & flags) != flags || (has & kUnfit) != 0) continue;
      if (std::find(candidates.begin(), candidates.end(), i) == candidates.end())
        candidates.push_back(i);
    }
  };
  if (kind == Memory::device) add_all_with(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  add_all_with(kReadableByHost);
  add_all_with(kMappable);
  return candidates;
}

RawBuffer::~RawBuffer() {
  if (!device_) return;
  vkDestroyBuffer(device_->handle, handle_, nullptr);
  vkFreeMemory(device_->handle, memory_, nullptr);
  device_->allocated_bytes -= accounted_;
}

void RawBuffer::create(Device::Implementation& device, const std::string& name, VkDeviceSize bytes,
                       VkBufferUsageFlags usage, Memory kind) {
  device_ = &device;
  bytes_ = bytes;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  PPM_VK_CALL(device.name(), vkCreateBuffer, device.handle, &info, nullptr, &handle_);
  device.set_name(VK_OBJECT_TYPE_BUFFER, handle_, name);

  VkMemoryRequirements requirements;
  vkGetBufferMemoryRequirements(device.handle, handle_, &requirements);
  VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  std::uint32_t type = 0;
  const auto candidates = memory_candidates(device.memory, requirements.memoryTypeBits, kind);
  for (std::uint32_t candidate : candidates) {
    type = candidate;
    result = allocate(requirements, type);
    if (!is_shortage(result)) break;
  }
  if (is_shortage(result)) {
    throw MemoryShortage(
        device.name(), "vkAllocateMemory",
        result_name(result) + " for " + megabytes(requirements.size) + " of the buffer " + name +
            " beside " + megabytes(device.allocated_bytes) + " in use",
        "render a smaller picture with fewer photons, or choose another device with --device");
  }
  require_success(device.name(), "vkAllocateMemory", result);
  device.set_name(VK_OBJECT_TYPE_DEVICE_MEMORY, memory_, name);
  PPM_VK_CALL(device.name(), vkBindBufferMemory, device.handle, handle_, memory_, 0);
  map(type, kind);
  const bool is_local =
      device.memory.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  if (kind == Memory::device && !is_local && device.memory_note.empty()) {
    device.memory_note = "device memory is full: the buffer " + name + " (" +
                         megabytes(requirements.size) + ") went to host memory, which is slower";
  }
}

VkResult RawBuffer::allocate(const VkMemoryRequirements& requirements, std::uint32_t type) {
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = type;
  const VkResult result = PPM_VK_TRY(vkAllocateMemory, device_->handle, &info, nullptr, &memory_);
  if (result < 0) return result;
  accounted_ = requirements.size;
  device_->allocated_bytes += accounted_;
  device_->peak_bytes = std::max(device_->peak_bytes, device_->allocated_bytes);
  return result;
}

// Device memory is mapped only where the host can also read it through its cache: elsewhere,
// reading across the bus word by word would cost more than a copy.
void RawBuffer::map(std::uint32_t type, Memory kind) {
  if (kind == Memory::device && !device_->maps_device_memory) return;
  const VkMemoryPropertyFlags needed = kind == Memory::host ? kMappable : kReadableByHost;
  if ((device_->memory.memoryTypes[type].propertyFlags & needed) != needed) return;
  void* pointer = nullptr;
  PPM_VK_CALL(device_->name(), vkMapMemory, device_->handle, memory_, 0, VK_WHOLE_SIZE, 0,
              &pointer);
  mapped_ = static_cast<std::byte*>(pointer);
}

}  // namespace ppm::gpu
