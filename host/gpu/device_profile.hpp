// What is chosen differently for different devices: here and nowhere else.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace ppm::gpu {

/// None of it changes a picture. What is the same for all devices is no choice: read-only records
/// are texel buffers everywhere, because lavapipe reads them 1.3 to 2 times as fast as storage
/// buffers, and GPUs fetch a texel of four words through the same caches as a word of storage.
struct DeviceProfile {
  /// Invocations of a workgroup, for kernels that leave it open (PPM_SPEC_WORKGROUP_SIZE).
  std::uint32_t workgroup_size = 64;
  /// Consecutive blocks of items alternate between the halves of a dispatch
  /// (PPM_SPEC_ALTERNATE_HALVES).
  bool alternate_halves = false;
  /// Items of the first dispatch of a kernel of which nothing is known.
  std::uint64_t first_guess_items = 1u << 18;
  /// Chunks of a scan whose sums one invocation adds up, at most.
  std::uint32_t serial_scan_chunks = 256;
  /// Photon passes recorded at a time, at most.
  std::uint32_t passes_in_flight = 16;
  /// Paths whose state is kept at a time, photons that are kept at a time, entries of the photon
  /// grid's table: at most.
  std::uint64_t paths = 1u << 21, photons = 1u << 23, grid_entries = 1u << 24;
};

/// By the kind of device.
DeviceProfile device_profile(VkPhysicalDeviceType type);

}  // namespace ppm::gpu
