// What Embree's own tree builder makes of a scene, as a yardstick for ours.
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <span>

#include "scene.hpp"

namespace ppm::benchmark {

/// Four-wide, leaves of at most four, as ours.
struct EmbreeTree {
  double seconds = 0.0;   ///< in rtcBuildBVH
  double sah_cost = 0.0;  ///< nodes + triangles visited, in the sense of Bvh::sah_cost
  std::size_t nodes = 0;
  std::size_t references =
      0;  ///< triangles in leaves; more than there are where triangles were split
};

/// Builds with rtcBuildBVH. `spatial_splits` makes it cut triangles, which high quality stands for
/// in Embree; without them high quality is the same as medium.
EmbreeTree build_embree_tree(RTCDevice device, std::span<const scene::Triangle> triangles,
                             bool spatial_splits);

}  // namespace ppm::benchmark
