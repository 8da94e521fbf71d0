#include "device_profile.hpp"

namespace ppm::gpu {
namespace {

// Lavapipe. Workgroups of 8 to 256 cost the same. It hands each of its threads one contiguous part
// of the workgroups and steals nothing, so that dear and cheap parts of a picture must be dealt out
// evenly. Two cores are full with one pass, and memory is what others need, too.
DeviceProfile cpu_profile() {
  DeviceProfile profile;
  profile.alternate_halves = true;
  profile.first_guess_items = 1u << 14;
  profile.serial_scan_chunks = 1u << 20;
  profile.passes_in_flight = 1;
  profile.paths = 1u << 18;
  profile.photons = 1u << 20;
  profile.grid_entries = 1u << 20;
  return profile;
}

// A small GPU that shares the host's memory: a few hundred thousand paths fill it.
DeviceProfile integrated_profile() {
  DeviceProfile profile;
  profile.first_guess_items = 1u << 16;
  profile.passes_in_flight = 4;
  profile.paths = 1u << 19;
  profile.photons = 1u << 21;
  profile.grid_entries = 1u << 22;
  return profile;
}

}  // namespace

// Large GPUs keep some 10^5 invocations in flight, several times over until the last ones of a
// dispatch are no longer noticed: 16 passes of 10^5 paths. Groups of 64 are two warps or one wave,
// and give their registers back early.
DeviceProfile device_profile(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return cpu_profile();
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
    case VK_PHYSICAL_DEVICE_TYPE_OTHER:
      return integrated_profile();
    default:
      return {};
  }
}

}  // namespace ppm::gpu
