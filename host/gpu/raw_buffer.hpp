// A Vulkan buffer with its memory, on the device's account.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

#include "device.hpp"

namespace ppm::gpu {

enum class Memory {
  device,  ///< device-local; host memory if that is full
  host,    ///< mapped, coherent, cached by the host if there is such memory
};

/// Types of memory to try for a buffer that allows those in `type_bits`, the best first.
std::vector<std::uint32_t> memory_candidates(const VkPhysicalDeviceMemoryProperties& properties,
                                             std::uint32_t type_bits, Memory kind);

/// Movable-once owner: empty until `create`, cleared by its destructor.
class RawBuffer {
 public:
  RawBuffer() = default;
  ~RawBuffer();
  RawBuffer(const RawBuffer&) = delete;
  RawBuffer& operator=(const RawBuffer&) = delete;

  /// Throws MemoryShortage(device, vkAllocateMemory, result with the buffer's name and size,
  /// remedy), and Failure for the like.
  void create(Device::Implementation& device, const std::string& name, VkDeviceSize bytes,
              VkBufferUsageFlags usage, Memory kind);

  VkBuffer handle() const { return handle_; }
  VkDeviceSize bytes() const { return bytes_; }
  /// Where the host sees it; null for memory it cannot read at a good pace.
  std::byte* mapped() const { return mapped_; }

 private:
  VkResult allocate(const VkMemoryRequirements& requirements, std::uint32_t type);
  void map(std::uint32_t type, Memory kind);

  Device::Implementation* device_ = nullptr;
  VkBuffer handle_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkDeviceSize bytes_ = 0, accounted_ = 0;
  std::byte* mapped_ = nullptr;
};

}  // namespace ppm::gpu
