// The order in which hit points search for photons: neighbours in space together, so that they can
// share their searches. It decides how fast searches are, never what they find.
#pragma once

#include "exclusive_scan.hpp"
#include "hit_tile.hpp"
#include "scene_traits.hpp"

namespace ppm::render {

class SearchOrder {
 public:
  /// For up to `tile_hits` hit points a tile.
  SearchOrder(gpu::Device& device, const SceneTraits& scene, std::uint64_t tile_hits);

  /// Lists the tile's hit points by cells of about `cell` working units, in tile.search_order.
  void sort(HitTile& tile, float cell);

 private:
  gpu::Device& device_;
  SceneTraits scene_;
  std::uint32_t table_entries_;
  gpu::Kernel count_, scatter_;
  ExclusiveScan scan_;
  gpu::Buffer cell_count_, cell_start_;
};

}  // namespace ppm::render
