// How the eye paths of a picture are cut into tiles, and what those take on the device: reckoned
// beforehand, as EyePass and HitTiles do it.
#pragma once

#include <cstdint>

#include "integrator.hpp"
#include "pass_capacities.hpp"

namespace ppm::render {

struct EyeShape {
  std::uint64_t tiles, hits, groups;  ///< of the whole picture; groups: eye paths
  std::uint64_t room;                 ///< records that all tiles together have room for
  std::uint64_t tile_room, tile_hits, tile_pixels, tile_groups;  ///< of the largest
  std::uint64_t capacity, queue;                                 ///< EyePass's
  std::uint64_t room_bytes;                                      ///< of a record's geometry

  /// With as many hit points to an eye path as the limits say.
  static EyeShape of(const Settings& settings, const PassLimits& limits);

  std::uint64_t all_tiles_bytes() const;  ///< when they stay
  std::uint64_t tile_bytes() const;       ///< of the largest alone
  std::uint64_t making_bytes() const;     ///< while tiles are made, beside them
};

}  // namespace ppm::render
