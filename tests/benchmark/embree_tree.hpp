// What Embree's own tree builder makes of a scene, as a yardstick for ours.
#pragma once

#include <embree3/rtcore.h>

#include <span>

#include "bvh.hpp"
#include "scene.hpp"

namespace ppm::benchmark {

struct EmbreeTree {
  double seconds = 0.0;  ///< in rtcBuildBVH
  /// Four-wide, leaves of at most four, as ours. A triangle that was split stands in triangle_order
  /// more than once. Empty where there are no triangles.
  bvh::Bvh tree;
};

/// Builds with rtcBuildBVH. `spatial_splits` makes it cut triangles, which high quality stands for
/// in Embree; without them high quality is the same as medium. Throws Failure where the tree is too
/// deep for the kernels.
EmbreeTree build_embree_tree(RTCDevice device, std::span<const scene::Triangle> triangles,
                             bool spatial_splits);

}  // namespace ppm::benchmark
