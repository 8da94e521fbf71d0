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
// Hit points expected of an eye path before the first tile tells.
constexpr double kHitsPerPath = 1.4;
// More paths than the picture has are in a queue only where glass splits many of them: a small
// picture's queue has room for this many.
constexpr std::uint64_t kLeastQueue = 1u << 16;

// Where few paths are left, rounds of one segment would cost more to submit than to trace.
constexpr std::uint32_t kBouncesOfFew = 16;
constexpr std::uint64_t kFewPaths = 4096;

constexpr std::uint32_t kGenerate = 0, kSurfaces = 1;  // specialisation constants of eye.comp

// Memory is made for this many times the hit points expected: tracing again would cost more. Where
// in the end it is more than so many times what they take, they are copied.
constexpr double kSpareRoom = 2.0;
constexpr std::uint64_t kMostSpareRoom = 3;

/// Gives `buffer` room for so many bytes, and other contents where it had too little.
void reserve_bytes(gpu::Device& device, gpu::Buffer& buffer, const char* name, std::uint64_t bytes,
                   gpu::Usage usage) {
  if (buffer && buffer.bytes() >= bytes) return;
  buffer = {};
  buffer = gpu::Buffer(device, name, bytes, usage);
}

std::uint64_t queue_capacity(const Settings& settings, std::uint64_t hits) {
  const std::uint64_t paths =
      std::uint64_t{settings.width} * settings.height * settings.samples_per_pixel;
  return std::min(hits, std::max(paths, kLeastQueue));
}

}  // namespace

std::uint64_t tile_capacity(const Settings& settings, std::uint64_t storage_bytes) {
  return std::min<std::uint64_t>(settings.tile_hits, storage_bytes / sizeof(shared::HitPoint));
}

std::uint64_t tile_records(const Settings& settings, std::uint64_t storage_bytes) {
  const EyeRoom room = EyeRoom::of(settings, storage_bytes);
  return room.records_for(room.hits_a_pixel, std::uint64_t{settings.width} * settings.height);
}

EyeRoom EyeRoom::of(const Settings& settings, std::uint64_t storage_bytes) {
  const std::uint64_t capacity = tile_capacity(settings, storage_bytes);
  return {capacity, queue_capacity(settings, capacity), settings.samples_per_pixel,
          kHitsPerPath * settings.samples_per_pixel};
}

std::uint32_t EyeRoom::pixels_for(double hits_expected) const {
  const double pixels = std::min(0.95 * static_cast<double>(capacity) / hits_expected,
                                 static_cast<double>(queue / samples));
  return static_cast<std::uint32_t>(std::max(1.0, pixels));
}

std::uint64_t EyeRoom::records_for(double hits_expected, std::uint64_t pixels) const {
  const double expected = kSpareRoom * hits_expected * static_cast<double>(pixels);
  return std::min(capacity, static_cast<std::uint64_t>(expected) + 1);
}

std::uint64_t EyeRoom::tightened(std::uint64_t room, std::uint64_t hits) {
  return room > kMostSpareRoom * hits ? hits : std::max(room, hits);
}

EyeKernels::EyeKernels(gpu::Device& device, const SceneTraits& traits, Find find)
    : start(make_kernel(device, traits, shaders::eye, shaders::eye_plain,
                        {{kGenerate, 1}, {kSurfaces, find == Find::surfaces}})),
      go_on(make_kernel(device, traits, shaders::eye, shaders::eye_plain,
                        {{kGenerate, 0}, {kSurfaces, find == Find::surfaces}})),
      scatter(device, shaders::eye_scatter),
      order(device, shaders::eye_order),
      layers(traits.layers && find == Find::hit_points) {}

EyePass::EyePass(gpu::Device& device, const EyeKernels& kernels, const gpu::BindingTable& scene,
                 const Settings& settings)
    : device_(device),
      kernels_(kernels),
      samples_(settings.samples_per_pixel),
      filter_(settings.filter),
      room_(EyeRoom::of(settings, device.max_storage_bytes())),
      hits_per_pixel_(room_.hits_a_pixel),
      table_(scene),
      scan_(device, room_.queue),
      queue_{{device, "eye paths A", room_.queue * sizeof(shared::EyePath), gpu::Usage::storage},
             {device, "eye paths B", room_.queue * sizeof(shared::EyePath), gpu::Usage::storage}},
      group_count_(device, "hit points a path", room_.queue * 4, gpu::Usage::storage),
      counters_(device) {
  if (samples_ > room_.queue) {
    throw Failure("", "--spp " + std::to_string(samples_),
                  "the eye paths of one pixel do not fit a tile",
                  "use at most " + std::to_string(room_.queue) + " or raise --tile-hits");
  }
  table_.set(PPM_BIND_CELL_COUNT, group_count_);
  counters_.bind(table_);
}

EyePass::Result EyePass::trace(std::uint32_t first_pixel, std::uint32_t pixels,
                               const std::function<bool()>& interrupted, HitTile& tile) {
  if (std::uint64_t{pixels} * samples_ > room_.queue) return Result::too_large;
  tile.first_pixel = first_pixel;
  tile.pixels = pixels;
  std::uint64_t room = room_.records_for(hits_per_pixel_, pixels);
  for (;;) {
    reserve(tile, room);
    const Result result = trace_paths(tile, room, interrupted);
    if (result != Result::done) return result;
    tile.hits = counters_[PPM_COUNTER_HITS];
    hits_per_pixel_ = std::max(hits_per_pixel_, static_cast<double>(tile.hits) / pixels);
    if (tile.hits <= room) break;
    room = tile.hits;  // now it is known how many there are
  }
  order_hits(tile);
  return Result::done;
}

