// The parts of the benchmark. Each prints a table.
#pragma once

#include <embree3/rtcore.h>

#include "device.hpp"

namespace ppm::benchmark {

/// Where a part runs.
struct Bench {
  gpu::Device& device;
  RTCDevice embree;
  unsigned threads;
};

/// Passes of the renderer, in milliseconds and Embree's rays.
void measure_rendering(const Bench& bench);

/// Traversal by itself: the same rays through the kernels and through rtcIntersect1.
void measure_traversal(const Bench& bench);

/// Building trees beside rtcBuildBVH, and the kernels' rays through both builders' trees.
void measure_trees(const Bench& bench);

}  // namespace ppm::benchmark
