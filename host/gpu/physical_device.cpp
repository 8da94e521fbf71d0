#include "physical_device.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "call.hpp"
#include "failure.hpp"

namespace ppm::gpu {
namespace {

// Storage buffers that one kernel may bind. The specification grants 4 only.
constexpr std::uint32_t kStorageBuffersNeeded = 16;

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "CPU";
    default:
      return "other";
  }
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 3;
    default:
      return 4;
  }
}

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::uint64_t largest_device_heap(VkPhysicalDevice handle) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(handle, &memory);
  std::uint64_t bytes = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    const VkMemoryHeap& heap = memory.memoryHeaps[i];
    if (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) bytes = std::max(bytes, heap.size);
  }
  return bytes;
}

bool has_extension(const PhysicalDevice& device, std::string_view name) {
  const auto extensions =
      enumerate<VkExtensionProperties>([&](std::uint32_t* count, VkExtensionProperties* data) {
        PPM_VK_CALL(device.description.name, vkEnumerateDeviceExtensionProperties, device.handle,
                    nullptr, count, data);
      });
  return std::ranges::any_of(extensions, [&](const VkExtensionProperties& extension) {
    return name == extension.extensionName;
  });
}

// The first family that computes and takes the time; else the first that computes.
void choose_queue(PhysicalDevice& device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
  bool computes = false;
  for (std::uint32_t i = 0; i < count && device.timestamp_bits == 0; ++i) {
    if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT)) continue;
    if (computes && families[i].timestampValidBits == 0) continue;
    computes = true;
    device.queue_family = i;
    device.timestamp_bits = families[i].timestampValidBits;
  }
  auto& obstacles = device.description.obstacles;
  if (!computes) {
    obstacles.push_back("no queue that computes (VK_QUEUE_COMPUTE_BIT)");
  } else if (device.timestamp_bits == 0) {
    obstacles.push_back("no timestamps on its compute queue (timestampValidBits is 0)");
  }
}

// Properties and features that Vulkan 1.2 can be asked for.
void describe_1_2(PhysicalDevice& device) {
  VkPhysicalDeviceMaintenance3Properties maintenance{};
  maintenance.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  VkPhysicalDeviceSubgroupProperties subgroup{};
  subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  subgroup.pNext = &maintenance;
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  driver.pNext = &subgroup;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device.handle, &properties);
  device.max_allocation = maintenance.maxMemoryAllocationSize;
  device.subgroup_size = subgroup.subgroupSize;
  if (!(subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) ||
      !(subgroup.supportedOperations & VK_SUBGROUP_FEATURE_SHUFFLE_BIT)) {
    device.description.obstacles.push_back(
        "no shuffles within subgroups (VK_SUBGROUP_FEATURE_SHUFFLE_BIT)");
  }
  device.description.driver = std::string(driver.driverName) + " " + driver.driverInfo;

  VkPhysicalDeviceVulkan12Features features12{};
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &features12;
  vkGetPhysicalDeviceFeatures2(device.handle, &features);
  if (!features12.scalarBlockLayout) {
    device.description.obstacles.push_back("the feature scalarBlockLayout is missing");
  }
}

