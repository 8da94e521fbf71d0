#include "eye_pass.hpp"

#include <algorithm>

#include "failure.hpp"
#include "ppm_shaders.hpp"
#include "shared/layout.h"

namespace ppm::render {
namespace {

// Glass splits a path in two while it weighs more than this. Chance in the eye pass leaves noise
// that no photon pass removes, so it is left to what hardly shows.
constexpr float kSplitWeight = 1.0f / 64.0f;

}  // namespace

std::uint64_t tile_capacity(const Settings& settings, const gpu::Device& device) {
  return std::min<std::uint64_t>(settings.tile_hits,
                                 device.max_storage_bytes() / sizeof(shared::HitPoint));
}

EyePass::EyePass(gpu::Device& device, const gpu::BindingTable& scene, const Settings& settings)
    : device_(device),
      samples_(settings.samples_per_pixel),
      filter_(settings.filter),
      capacity_(tile_capacity(settings, device)),
      hits_per_pixel_(1.4 * samples_),
      table_(scene),
      eye_(device, shaders::eye),
      count_(device, shaders::eye_count),
      scatter_(device, shaders::eye_scatter),
      order_(device, shaders::eye_order),
      scan_(device, capacity_),
      queue_{{device, "eye paths A", capacity_ * sizeof(shared::EyePath), gpu::Usage::storage},
             {device, "eye paths B", capacity_ * sizeof(shared::EyePath), gpu::Usage::storage}},
      staged_hits_(device, "staged hit points", capacity_ * sizeof(shared::HitPoint),
                   gpu::Usage::storage),
      staged_keys_(device, "staged keys", capacity_ * sizeof(shared::StagedKey),
                   gpu::Usage::storage),
      group_count_(device, "hit points a path", capacity_ * 4, gpu::Usage::storage),
      order_list_(device, "hit point order", capacity_ * 4, gpu::Usage::storage),
      counters_(device) {
  if (samples_ > capacity_) {
    throw Failure("", "--spp " + std::to_string(samples_),
                  "the eye paths of one pixel do not fit a tile",
                  "use at most " + std::to_string(capacity_) + " or raise --tile-hits");
  }
  table_.set(PPM_BIND_STAGED_HITS, staged_hits_);
  table_.set(PPM_BIND_STAGED_KEYS, staged_keys_);
  table_.set(PPM_BIND_CELL_COUNT, group_count_);
  table_.set(PPM_BIND_ORDER, order_list_);
  counters_.bind(table_);
  device.run(
      [&](gpu::Recorder& recorder) { recorder.fill(group_count_, 0, group_count_.bytes()); });
}

std::uint32_t EyePass::suggested_pixels() const {
  const double most = std::max(hits_per_pixel_, static_cast<double>(samples_));
  return static_cast<std::uint32_t>(std::max(1.0, 0.95 * static_cast<double>(capacity_) / most));
}

EyePass::Result EyePass::trace(std::uint32_t first_pixel, std::uint32_t pixels,
                               const std::function<bool()>& interrupted, HitTile& tile) {
  if (const Result result = trace_paths(first_pixel, pixels, interrupted); result != Result::done)
    return result;
  tile.first_pixel = first_pixel;
  tile.pixels = pixels;
  tile.hits = counters_[PPM_COUNTER_HITS];
  hits_per_pixel_ = std::max(hits_per_pixel_, static_cast<double>(tile.hits) / pixels);
  order_hits(tile);
  return Result::done;
}

EyePass::Result EyePass::trace_paths(std::uint32_t first_pixel, std::uint32_t pixels,
                                     const std::function<bool()>& interrupted) {
  std::uint64_t alive = std::uint64_t{pixels} * samples_;
  if (alive > capacity_) return Result::too_large;
  shared::EyePush push{};
  push.tile_first = first_pixel;
  push.samples = samples_;
  push.filter_kind = static_cast<std::uint32_t>(filter_);
  push.hit_capacity = static_cast<std::uint32_t>(capacity_);
  push.path_capacity = static_cast<std::uint32_t>(capacity_);
  push.split_weight = kSplitWeight;
  rays_ = 0;
  for (std::uint32_t round = 0; alive > 0; ++round) {
    if (interrupted()) return Result::interrupted;
    rays_ += alive;
    push.generate = round == 0 ? 1 : 0;
    table_.set(PPM_BIND_EYE_IN, queue_[round % 2]);
    table_.set(PPM_BIND_EYE_OUT, queue_[(round + 1) % 2]);
    device_.run([&](gpu::Recorder& recorder) {
      if (round == 0) {
        counters_.clear(recorder);
      } else {
        counters_.clear(recorder, PPM_COUNTER_PATHS_OUT);
      }
      recorder.dispatch(eye_, table_, push, alive);
      counters_.read(recorder);
    });
    alive = counters_[PPM_COUNTER_PATHS_OUT];
    if (alive > capacity_ || counters_[PPM_COUNTER_HITS] > capacity_) return Result::too_large;
  }
  return Result::done;
}

void EyePass::order_hits(HitTile& tile) {
  const std::uint32_t groups = tile.pixels * samples_;
  const auto plane = [&](const char* name, std::uint64_t bytes) {
    return gpu::Buffer(device_, name, tile.hits * bytes, gpu::Usage::storage_and_texels);
  };
  tile.planes = {plane("hit points 0", 16), plane("hit points 1", 16), plane("hit points 2", 16),
                 plane("hit points 3", 16)};
  tile.sample_start =
      gpu::Buffer(device_, "hit points of samples", (groups + 1ull) * 4, gpu::Usage::storage);
  tile.statistics = plane("statistics", 16);
  tile.photon_counts = gpu::Buffer(device_, "photon counts", tile.hits * 4ull, gpu::Usage::storage);
  tile.sums = gpu::Buffer(device_, "gather sums", tile.hits * sizeof(shared::GatherSum),
                          gpu::Usage::storage);
  tile.bind(table_);

  shared::EyeOrderPush push{};
  push.samples = samples_;
  device_.run([&](gpu::Recorder& recorder) {
    recorder.dispatch(count_, table_, push, tile.hits);
    scan_.record(recorder, group_count_, tile.sample_start, groups);
    recorder.dispatch(scatter_, table_, push, tile.hits);
    recorder.dispatch(order_, table_, push, tile.hits);
    recorder.fill(tile.photon_counts, 0, tile.photon_counts.bytes());
    recorder.fill(tile.sums, 0, tile.sums.bytes());
    counters_.read(recorder);
  });
  tile.max_pixel_hits = counters_[PPM_COUNTER_MAX_PIXEL_HITS];
}

}  // namespace ppm::render
