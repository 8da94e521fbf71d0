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

/// What of a device decides them.
struct PassLimits {
  gpu::DeviceProfile profile;
  std::uint64_t storage_bytes;  ///< of one buffer, at most

  static PassLimits of(const gpu::Device& device);
  /// Of lavapipe, without asking it.
  static PassLimits of_cpu();
};

/// What the settings ask for, or what suits the device; within its limits.
PassCapacities pass_capacities(const Settings& settings, const PassLimits& limits);

}  // namespace ppm::render
