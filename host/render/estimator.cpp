#include "estimator.hpp"

#include <algorithm>

#include "ppm_shaders.hpp"
#include "region.hpp"
#include "shared/camera.h"
#include "shared/layout.h"
#include "shared/ppm.h"

namespace ppm::render {
namespace {

// Dispatches that one pass of a batch gives to long searches at most.
constexpr std::uint32_t kMostSlices = 32;
// Cells of the search order, in cells of the photons' grid.
constexpr float kOrderCell = 1.0f;

}  // namespace

Estimator::Estimator(gpu::Device& device, const gpu::BindingTable& scene, const SceneTraits& traits,
                     std::uint64_t tile_hits)
    : device_(device),
      scene_(scene),
      order_(device, traits, tile_hits),
      gather_(make_kernel(device, traits, shaders::gather, shaders::gather_plain)),
      gather_slices_(
          make_kernel(device, traits, shaders::gather_slices, shaders::gather_slices_plain)),
      update_(device, shaders::update),
      resolve_(device, shaders::resolve),
      radius_(device, shaders::radius),
      cursors_{{device, "search cursors A", tile_hits * sizeof(shared::GatherCursor),
                gpu::Usage::storage},
               {device, "search cursors B", tile_hits * sizeof(shared::GatherCursor),
                gpu::Usage::storage}},
      histogram_buffer_(device, "radius histogram", PPM_RADIUS_BINS * 4, gpu::Usage::storage),
      cursor_capacity_(tile_hits),
      counters_(device) {}

gpu::BindingTable Estimator::table_for(const HitTile& tile) const {
  gpu::BindingTable table = scene_;
  tile.bind(table);
  counters_.bind(table);
  table.set(PPM_BIND_RADIUS_HISTOGRAM, histogram_buffer_);
  return table;
}

bool Estimator::searches_fit_batch() const {
  return usual_slices_ <= kMostSlices;
}

shared::GatherPush Estimator::gather_push(const PhotonGrid& grid, std::uint32_t pass) const {
  shared::GatherPush push{};
  push.grid = grid.constants(pass);
  push.cursor_capacity = static_cast<std::uint32_t>(cursor_capacity_);
  return push;
}

Estimator::Rejected Estimator::gather(const HitTile& tile, const PhotonGrid& grid) {
  gpu::BindingTable table = table_for(tile);
  grid.bind(table);
  const gpu::Region region(device_, "gather");
  const shared::GatherPush push = gather_push(grid, 0);
  std::uint32_t searches = tile.searches, round = 0;
  for (; searches > 0; ++round) {
    table.set(PPM_BIND_CONTINUE_IN, cursors_[round % 2]);
    table.set(PPM_BIND_CONTINUE_OUT, cursors_[(round + 1) % 2]);
    device_.run([&](gpu::Recorder& recorder) {
      if (round == 0) {
        counters_.clear(recorder);
        recorder.dispatch(gather_, table, push, searches);
      } else {
        counters_.move(recorder, PPM_COUNTER_CONTINUE, PPM_COUNTER_SEARCHES);
        recorder.dispatch(gather_slices_, table, push, searches);
      }
      counters_.read(recorder);
    });
    searches = counters_[PPM_COUNTER_CONTINUE];
  }
  usual_slices_ = std::max({round, usual_slices_, 1u}) - 1;
  return {counters_[PPM_COUNTER_OVERFLOW], counters_[PPM_COUNTER_CLAMPED]};
}

void Estimator::record_gather(gpu::Recorder& recorder, const HitTile& tile, const PhotonGrid& grid,
                              std::uint32_t pass, const DeviceBatch& batch) {
  const gpu::Region region(device_, "gather");
  gpu::BindingTable table = table_for(tile);
  grid.bind(table);
  const shared::GatherPush push = gather_push(grid, pass);
  for (std::uint32_t round = 0; round <= usual_slices_; ++round) {
    table.set(PPM_BIND_CONTINUE_IN, cursors_[round % 2]);
    table.set(PPM_BIND_CONTINUE_OUT, cursors_[(round + 1) % 2]);
    if (round == 0) {
      recorder.dispatch(gather_, table, push, batch.if_going_on(tile.searches));
    } else {
      counters_.move(recorder, PPM_COUNTER_CONTINUE, PPM_COUNTER_SEARCHES);
      recorder.dispatch(gather_slices_, table, push,
                        counters_.count(PPM_COUNTER_SEARCHES, tile.searches));
    }
  }
}

void Estimator::update(std::span<const HitTile> tiles, float alpha) {
  device_.run([&](gpu::Recorder& recorder) {
    record_update(recorder, tiles, alpha, nullptr);
    read_histogram(recorder);
  });
}

void Estimator::record_update(gpu::Recorder& recorder, std::span<const HitTile> tiles, float alpha,
                              const DeviceBatch* batch) {
  const gpu::Region region(device_, "update");
  const shared::UpdatePush push{0, 0, alpha};
  recorder.fill(histogram_buffer_, 0, histogram_buffer_.bytes());
  for (const HitTile& tile : tiles) {
    if (batch) {
      recorder.dispatch(update_, table_for(tile), push, batch->if_going_on(tile.hits));
    } else {
      recorder.dispatch(update_, table_for(tile), push, tile.hits);
    }
  }
}

void Estimator::read_histogram(gpu::Recorder& recorder) {
  recorder.read(histogram_buffer_, radius_histogram_.data(), sizeof(radius_histogram_));
}

void Estimator::clear_sums(std::span<const HitTile> tiles) {
  device_.run([&](gpu::Recorder& recorder) {
    for (const HitTile& tile : tiles) recorder.fill(tile.sums, 0, tile.sums.bytes());
  });
}

void Estimator::reserve_pixels(std::uint64_t pixels) {
  if (pixels_ && pixels_.bytes() >= pixels * sizeof(glm::vec4)) return;
  pixels_ = {};
  pixels_ = gpu::Buffer(device_, "pixels", pixels * sizeof(glm::vec4), gpu::Usage::storage);
}

std::vector<glm::vec4> Estimator::resolve(const HitTile& tile, std::uint32_t samples, float scale) {
  const gpu::Region region(device_, "resolve");
  reserve_pixels(tile.pixels);
  gpu::BindingTable table = table_for(tile);
  table.set(PPM_BIND_PIXELS, pixels_);
  device_.run([&](gpu::Recorder& recorder) {
    std::uint32_t skip = 0;
    do {
      recorder.dispatch(resolve_, table, shared::ResolvePush{0, 0, samples, skip, scale},
                        tile.pixels);
      skip += PPM_RESOLVE_SLICE;
    } while (skip < tile.max_pixel_hits);
  });
  return pixels_.download<glm::vec4>(tile.pixels);
}

void Estimator::paint(const HitTile& tile, const Settings& settings, float scale,
                      Picture& picture) {
  const std::vector<glm::vec4> pixels = resolve(tile, settings.samples_per_pixel, scale);
  for (std::uint32_t i = 0; i < tile.pixels; ++i) {
    const glm::uvec2 at =
        shared::pixel_position(tile.first_pixel + i, settings.width, settings.height);
    float* rgb = &picture.rgb[3ull * (std::uint64_t{at.y} * settings.width + at.x)];
    rgb[0] = pixels[i].x;
    rgb[1] = pixels[i].y;
    rgb[2] = pixels[i].z;
  }
}

Picture Estimator::picture(HitTiles& tiles, const Settings& settings, float scale) {
  Picture picture = Picture::black(settings.width, settings.height);
  tiles.for_each([] { return false; }, HitTiles::Keep::no,
                 [&](const HitTile& tile) {
                   paint(tile, settings, scale, picture);
                   return true;
                 });
  return picture;
}

void Estimator::set_radii(const HitTile& tile, float fixed_radius, float footprints) {
  device_.run([&](gpu::Recorder& recorder) {
    recorder.dispatch(radius_, table_for(tile), shared::RadiusPush{0, 0, fixed_radius, footprints},
                      tile.hits);
  });
}

void Estimator::measure_radii(std::span<const HitTile> tiles) {
  // An update without photons changes no hit point and counts all radii.
  update(tiles, 0.5f);
}

void Estimator::add_radius(float radius2) {
  if (radius2 > 0.0f) ++radius_histogram_[shared::radius_bin(radius2)];  // else light seen
}

void Estimator::add_radii(const HitTile& tile, std::vector<float>& radii2) {
  for (const glm::vec4& statistic : tile.statistics.download<glm::vec4>(tile.hits)) {
    if (statistic.w > 0.0f) radii2.push_back(statistic.w);
    add_radius(statistic.w);
  }
}

void Estimator::update_and_add_radii(const HitTile& tile, float alpha) {
  const auto others = radius_histogram_;
  update(std::span(&tile, 1), alpha);
  for (std::size_t bin = 0; bin < others.size(); ++bin) radius_histogram_[bin] += others[bin];
}

void Estimator::order_searches(HitTile& tile, float cell) {
  order_.sort(tile, kOrderCell * cell);
}

std::vector<float> Estimator::prepare_searches(std::span<HitTile> tiles) {
  std::vector<float> radii2;
  clear_radii();
  for (const HitTile& tile : tiles) add_radii(tile, radii2);
  for (HitTile& tile : tiles) order_searches(tile, cell_size());
  return radii2;
}

}  // namespace ppm::render
