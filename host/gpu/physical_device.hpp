// What each physical device is, what it lacks, and which one serves.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

#include "device.hpp"
#include "instance.hpp"

namespace ppm::gpu {

/// What of a physical device this program uses.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  VkDeviceSize max_allocation = 0;
  std::uint32_t subgroup_size = 0;
  std::uint32_t queue_family = 0;
  std::uint32_t timestamp_bits = 0;
  bool tells_budget = false;  ///< VK_EXT_memory_budget
  DeviceDescription description;
};

/// What is left of the largest device-local heap, as far as the driver tells; else its size.
std::uint64_t free_device_bytes(const PhysicalDevice& device);

PhysicalDevice describe(VkPhysicalDevice handle, std::uint32_t index);
std::vector<PhysicalDevice> describe_all(const Instance& instance);

/// The device that `selector` asks for (DeviceOptions::selector); Failure names those there are.
const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices,
                             const std::string& selector);

}  // namespace ppm::gpu
