// What each method can do in pieces of any size, so that a rendering fits the memory there is.
#pragma once

#include <cstdint>

#include "integrator.hpp"
#include "pass_capacities.hpp"

namespace ppm::render {

struct Portions {
  std::uint64_t tile_hits;         ///< hit points at a time; paths, in methods without
  std::uint64_t photons;           ///< at a time
  std::uint64_t fewest_tile_hits;  ///< fewer would save hardly anything, or not do for one pixel
};

/// Those of the settings, no larger than anything can be: in the table of methods (integrator.cpp).
Portions method_portions(const Settings& settings, const PassLimits& limits);
Portions ppm_portions(const Settings& settings, const PassLimits& limits);
Portions photon_map_portions(const Settings& settings, const PassLimits& limits);
Portions path_tracer_portions(const Settings& settings, const PassLimits& limits);
Portions bdpt_portions(const Settings& settings, const PassLimits& limits);
Portions mlt_portions(const Settings& settings, const PassLimits& limits);

}  // namespace ppm::render
