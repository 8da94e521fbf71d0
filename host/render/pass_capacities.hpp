// How much of the photon passes is held at a time.
#pragma once

#include <cstdint>

#include "integrator.hpp"

namespace ppm::render {

struct PassCapacities {
  std::uint32_t passes;  ///< recorded at a time, 1 to PPM_BATCH_LIMIT
  std::uint64_t paths, photons, grid_entries;
};

/// What the settings ask for, or what suits the device; within its limits.
PassCapacities pass_capacities(const Settings& settings, const gpu::Device& device);

}  // namespace ppm::render
