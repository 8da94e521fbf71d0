// The hit points of a range of pixels, in canonical order, and the statistics each of them feeds.
#pragma once

#include <array>
#include <cstdint>

#include "kernel.hpp"

namespace ppm::render {

/// Pixels [first_pixel, first_pixel + pixels) in the order of shared/camera.h. Buffers of exactly
/// the size needed.
struct HitTile {
  std::uint32_t first_pixel = 0, pixels = 0;
  std::uint32_t hits = 0;            ///< records: hit points, and light seen
  std::uint32_t max_pixel_hits = 0;  ///< most records of one pixel

  // Geometry: written once by the eye pass.
  std::array<gpu::Buffer, 4> planes;
  gpu::Buffer sample_start;  ///< first record of each (pixel, sample), and the end

  // Statistics, indexed apart from geometry.
  gpu::Buffer
      statistics;  ///< vec4: lambda, R^2 (before the first radius is found: footprint squared)
  gpu::Buffer photon_counts;  ///< uint: C
  gpu::Buffer sums;           ///< GatherSum, all zero between passes

  void bind(gpu::BindingTable& table) const {
    table.set(PPM_BIND_HITS_0, planes[0]);
    table.set(PPM_BIND_HITS_1, planes[1]);
    table.set(PPM_BIND_HITS_2, planes[2]);
    table.set(PPM_BIND_HITS_3, planes[3]);
    table.set(PPM_BIND_SAMPLE_START, sample_start);
    table.set(PPM_BIND_STATISTICS, statistics);
    table.set(PPM_BIND_PHOTON_COUNTS, photon_counts);
    table.set(PPM_BIND_GATHER_SUMS, sums);
  }
};

}  // namespace ppm::render
