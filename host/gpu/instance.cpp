#include "instance.hpp"

#include <atomic>
#include <cstdio>
#include <cstring>

#include "call.hpp"
#include "failure.hpp"

namespace ppm::gpu {
namespace {

const std::string kVulkan = "Vulkan";
const char* const kValidationLayer = "VK_LAYER_KHRONOS_validation";

std::atomic<std::uint64_t> message_total{0};

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* count) {
  std::fprintf(stderr, "ppm-vk: validation: %s\n", data->pMessage);
  ++*static_cast<std::uint64_t*>(count);
  ++message_total;
  return VK_FALSE;
}

// Only messages of validation itself: the loader's general warnings tell of drivers without
// hardware.
VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::uint64_t* count) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = count;
  return info;
}

bool has_layer(const char* name) {
  const auto layers =
      enumerate<VkLayerProperties>([](std::uint32_t* count, VkLayerProperties* data) {
        PPM_VK_CALL(kVulkan, vkEnumerateInstanceLayerProperties, count, data);
      });
  for (const VkLayerProperties& layer : layers) {
    if (std::strcmp(layer.layerName, name) == 0) return true;
  }
  return false;
}

bool has_extension(const char* name) {
  const auto extensions =
      enumerate<VkExtensionProperties>([](std::uint32_t* count, VkExtensionProperties* data) {
        PPM_VK_CALL(kVulkan, vkEnumerateInstanceExtensionProperties, nullptr, count, data);
      });
  for (const VkExtensionProperties& extension : extensions) {
    if (std::strcmp(extension.extensionName, name) == 0) return true;
  }
  return false;
}

}  // namespace

std::uint64_t all_validation_messages() {
  return message_total;
}

Instance::Instance(bool validation) {
  if (validation && !has_layer(kValidationLayer)) {
    throw Failure(kVulkan, kValidationLayer, "the validation layer is not installed",
                  "install the package vulkan-validationlayers, or do without validation");
  }
  names_objects_ = validation || has_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

  std::vector<const char*> layers, extensions;
  if (names_objects_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (validation) {
    layers.push_back(kValidationLayer);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(&messages_);
  const VkValidationFeatureEnableEXT enable =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.pNext = &messenger;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &enable;

  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "ppm-vk";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = validation ? &features : nullptr;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
  info.ppEnabledLayerNames = layers.data();
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  PPM_VK_CALL(kVulkan, vkCreateInstance, &info, nullptr, &handle_);
  if (validation) create_messenger(messenger);
}

void Instance::create_messenger(const VkDebugUtilsMessengerCreateInfoEXT& info) {
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(handle_, "vkCreateDebugUtilsMessengerEXT"));
  const char* const name = "vkCreateDebugUtilsMessengerEXT";
  const VkResult result = PPM_VK_TRY_AS(name, create, handle_, &info, nullptr, &messenger_);
  if (result < 0)
    vkDestroyInstance(handle_, nullptr);  // a constructor that throws has no destructor
  require_success(kVulkan, name, result);
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(handle_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(handle_, messenger_, nullptr);
  }
  vkDestroyInstance(handle_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
  return enumerate<VkPhysicalDevice>([this](std::uint32_t* count, VkPhysicalDevice* data) {
    PPM_VK_CALL(kVulkan, vkEnumeratePhysicalDevices, handle_, count, data);
  });
}

}  // namespace ppm::gpu
