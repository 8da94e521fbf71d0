#include "pass_capacities.hpp"

#include <algorithm>

#include "shared/layout.h"

namespace ppm::render {
namespace {

// Some three deposits a path in a closed room. Eight spare most scenes a second try; in a batch
// passes make up for each other.
constexpr std::uint64_t kPhotonsAPath = 8;
constexpr std::uint64_t kPhotonsABatchPath = 4;
constexpr std::uint64_t kFewestPhotons = 1u << 16;
// The largest that is ever needed: the kernels tell passes apart by single precision.
constexpr std::uint64_t kMostPaths = 1u << 23;
constexpr std::uint64_t kGridEntriesAPass = 1u << 20;
// What the device room takes for itself, and what copies to memory that the host cannot see.
constexpr std::uint64_t kTransferBytes = (1u << 20) + (1u << 16), kStagingBytes = 1u << 24;

}  // namespace

PassLimits PassLimits::of(const gpu::Device& device) {
  return {device.profile(), device.max_storage_bytes(),
          device.shares_host_memory() ? kTransferBytes : kTransferBytes + kStagingBytes};
}

PassLimits PassLimits::of_cpu() {
  return {gpu::device_profile(VK_PHYSICAL_DEVICE_TYPE_CPU), std::uint64_t{1} << 27, kTransferBytes};
}

PassCapacities pass_capacities(const Settings& settings, const PassLimits& limits) {
  const gpu::DeviceProfile& profile = limits.profile;
  const std::uint64_t emitted = settings.photons_per_pass;
  // Who asks for passes in flight gets room for them.
  const std::uint64_t asked = std::min(settings.passes_in_flight, std::uint32_t{PPM_BATCH_LIMIT});
  PassCapacities capacities;
  capacities.passes = static_cast<std::uint32_t>(
      asked > 0 ? asked : std::min(profile.passes_in_flight, std::uint32_t{PPM_BATCH_LIMIT}));
  capacities.paths = std::max(profile.paths, std::min(asked * emitted, kMostPaths));
  capacities.photons =
      std::min(settings.photon_capacity > 0
                   ? settings.photon_capacity
                   : std::max(profile.photons, asked * kPhotonsABatchPath * emitted),
               std::max({kPhotonsAPath * emitted, capacities.passes * kPhotonsABatchPath * emitted,
                         kFewestPhotons}));
  capacities.grid_entries = std::max(profile.grid_entries, asked * kGridEntriesAPass);
  if (settings.photon_capacity > 0) {
    // Hardly a path leaves no photon; and a table of one pass is made in any case.
    capacities.paths = std::min(capacities.paths, settings.photon_capacity);
    capacities.grid_entries = std::min(capacities.grid_entries, 4 * settings.photon_capacity);
  }

  // A picture is traced in parts of so many paths, a small one several times at once.
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  capacities.camera_paths =
      std::min({profile.paths, settings.tile_hits, pixels * PPM_PATH_MOST_PASSES});

  const std::uint64_t bytes = limits.storage_bytes;
  capacities.camera_paths =
      std::min<std::uint64_t>(capacities.camera_paths, bytes / sizeof(shared::CameraPath));
  capacities.paths = std::min(capacities.paths, bytes / sizeof(shared::PhotonPath));
  capacities.photons = std::min(capacities.photons, bytes / 16);
  capacities.grid_entries = std::min(capacities.grid_entries, bytes / 4 - 1);
  return capacities;
}

}  // namespace ppm::render
