#include "search_order.hpp"

#include "cell_table.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"

namespace ppm::render {

SearchOrder::SearchOrder(gpu::Device& device, const SceneTraits& scene, std::uint64_t tile_hits)
    : device_(device),
      scene_(scene),
      table_entries_(hashed_entries_for(tile_hits)),
      count_(device, shaders::order_count),
      scatter_(device, shaders::order_scatter),
      scan_(device, max_entries(table_entries_)),
      cell_count_(device, "hit points a cell", max_entries(table_entries_) * 4,
                  gpu::Usage::storage),
      cell_start_(device, "hit points of cells", (max_entries(table_entries_) + 1) * 4,
                  gpu::Usage::storage) {
  device.run([&](gpu::Recorder& recorder) { recorder.fill(cell_count_, 0, cell_count_.bytes()); });
}

void SearchOrder::sort(HitTile& tile, float cell) {
  const CellTable cells = cell_table(scene_.bounds_min, scene_.bounds_max, cell, table_entries_);
  tile.search_order = gpu::Buffer(device_, "search order", std::uint64_t{tile.hits} * 4,
                                  gpu::Usage::storage_and_texels);
  gpu::BindingTable table;
  tile.bind(table);
  table.set(PPM_BIND_CELL_COUNT, cell_count_);
  table.set(PPM_BIND_CELL_START, cell_start_);
  shared::GridPush push{};
  push.grid = cells.constants;
  const gpu::Region region(device_, "search order");
  device_.run([&](gpu::Recorder& recorder) {
    recorder.dispatch(count_, table, push, tile.hits);
    scan_.record(recorder, cell_count_, cell_start_, cells.entries);
    recorder.dispatch(scatter_, table, push, tile.hits);
    recorder.read(cell_start_, &tile.searches, sizeof(tile.searches),
                  std::uint64_t{cells.entries} * 4);
  });
}

}  // namespace ppm::render
