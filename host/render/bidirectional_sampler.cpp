#include "bidirectional_sampler.hpp"

#include <algorithm>

#include "film.hpp"
#include "memory_plan.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"
#include "shared/layout.h"

namespace ppm::render {
namespace {

// Specialisation constants of the kernels.
constexpr std::uint32_t kWays = 0;
constexpr std::uint32_t kChains = 1;

// Paths of a tile, so that its vertices take some ten MB on CPUs.
constexpr std::uint64_t kMostPaths = 1u << 18;
// A closed room of albedo 0.7 has three vertices a sub-path and thirteen pairs a sample; what does
// not fit is traced again in smaller tiles.
constexpr std::uint64_t kVerticesAPath = 6;
constexpr std::uint64_t kPairsAPath = 24;
// Independent samples, before there are chains, are taken so many at a time at least.
constexpr std::uint64_t kLeastChainSamples = 4096;
// Passes of small pictures are made several at a time.
constexpr std::uint64_t kLeastSamples = 1u << 14;
// The longest path must fit.
constexpr std::uint64_t kLeastVertices = 1u << 14;
constexpr std::uint64_t kLeastPairs = 1u << 18;

// Where few paths are left, rounds of one segment would cost more to submit than to trace.
constexpr std::uint32_t kBouncesOfFew = 32;
constexpr std::uint64_t kFewPaths = 4096;

gpu::Kernel kernel(gpu::Device& device, const SceneTraits& traits, const gpu::Shader& any,
                   const gpu::Shader& plain, std::uint32_t ways, std::uint32_t chains) {
  return make_kernel(device, traits, any, plain, {{kWays, ways}, {kChains, chains > 0 ? 1 : 0}});
}

}  // namespace

SamplerCapacities sampler_capacities(const Settings& settings, std::uint64_t storage_bytes,
                                     std::uint32_t chains) {
  const std::uint64_t samples =
      chains > 0 ? std::max<std::uint64_t>(chains, kLeastChainSamples)
                 : std::max(std::uint64_t{settings.width} * settings.height, kLeastSamples);
  const std::uint64_t fitting = storage_bytes / (kVerticesAPath * sizeof(shared::PathVertex));
  const std::uint64_t paths =
      std::min({samples, fitting, kMostPaths, std::max<std::uint64_t>(settings.tile_hits, 1)});
  return {static_cast<std::uint32_t>(paths),
          static_cast<std::uint32_t>(std::max(kVerticesAPath * paths, kLeastVertices)),
          static_cast<std::uint32_t>(std::max(kPairsAPath * paths, kLeastPairs))};
}

std::uint64_t SamplerCapacities::bytes(bool splats) const {
  return paths * (2 * sizeof(shared::SubPath) + 4) +
         vertices * (2 * sizeof(shared::PathVertex) + (splats ? sizeof(shared::LensSplat) : 0)) +
         pairs * 8ull;
}

std::vector<MemoryPart> bdpt_memory(const Settings& settings, const PassLimits& limits) {
  const SamplerCapacities sampler = sampler_capacities(settings, limits.storage_bytes, 0);
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  return {{"sub-paths", sampler.bytes(false), true, Phase::upload, Phase::render},
          film_memory(pixels, settings.keeps_film)};
}

BidirectionalSampler::BidirectionalSampler(gpu::Device& device, const gpu::BindingTable& scene,
                                           const SceneTraits& traits, const Settings& settings,
                                           std::uint32_t ways, std::uint32_t chains)
    : device_(device),
      ways_(ways),
      light_(kernel(device, traits, shaders::bdpt_light, shaders::bdpt_light_plain, ways, chains)),
      camera_(
          kernel(device, traits, shaders::bdpt_camera, shaders::bdpt_camera_plain, ways, chains)),
      lens_(kernel(device, traits, shaders::bdpt_lens, shaders::bdpt_lens_plain, ways, chains)),
      direct_(
          kernel(device, traits, shaders::bdpt_direct, shaders::bdpt_direct_plain, ways, chains)),
      connect_(
          kernel(device, traits, shaders::bdpt_connect, shaders::bdpt_connect_plain, ways, chains)),
      table_(scene),
      capacities_(sampler_capacities(settings, device.max_storage_bytes(), chains)),
      queue_{
          {device, "sub-paths A", capacities_.paths * sizeof(shared::SubPath), gpu::Usage::storage},
          {device, "sub-paths B", capacities_.paths * sizeof(shared::SubPath),
           gpu::Usage::storage}},
      light_vertices_(device, "light vertices", capacities_.vertices * sizeof(shared::PathVertex),
                      gpu::Usage::storage_and_texels),
      camera_vertices_(device, "camera vertices", capacities_.vertices * sizeof(shared::PathVertex),
                       gpu::Usage::storage_and_texels),
      light_heads_(device, "light paths", capacities_.paths * 4ull, gpu::Usage::storage),
      pairs_(device, "vertex pairs", capacities_.pairs * 8ull, gpu::Usage::storage),
      splats_(device, "lens splats",
              chains > 0 ? capacities_.vertices * sizeof(shared::LensSplat) : 16,
              gpu::Usage::storage_and_texels),
      unused_(device, "unused", 16, gpu::Usage::storage_and_texels),
      counters_(device) {
  table_.set(PPM_BIND_LIGHT_VERTICES, light_vertices_);
  table_.set(PPM_BIND_CAMERA_VERTICES, camera_vertices_);
  table_.set(PPM_BIND_LIGHT_HEADS, light_heads_);
  table_.set(PPM_BIND_VERTEX_PAIRS, pairs_);
  table_.set(PPM_BIND_LENS_SPLATS, splats_);
  for (const std::uint32_t binding : {PPM_BIND_CHAIN_WORDS, PPM_BIND_CHAIN_STARTS}) {
    if (chains == 0) table_.set(binding, unused_);
  }
  counters_.bind(table_);
  push_.vertex_capacity = capacities_.vertices;
  push_.path_capacity = capacities_.paths;
  push_.pair_capacity = capacities_.pairs;
  push_.filter_kind = static_cast<std::uint32_t>(settings.filter);
  push_.chains = chains;
  push_.light_paths = static_cast<float>(std::uint64_t{settings.width} * settings.height);
}

BidirectionalSampler::Result BidirectionalSampler::trace(const SampleRange& range,
                                                         const std::function<bool()>& interrupted) {
  push_.pass = range.pass;
  push_.first_path = range.first_path;
  push_.phase = range.phase;
  push_.passes = range.passes;
  device_.run([&](gpu::Recorder& recorder) {
    counters_.clear(recorder);
    recorder.fill(light_heads_, PPM_BDPT_NONE, range.paths * 4ull);
  });
  if ((ways_ & (PPM_BDPT_CONNECTIONS | PPM_BDPT_LENS)) != 0) {
    const Result result = trace_side(Side::light, range.paths, interrupted);
    if (result != Result::done) return result;
  }
  return trace_side(Side::camera, range.paths, interrupted);
}

BidirectionalSampler::Result BidirectionalSampler::trace_side(
    Side side, std::uint32_t paths, const std::function<bool()>& interrupted) {
  const gpu::Region region(device_, side == Side::light ? "light paths" : "camera paths");
  const gpu::Kernel& kernel = side == Side::light ? light_ : camera_;
  std::uint32_t alive = paths;
  for (std::uint32_t round = 0; alive > 0; ++round) {
    if (interrupted()) return Result::interrupted;
    push_.generate = round == 0 ? 1 : 0;
    push_.bounces = alive > kFewPaths ? 1 : kBouncesOfFew;
    table_.set(PPM_BIND_PATHS_IN, queue_[round % 2]);
    table_.set(PPM_BIND_PATHS_OUT, queue_[(round + 1) % 2]);
    device_.run([&](gpu::Recorder& recorder) {
      counters_.clear(recorder, PPM_COUNTER_PATHS_OUT);
      recorder.dispatch(kernel, table_, push_, alive);
      counters_.read(recorder);
    });
    if (overflowed()) return Result::overflow;
    alive = counters_[PPM_COUNTER_PATHS_OUT];
  }
  return Result::done;
}

void BidirectionalSampler::bind_splats(gpu::BindingTable& table) const {
  table.set(PPM_BIND_LENS_SPLATS, splats_);
  table.set(PPM_BIND_LIGHT_VERTICES, light_vertices_);
  table.set(PPM_BIND_LIGHT_HEADS, light_heads_);
  counters_.bind(table);
}

bool BidirectionalSampler::overflowed() const {
  return std::max(counters_[PPM_COUNTER_LIGHT_VERTICES], counters_[PPM_COUNTER_CAMERA_VERTICES]) >
             capacities_.vertices ||
         counters_[PPM_COUNTER_VERTEX_PAIRS] > capacities_.pairs;
}

void BidirectionalSampler::deposit() {
  const gpu::Region region(device_, "connections");
  device_.run([&](gpu::Recorder& recorder) {
    if ((ways_ & PPM_BDPT_LENS) != 0) {
      recorder.dispatch(lens_, table_, push_, counters_[PPM_COUNTER_LIGHT_VERTICES]);
    }
    recorder.dispatch(direct_, table_, push_, counters_[PPM_COUNTER_CAMERA_VERTICES]);
    recorder.dispatch(connect_, table_, push_, counters_[PPM_COUNTER_VERTEX_PAIRS]);
    counters_.read(recorder);
  });
}

}  // namespace ppm::render
