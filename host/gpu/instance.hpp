// The Vulkan instance and its messages.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace ppm::gpu {

/// Every validation message of the process, those of instances that are being made or destroyed
/// included.
std::uint64_t all_validation_messages();

/// The instance; with validation its messages of warning and error are printed and counted.
class Instance {
 public:
  /// Throws Failure when there is no driver, or no validation layer where it was asked for.
  explicit Instance(bool validation);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return handle_; }
  bool names_objects() const { return names_objects_; }
  std::uint64_t messages() const { return messages_; }
  std::vector<VkPhysicalDevice> physical_devices() const;

 private:
  void create_messenger(const VkDebugUtilsMessengerCreateInfoEXT& info);

  VkInstance handle_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  bool names_objects_ = false;
  std::uint64_t messages_ = 0;
};

}  // namespace ppm::gpu