void check_limits(PhysicalDevice& device) {
  auto& obstacles = device.description.obstacles;
  const std::uint32_t buffers = device.properties.limits.maxPerStageDescriptorStorageBuffers;
  if (buffers < kStorageBuffersNeeded) {
    obstacles.push_back("a kernel may have " + std::to_string(buffers) + " storage buffers, but " +
                        std::to_string(kStorageBuffersNeeded) +
                        " are needed (maxPerStageDescriptorStorageBuffers)");
  }
  VkFormatProperties format;
  vkGetPhysicalDeviceFormatProperties(device.handle, VK_FORMAT_R32G32B32A32_UINT, &format);
  if (!(format.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT)) {
    obstacles.push_back("no uniform texel buffers of VK_FORMAT_R32G32B32A32_UINT");
  }
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// An index wins over names that contain it.
std::vector<const PhysicalDevice*> matches(const std::vector<PhysicalDevice>& devices,
                                           const std::string& selector) {
  std::vector<const PhysicalDevice*> named;
  for (const PhysicalDevice& device : devices) {
    if (selector == std::to_string(device.description.index)) return {&device};
    if (lower(device.description.name).find(lower(selector)) != std::string::npos) {
      named.push_back(&device);
    }
  }
  return named;
}

std::string list(const std::vector<PhysicalDevice>& devices) {
  std::string text;
  for (const PhysicalDevice& device : devices) {
    if (!text.empty()) text += ", ";
    text += std::to_string(device.description.index) + " (" + device.description.name + ")";
  }
  return text;
}

std::string join(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
  return text;
}

}  // namespace

std::uint64_t free_device_bytes(const PhysicalDevice& device) {
  if (!device.tells_budget) return device.description.memory_bytes;
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{};
  budget.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
  VkPhysicalDeviceMemoryProperties2 memory{};
  memory.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2;
  memory.pNext = &budget;
  vkGetPhysicalDeviceMemoryProperties2(device.handle, &memory);
  std::uint64_t bytes = 0;
  for (std::uint32_t i = 0; i < memory.memoryProperties.memoryHeapCount; ++i) {
    const VkMemoryHeap& heap = memory.memoryProperties.memoryHeaps[i];
    if (!(heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)) continue;
    const VkDeviceSize used = std::min(budget.heapUsage[i], budget.heapBudget[i]);
    bytes = std::max<std::uint64_t>(bytes, budget.heapBudget[i] - used);
  }
  return bytes;
}

PhysicalDevice describe(VkPhysicalDevice handle, std::uint32_t index) {
  PhysicalDevice device;
  device.handle = handle;
  vkGetPhysicalDeviceProperties(handle, &device.properties);
  DeviceDescription& description = device.description;
  description.index = index;
  description.name = device.properties.deviceName;
  description.type = type_name(device.properties.deviceType);
  description.api_version = version_text(device.properties.apiVersion);
  description.memory_bytes = largest_device_heap(handle);
  if (device.properties.apiVersion >= VK_API_VERSION_1_2) {
    describe_1_2(device);
    device.tells_budget = has_extension(device, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
  } else {
    description.obstacles.push_back("it offers Vulkan " + description.api_version +
                                    ", but 1.2 is needed");
  }
  choose_queue(device);
  check_limits(device);
  return device;
}

std::vector<PhysicalDevice> describe_all(const Instance& instance) {
  std::vector<PhysicalDevice> devices;
  for (VkPhysicalDevice handle : instance.physical_devices()) {
    devices.push_back(describe(handle, static_cast<std::uint32_t>(devices.size())));
  }
  if (devices.empty()) {
    throw Failure("Vulkan", "vkEnumeratePhysicalDevices", "there is no Vulkan device",
                  "install a driver; mesa-vulkan-drivers has one for the CPU, too");
  }
  return devices;
}

const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices,
                             const std::string& selector) {
  const PhysicalDevice* best = nullptr;
  const PhysicalDevice* hindered = nullptr;
  for (const PhysicalDevice* device : matches(devices, selector)) {
    const int place = rank(device->properties.deviceType);
    if (!device->description.obstacles.empty()) {
      if (!hindered) hindered = device;
    } else if (!best || place < rank(best->properties.deviceType)) {
      best = device;
    }
  }
  if (best) return *best;
  if (hindered) {
    throw Failure(hindered->description.name, "",
                  "cannot serve: " + join(hindered->description.obstacles),
                  "choose another device with --device; there is " + list(devices));
  }
  throw Failure("--device", selector, "no Vulkan device has this index or name",
                "there is " + list(devices));
}

}  // namespace ppm::gpu
