// The hit points of a range of pixels, and the statistics each of them feeds.
#pragma once

#include <array>
#include <cstdint>

#include "kernel.hpp"

namespace ppm::render {

/// Pixels [first_pixel, first_pixel + pixels) in the order of shared/camera.h. Hit points lie as
/// they were found, about in the order of pixels; `order` says which is where in canonical order, a
/// function of the scene and the options alone. Buffers hold `hits` records or some more.
struct HitTile {
  std::uint32_t first_pixel = 0, pixels = 0;
  std::uint32_t hits = 0;            ///< records: hit points, and light seen
  std::uint32_t max_pixel_hits = 0;  ///< most records of one pixel, if above PPM_RESOLVE_SLICE

  // Geometry: written once by the eye pass.
  std::array<gpu::Buffer, 5> planes;  ///< the fifth holds next to nothing in scenes without layers
  gpu::Buffer sample_start;  ///< first entry in `order` of each (pixel, sample), and the end
  gpu::Buffer order;         ///< record of each place in canonical order

  // Statistics, indexed apart from geometry.
  gpu::Buffer
      statistics;  ///< vec4: lambda, R^2 (before the first radius is found: footprint squared)
  gpu::Buffer photon_counts;  ///< uint: C
  gpu::Buffer sums;           ///< GatherSum, all zero between passes

  // Made once radii are known.
  gpu::Buffer search_order;    ///< uint: hit points (no light seen) in the order of SearchOrder
  std::uint32_t searches = 0;  ///< how many

  void bind_geometry(gpu::BindingTable& table) const {
    table.set(PPM_BIND_HITS_0, planes[0]);
    table.set(PPM_BIND_HITS_1, planes[1]);
    table.set(PPM_BIND_HITS_2, planes[2]);
    table.set(PPM_BIND_HITS_3, planes[3]);
    table.set(PPM_BIND_HITS_4, planes[4]);
  }
  void bind(gpu::BindingTable& table) const {
    bind_geometry(table);
    table.set(PPM_BIND_SAMPLE_START, sample_start);
    table.set(PPM_BIND_ORDER, order);
    table.set(PPM_BIND_STATISTICS, statistics);
    table.set(PPM_BIND_PHOTON_COUNTS, photon_counts);
    table.set(PPM_BIND_GATHER_SUMS, sums);
    if (search_order) table.set(PPM_BIND_SEARCH_ORDER, search_order);
  }
};

}  // namespace ppm::render