void EyePass::reserve(HitTile& tile, std::uint64_t hits) {
  const auto plane = [&](gpu::Buffer& buffer, const char* name, bool needed = true) {
    reserve_bytes(device_, buffer, name, needed ? hits * 16 : 16, gpu::Usage::storage_and_texels);
  };
  constexpr const char* kNames[] = {"hit points 0", "hit points 1", "hit points 2", "hit points 3"};
  for (std::size_t i = 0; i < 4; ++i) plane(tile.planes[i], kNames[i]);
  plane(tile.planes[4], "hit points 4", kernels_.layers);
  plane(tile.statistics, "statistics");
  if (!keys_ || keys_.bytes() < hits * sizeof(shared::HitKey)) {
    keys_ = {};
    keys_ =
        gpu::Buffer(device_, "hit point keys", hits * sizeof(shared::HitKey), gpu::Usage::storage);
    arrivals_ = gpu::Buffer(device_, "hit points as found", hits * 4, gpu::Usage::storage);
  }
}

EyePass::Result EyePass::trace_paths(const HitTile& tile, std::uint64_t room,
                                     const std::function<bool()>& interrupted) {
  gpu::BindingTable table = table_;
  tile.bind_geometry(table);
  table.set(PPM_BIND_STATISTICS, tile.statistics);
  table.set(PPM_BIND_HIT_KEYS, keys_);
  shared::EyePush push{};
  push.tile_first = tile.first_pixel;
  push.samples = samples_;
  push.filter_kind = static_cast<std::uint32_t>(filter_);
  push.hit_capacity = static_cast<std::uint32_t>(room);
  push.path_capacity = static_cast<std::uint32_t>(room_.queue);
  push.split_weight = kSplitWeight;
  std::uint64_t alive = std::uint64_t{tile.pixels} * samples_;
  rays_ = 0;
  for (std::uint32_t round = 0; alive > 0; ++round) {
    if (interrupted()) return Result::interrupted;
    push.bounces = alive > kFewPaths ? 1 : kBouncesOfFew;
    if (round == 0 || push.bounces == 1) rays_ += alive;
    table.set(PPM_BIND_EYE_IN, queue_[round % 2]);
    table.set(PPM_BIND_EYE_OUT, queue_[(round + 1) % 2]);
    device_.run([&](gpu::Recorder& recorder) {
      if (round == 0) {
        counters_.clear(recorder);
      } else {
        counters_.clear(recorder, PPM_COUNTER_PATHS_OUT);
      }
      recorder.dispatch(round == 0 ? kernels_.start : kernels_.go_on, table, push, alive);
      counters_.read(recorder);
    });
    alive = counters_[PPM_COUNTER_PATHS_OUT];
    if (alive > room_.queue || counters_[PPM_COUNTER_HITS] > room_.capacity)
      return Result::too_large;
  }
  rays_ += counters_[PPM_COUNTER_EYE_RAYS];
  return Result::done;
}

void EyePass::order_hits(HitTile& tile) {
  const std::uint32_t groups = tile.pixels * samples_;
  const auto reserve = [&](gpu::Buffer& buffer, const char* name, std::uint64_t bytes) {
    reserve_bytes(device_, buffer, name, bytes, gpu::Usage::storage);
  };
  reserve(tile.sample_start, "hit points of samples", (groups + 1ull) * 4);
  reserve(tile.order, "hit point order", tile.hits * 4ull);
  reserve(tile.photon_counts, "photon counts", tile.hits * 4ull);
  reserve(tile.sums, "gather sums", tile.hits * sizeof(shared::GatherSum));
  gpu::BindingTable table = table_;
  tile.bind(table);
  table.set(PPM_BIND_HIT_KEYS, keys_);
  table.set(PPM_BIND_ARRIVALS, arrivals_);

  shared::EyeOrderPush push{};
  push.samples = samples_;
  device_.run([&](gpu::Recorder& recorder) {
    scan_.record(recorder, group_count_, tile.sample_start, groups);
    recorder.dispatch(kernels_.scatter, table, push, tile.hits);
    recorder.dispatch(kernels_.order, table, push, tile.hits);
    recorder.fill(tile.photon_counts, 0, tile.photon_counts.bytes());
    recorder.fill(tile.sums, 0, tile.sums.bytes());
    counters_.read(recorder);
  });
  tile.max_pixel_hits = counters_[PPM_COUNTER_MAX_PIXEL_HITS];
}

void EyePass::tighten(HitTile& tile) {
  const std::uint64_t room = tile.statistics.bytes() / 16;
  if (EyeRoom::tightened(room, tile.hits) == room) return;
  const auto copy_of = [&](gpu::Buffer& loose) {
    gpu::Buffer tight(device_, loose.name(), tile.hits * 16ull, gpu::Usage::storage_and_texels);
    device_.run([&](gpu::Recorder& recorder) { recorder.copy(loose, tight, tile.hits * 16ull); });
    loose = std::move(tight);
  };
  for (std::size_t i = 0; i < (kernels_.layers ? 5 : 4); ++i) copy_of(tile.planes[i]);
  copy_of(tile.statistics);
}

}  // namespace ppm::render
