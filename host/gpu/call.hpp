// The one path of Vulkan calls that can fail: the call is named, its result checked, and tests can
// make it fail.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <source_location>
#include <string>
#include <vector>

namespace ppm::gpu {

/// Counts the calls that go through PPM_VK_TRY and, in tests, replaces the result of one of them:
/// call number `fail_at` (1 is the first after `calls` was set to 0) returns `result` without
/// reaching the driver.
struct FaultInjection {
  std::uint64_t calls = 0;
  std::uint64_t fail_at = 0;  ///< 0: none
  VkResult result = VK_ERROR_OUT_OF_HOST_MEMORY;
  const char* failed = nullptr;  ///< name of the call that was made to fail
  /// Asked at each call of each place in the source, instead of counting up to `fail_at`: whether
  /// this one is to fail. Several threads may ask at a time.
  std::function<bool(const char* call, const std::source_location& place)> chooses = {};
};
FaultInjection& fault_injection();

/// Whether this call is the one to fail; counts it.
bool fault_is_due(const char* call,
                  const std::source_location& place = std::source_location::current());

/// "VK_ERROR_DEVICE_LOST"; numbers for results unknown here.
std::string result_name(VkResult result);

/// Throws Failure(device, call, result name, remedy) for errors, MemoryShortage where it is the
/// device's memory, DeviceLost; returns the other results.
VkResult require_success(const std::string& device, const char* call, VkResult result);

/// What Vulkan's pairs of calls list: `call(&count, nullptr)` counts, `call(&count, data)` fills.
template <class T, class Call>
std::vector<T> enumerate(const Call& call) {
  std::uint32_t count = 0;
  call(&count, static_cast<T*>(nullptr));
  std::vector<T> values(count);
  if (count > 0) call(&count, values.data());
  values.resize(count);
  return values;
}

}  // namespace ppm::gpu

/// The result of a call by pointer, with its name for messages; for those whose failure is not the
/// end.
#define PPM_VK_TRY_AS(name, function, ...) \
  (::ppm::gpu::fault_is_due(name) ? ::ppm::gpu::fault_injection().result : (function)(__VA_ARGS__))
#define PPM_VK_TRY(function, ...) PPM_VK_TRY_AS(#function, function, __VA_ARGS__)
/// A call that must succeed.
#define PPM_VK_CALL(device_name, function, ...) \
  ::ppm::gpu::require_success(device_name, #function, PPM_VK_TRY(function, __VA_ARGS__))
