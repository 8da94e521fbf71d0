// How much of the photon passes is held at a time.
#pragma once

#include <cstdint>

#include "integrator.hpp"

namespace ppm::render {

struct PassCapacities {
  std::uint32_t passes;  ///< recorded at a time, 1 to PPM_BATCH_LIMIT
  std::uint64_t paths, photons, grid_entries;
  std::uint64_t camera_paths;  ///< whose state is kept at a time, of methods that trace them
};

/// What of device and scene decides how much is held.
struct PassLimits {
  gpu::DeviceProfile profile;
  std::uint64_t storage_bytes;   ///< of one buffer, at most
  std::uint64_t transfer_bytes;  ///< between host and device, held for the device's life
  double hits_a_path = 1.25;     ///< hit points, and light seen, to be expected of an eye path
  bool layered_hits = false;     ///< SceneTraits::layers

  static PassLimits of(const gpu::Device& device);
  /// Of lavapipe, without asking it.
  static PassLimits of_cpu();
};

/// What the settings ask for, or what suits the device; within its limits.
PassCapacities pass_capacities(const Settings& settings, const PassLimits& limits);

}  // namespace ppm::render
