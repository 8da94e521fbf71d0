// Passes of the renderer itself, through the interface that the driver uses.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "device.hpp"
#include "scene.hpp"

namespace ppm::benchmark {

/// Seconds, one entry a repeat.
struct PassTimes {
  std::vector<double> prepare;  ///< before the first pass, all told
  std::vector<double> eye;      ///< the eye passes' share of that
  std::vector<double> first;   ///< a pass at the start (the second one: the first compiles kernels)
  std::vector<double> shrunk;  ///< a pass once radii have halved
  std::map<std::string, double> kernels;  ///< device time of an average first pass, by kernel
  /// Embree's rays a second around prepare and eye, first, shrunk.
  std::vector<double> unit_at_start, unit_at_first, unit_at_shrunk;
};

/// Renders `scene` at 640 x 480, one eye path a pixel, 100000 photons a pass.
PassTimes measure_passes(gpu::Device& device, const scene::Scene& scene, unsigned threads,
                         int repeats, const std::function<double()>& unit);

}  // namespace ppm::benchmark
