#include "portions.hpp"

#include <algorithm>

#include "bidirectional_sampler.hpp"
#include "eye_pass.hpp"
#include "eye_shape.hpp"
#include "photon_map.hpp"

namespace ppm::render {
namespace {

std::uint64_t fewest_of_pixels(const Settings& settings) {
  return std::max<std::uint64_t>(kFewestTileHits, 2 * settings.samples_per_pixel);
}

}  // namespace

Portions ppm_portions(const Settings& settings, const PassLimits& limits) {
  return {EyeShape::of(settings, limits).tile_room, pass_capacities(settings, limits).photons,
          fewest_of_pixels(settings)};
}

Portions photon_map_portions(const Settings& settings, const PassLimits& limits) {
  Portions portions = ppm_portions(settings, limits);
  portions.photons = std::max(portions.photons, PhotonMapShape::of(settings, limits).grid_photons);
  return portions;
}

Portions path_tracer_portions(const Settings& settings, const PassLimits& limits) {
  return {pass_capacities(settings, limits).camera_paths, settings.photon_capacity,
          fewest_of_pixels(settings)};
}

Portions bdpt_portions(const Settings& settings, const PassLimits& limits) {
  return {sampler_capacities(settings, limits.storage_bytes, 0).paths, settings.photon_capacity,
          fewest_of_pixels(settings)};
}

}  // namespace ppm::render
