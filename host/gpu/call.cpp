#include "call.hpp"

#include <atomic>

#include "device_lost.hpp"
#include "failure.hpp"
#include "memory_shortage.hpp"

namespace ppm::gpu {
namespace {

const char* remedy(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "free some memory, or render a smaller picture with fewer photons";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "render a smaller picture with fewer photons, or choose another device with --device";
    case VK_ERROR_DEVICE_LOST:
      return "the driver gave the device up, perhaps for too long a dispatch: try a smaller "
             "--dispatch-ms";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "install a Vulkan driver, for example the package mesa-vulkan-drivers";
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "install the package vulkan-validationlayers";
    default:
      return "update the Vulkan driver, or choose another device with --device";
  }
}

}  // namespace

FaultInjection& fault_injection() {
  static FaultInjection injection;
  return injection;
}

bool fault_is_due(const char* call, const std::source_location& place) {
  FaultInjection& injection = fault_injection();
  // Kernels may be made by another thread.
  const std::uint64_t number = ++std::atomic_ref(injection.calls);
  if (!(injection.chooses ? injection.chooses(call, place) : number == injection.fail_at)) {
    return false;
  }
  injection.failed = call;
  return true;
}

std::string result_name(VkResult result) {
#define PPM_RESULT(name) \
  case name:             \
    return #name
  switch (result) {
    PPM_RESULT(VK_SUCCESS);
    PPM_RESULT(VK_NOT_READY);
    PPM_RESULT(VK_TIMEOUT);
    PPM_RESULT(VK_INCOMPLETE);
    PPM_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY);
    PPM_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY);
    PPM_RESULT(VK_ERROR_INITIALIZATION_FAILED);
    PPM_RESULT(VK_ERROR_DEVICE_LOST);
    PPM_RESULT(VK_ERROR_MEMORY_MAP_FAILED);
    PPM_RESULT(VK_ERROR_LAYER_NOT_PRESENT);
    PPM_RESULT(VK_ERROR_EXTENSION_NOT_PRESENT);
    PPM_RESULT(VK_ERROR_FEATURE_NOT_PRESENT);
    PPM_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER);
    PPM_RESULT(VK_ERROR_TOO_MANY_OBJECTS);
    PPM_RESULT(VK_ERROR_FORMAT_NOT_SUPPORTED);
    PPM_RESULT(VK_ERROR_FRAGMENTED_POOL);
    PPM_RESULT(VK_ERROR_UNKNOWN);
    PPM_RESULT(VK_ERROR_OUT_OF_POOL_MEMORY);
    PPM_RESULT(VK_ERROR_FRAGMENTATION);
    PPM_RESULT(VK_ERROR_INVALID_SHADER_NV);
    default:
      return "VkResult " + std::to_string(static_cast<int>(result));
  }
#undef PPM_RESULT
}

VkResult require_success(const std::string& device, const char* call, VkResult result) {
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
    throw MemoryShortage(device, call, result_name(result), remedy(result));
  }
  if (result == VK_ERROR_DEVICE_LOST) {
    throw DeviceLost(device, call, result_name(result), remedy(result));
  }
  if (result < 0) throw Failure(device, call, result_name(result), remedy(result));
  return result;
}

}  // namespace ppm::gpu
