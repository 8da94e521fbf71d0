#include "nearest_photons.hpp"

#include <bit>

#include "ppm_shaders.hpp"
#include "region.hpp"
#include "shared/nearest.h"

namespace ppm::render {
namespace {

gpu::Buffer cursors(gpu::Device& device, const char* name, std::uint64_t count) {
  return gpu::Buffer(device, name, count * sizeof(shared::GatherCursor), gpu::Usage::storage);
}

gpu::Buffer hit_list(gpu::Device& device, const char* name, std::uint64_t count) {
  return gpu::Buffer(device, name, count * sizeof(std::uint32_t), gpu::Usage::storage_and_texels);
}

}  // namespace

NearestPhotons::NearestPhotons(gpu::Device& device, const SceneTraits& traits,
                               std::uint64_t tile_hits)
    : device_(device),
      begin_(device, shaders::nearest_begin),
      search_(make_kernel(device, traits, shaders::nearest, shaders::nearest_plain)),
      slices_(make_kernel(device, traits, shaders::nearest_slices, shaders::nearest_slices_plain)),
      decide_(device, shaders::nearest_decide),
      searches_(device, "nearest photons", tile_hits * sizeof(shared::NearestSearch),
                gpu::Usage::storage),
      list_{hit_list(device, "hit points A", tile_hits),
            hit_list(device, "hit points B", tile_hits)},
      cursors_{cursors(device, "nearest cursors A", tile_hits),
               cursors(device, "nearest cursors B", tile_hits)},
      histogram_(device, "radius histogram", PPM_RADIUS_BINS * 4, gpu::Usage::storage),
      cursor_capacity_(tile_hits),
      counters_(device) {
  clear_histogram();
}

gpu::BindingTable NearestPhotons::table_for(const HitTile& tile) const {
  gpu::BindingTable table;
  tile.bind(table);
  counters_.bind(table);
  table.set(PPM_BIND_NEAREST, searches_);
  table.set(PPM_BIND_RADIUS_HISTOGRAM, histogram_);
  return table;
}

shared::NearestStepPush NearestPhotons::step_push(const Request& request) const {
  shared::NearestStepPush push{};
  push.stride = request.stride;
  push.guess = request.guess2;
  push.spread = request.spread;
  push.most = shared::nearest_word(request.largest_radius * request.largest_radius);
  push.wanted = request.wanted;
  push.round = rounds_;
  return push;
}

void NearestPhotons::find(const HitTile& tile, std::span<const PhotonGrid> grids,
                          const Request& request) {
  const gpu::Region region(device_, "nearest");
  rounds_ = 0;
  std::uint32_t undecided = begin(tile, request);
  while (undecided > 0) {
    undecided = make_round(tile, grids, request, undecided);
    ++rounds_;
  }
}

std::uint32_t NearestPhotons::begin(const HitTile& tile, const Request& request) {
  if (tile.searches == 0) return 0;
  const std::uint32_t searches = (tile.searches + request.stride - 1) / request.stride;
  gpu::BindingTable table = table_for(tile);
  table.set(PPM_BIND_CONTINUE_OUT, list());
  device_.run([&](gpu::Recorder& recorder) {
    recorder.dispatch(begin_, table, step_push(request), searches);
  });
  return searches;
}

std::uint32_t NearestPhotons::make_round(const HitTile& tile, std::span<const PhotonGrid> grids,
                                         const Request& request, std::uint32_t searches) {
  for (const PhotonGrid& grid : grids) search(tile, grid, request, searches);
  gpu::BindingTable table = table_for(tile);
  table.set(PPM_BIND_CONTINUE_IN, list());
  table.set(PPM_BIND_CONTINUE_OUT, next_list());
  device_.run([&](gpu::Recorder& recorder) {
    counters_.clear(recorder);
    recorder.dispatch(decide_, table, step_push(request), searches);
    counters_.read(recorder);
  });
  return counters_[PPM_COUNTER_UNDECIDED];
}

void NearestPhotons::search(const HitTile& tile, const PhotonGrid& grid, const Request& request,
                            std::uint32_t searches) {
  gpu::BindingTable table = table_for(tile);
  grid.bind(table);
  table.set(PPM_BIND_SEARCH_ORDER, list());
  shared::NearestPush push{};
  push.grid = grid.constants();
  push.cursor_capacity = static_cast<std::uint32_t>(cursor_capacity_);
  push.wanted = request.wanted;
  push.max_depth = request.max_depth;
  for (std::uint32_t slice = 0; searches > 0; ++slice) {
    table.set(PPM_BIND_CONTINUE_IN, cursors_[slice % 2]);
    table.set(PPM_BIND_CONTINUE_OUT, cursors_[(slice + 1) % 2]);
    device_.run([&](gpu::Recorder& recorder) {
      if (slice == 0) {
        counters_.clear(recorder);
        recorder.dispatch(search_, table, push, searches);
      } else {
        counters_.move(recorder, PPM_COUNTER_CONTINUE, PPM_COUNTER_SEARCHES);
        recorder.dispatch(slices_, table, push, searches);
      }
      counters_.read(recorder);
    });
    searches = counters_[PPM_COUNTER_CONTINUE];
  }
}

std::array<std::uint32_t, PPM_RADIUS_BINS> NearestPhotons::histogram() {
  std::array<std::uint32_t, PPM_RADIUS_BINS> histogram{};
  device_.run([&](gpu::Recorder& recorder) {
    recorder.read(histogram_, histogram.data(), sizeof histogram);
  });
  return histogram;
}

void NearestPhotons::clear_histogram() {
  device_.run([&](gpu::Recorder& recorder) { recorder.fill(histogram_, 0, histogram_.bytes()); });
}

}  // namespace ppm::render
