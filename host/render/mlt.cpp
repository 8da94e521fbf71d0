#include "mlt.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "eye_pass.hpp"
#include "failure.hpp"
#include "memory_plan.hpp"
#include "portions.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"
#include "shared/markov_chain.h"
#include "stopwatch.hpp"
#include "surface_layers.hpp"

namespace ppm::render {
namespace {

// Independent samples for each chain: they tell the mean luminance and where the chains start.
constexpr std::uint32_t kBootstrapAChain = 32;
constexpr std::uint32_t kLeastBootstrap = 8192;
// Of a device's paths at a time: what keeps it busy without many chains that are short.
constexpr std::uint64_t kPathsAChain = 64;
constexpr std::uint64_t kPixelsAChain = 16;
constexpr std::uint64_t kLeastChains = 64;
// Room for the splats of the chains' states, times what a step's proposals have.
constexpr std::uint32_t kSpareSplats = 2;

std::uint32_t chains_for(const gpu::DeviceProfile& profile, const Settings& settings) {
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  const std::uint64_t wanted =
      settings.mlt_chains > 0
          ? settings.mlt_chains
          : std::max(std::min(profile.paths / kPathsAChain, pixels / kPixelsAChain), kLeastChains);
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wanted, 1, pixels));
}

shared::SceneConstants of_chains(shared::SceneConstants scene, std::uint32_t chains) {
  scene.width = chains;
  scene.height = 1;
  return scene;
}

std::uint32_t bootstrap_for(std::uint32_t chains) {
  return std::max(kBootstrapAChain * chains, kLeastBootstrap);
}

std::uint64_t splat_capacity(std::uint64_t vertices) {
  return kSpareSplats * vertices;
}

}  // namespace

std::vector<MemoryPart> mlt_memory(const Settings& settings, const PassLimits& limits) {
  const std::uint32_t chains = chains_for(limits.profile, settings);
  const SamplerCapacities sampler = sampler_capacities(settings, limits.storage_bytes, chains);
  const std::uint64_t words = std::uint64_t{chains} * PPM_CHAIN_BLOCKS * 16;
  const std::uint64_t states = chains * sizeof(shared::Chain) +
                               2 * splat_capacity(sampler.vertices) * sizeof(shared::LensSplat) +
                               bootstrap_for(chains) * 4;
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  return {
      {"sub-paths", sampler.bytes(true), true, Phase::upload, Phase::render},
      {"chains", words + states + Film::bytes(sampler.paths), true, Phase::upload, Phase::render},
      {"chains as a pass begins", settings.keeps_film ? words + states : 0, false, Phase::render,
       Phase::render},
      film_memory(pixels, settings.keeps_film)};
}

Portions mlt_portions(const Settings& settings, const PassLimits& limits) {
  const std::uint32_t chains = chains_for(limits.profile, settings);
  // Chains are stepped together.
  return {sampler_capacities(settings, limits.storage_bytes, chains).paths,
          settings.photon_capacity, std::max<std::uint64_t>(kFewestTileHits, chains)};
}

MltIntegrator::MltIntegrator(const Settings& settings, const scene::Scene& scene,
                             gpu::Device& device, Log&, unsigned threads)
    : settings_(settings),
      scene_(scene),
      device_(device),
      buffers_(scene, settings, device, threads),
      traits_(buffers_.traits_of(scene)),
      chains_(chains_for(device.profile(), settings)),
      bootstrap_(bootstrap_for(chains_)),
      film_(device, buffers_.constants(), settings.keeps_film),
      proposals_(
          device,
          of_chains(buffers_.constants(),
                    sampler_capacities(settings, device.max_storage_bytes(), chains_).paths)),
      words_(device, "chain words", std::uint64_t{chains_} * PPM_CHAIN_BLOCKS * 16,
             gpu::Usage::storage_and_texels),
      starts_(device, "chain starts", chains_ * 4ull, gpu::Usage::texels),
      luminances_(device, "luminances", bootstrap_ * 4ull, gpu::Usage::storage),
      states_(device, "chains", chains_ * sizeof(shared::Chain), gpu::Usage::storage),
      sampling_([&] {
        gpu::BindingTable table;
        buffers_.bind(table);
        proposals_.bind(table);
        table.set(PPM_BIND_CHAIN_WORDS, words_);
        table.set(PPM_BIND_CHAIN_STARTS, starts_);
        return table;
      }()),
      sampler_(device, sampling_, traits_, settings, settings.bdpt_strategies, chains_),
      step_(device, shaders::mlt_step),
      splat_count_(device, "splat count", 4, gpu::Usage::storage),
      splat_capacity_(static_cast<std::uint32_t>(splat_capacity(sampler_.vertex_capacity()))),
      tile_paths_(sampler_.path_capacity()) {
  for (gpu::Buffer& pool : splats_) {
    pool = gpu::Buffer(device, "splats of chains", splat_capacity_ * sizeof(shared::LensSplat),
                       gpu::Usage::storage_and_texels);
  }
  deciding_ = sampling_;
  film_.bind(deciding_);
  proposals_.bind_sums(deciding_, PPM_BIND_CHAIN_RED);
  sampler_.bind_splats(deciding_);
  deciding_.set(PPM_BIND_CHAINS, states_);
  deciding_.set(PPM_BIND_LUMINANCES, luminances_);
  deciding_.set(PPM_BIND_SPLAT_COUNT, splat_count_);
  statistics_.seconds["bvh"] = buffers_.bvh_seconds();
  statistics_.seconds["upload"] = buffers_.upload_seconds();
  statistics_.triangles = scene.triangles.size();
  statistics_.lights = buffers_.light_count();
}

bool MltIntegrator::run(std::uint32_t step, std::uint32_t phase, std::uint32_t paths,
                        const std::function<bool()>& interrupted) {
  deciding_.set(PPM_BIND_SPLATS_IN, splats_[pool_]);
  deciding_.set(PPM_BIND_SPLATS_OUT, splats_[1 - pool_]);
  device_.run([&](gpu::Recorder& recorder) { recorder.fill(splat_count_, 0, 4); });
  std::uint32_t splats = 0;
  for (std::uint32_t first = 0; first < paths;) {
    const std::uint32_t count = std::min(tile_paths_, paths - first);
    const auto result = sampler_.trace({step, first, count, phase}, interrupted);
    if (result == BidirectionalSampler::Result::interrupted) return false;
    if (result == BidirectionalSampler::Result::overflow) {
      if (count == 1) {
        throw Failure("", "--max-depth", "the sub-paths of one sample do not fit", "limit it");
      }
      tile_paths_ = (count + 1) / 2;
      continue;
    }
    sampler_.deposit();
    shared::ChainPush push{};
    push.pass = step;
    push.first_path = first;
    push.phase = phase;
    push.chains = chains_;
    push.splat_capacity = splat_capacity_;
    push.normalisation = static_cast<float>(normalisation_);
    device_.run([&](gpu::Recorder& recorder) {
      recorder.dispatch(step_, deciding_, push, count);
      sampler_.read_counters(recorder);
      recorder.read(splat_count_, &splats, 4);
    });
    const Counters& counters = sampler_.counters();
    statistics_.eye_rays += counters[PPM_COUNTER_EYE_RAYS];
    statistics_.photon_rays += counters[PPM_COUNTER_PHOTON_RAYS];
    statistics_.paths_cut += counters[PPM_COUNTER_PATHS_CUT];
    statistics_.rejected["non_finite"] += counters[PPM_COUNTER_NON_FINITE];
    statistics_.rejected["clamped"] += counters[PPM_COUNTER_CLAMPED];
    statistics_.rejected["overflow"] += counters[PPM_COUNTER_OVERFLOW];
    first += count;
  }
  if (splats > splat_capacity_) {
    throw Failure("", "--integrator mlt", "the splats of the chains' states do not fit",
                  "limit --max-depth");
  }
  pool_ = 1 - pool_;
  return true;
}

bool MltIntegrator::prepare(const std::function<bool()>& interrupted) {
  const Stopwatch stopwatch(statistics_.seconds["bootstrap"]);
  const gpu::Region region(device_, "bootstrap");
  return choose_starts(interrupted);
}

void MltIntegrator::look_from(const scene::Camera& camera) {
  settings_.camera = camera;
  buffers_.look_from(settings_, traits_, device_);
  film_.clear();
  proposals_.clear();
  pool_ = 0;
  steps_ = 0;
  bootstrap_sum_ = normalisation_ = 0.0;
  statistics_ = statistics_.of_scene();
}

bool MltIntegrator::choose_starts(const std::function<bool()>& interrupted) {
  if (!run(0, PPM_CHAINS_SAMPLE, bootstrap_, interrupted)) return false;
  const auto luminances = luminances_.download<float>(bootstrap_);
  bootstrap_sum_ = 0.0;
  for (const float luminance : luminances) bootstrap_sum_ += luminance;
  normalisation_ = bootstrap_sum_ / bootstrap_;
  if (!(normalisation_ > 0.0)) return true;  // no light was found: the picture stays black
  // In proportion to luminance, at even distances of its running sum.
  const shared::RandomStream stream{settings_.seed, PPM_STREAM_CHAIN, PPM_CHAINS_BOOTSTRAP, 0};
  const double shift = static_cast<double>(shared::random_units(stream, 0).x);
  std::vector<std::uint32_t> starts;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < bootstrap_; ++i) {
    sum += luminances[i];
    while (starts.size() < chains_ &&
           (static_cast<double>(starts.size()) + shift) * bootstrap_sum_ < sum * chains_) {
      starts.push_back(i);
    }
  }
  while (starts.size() < chains_) starts.push_back(starts.back());  // by rounding
  starts_.upload(std::span<const std::uint32_t>(starts));
  return run(0, PPM_CHAINS_START, chains_, interrupted);
}

void MltIntegrator::refine_normalisation() {
  double sum = bootstrap_sum_, count = bootstrap_;
  for (const auto& chain : states_.download<shared::Chain>(chains_)) {
    sum += static_cast<double>(chain.large_sum);
    count += chain.large_steps;
  }
  normalisation_ = sum / count;
}

bool MltIntegrator::advance(const std::function<bool()>& interrupted) {
  const double start = clock_seconds();
  const std::uint64_t pixels = std::uint64_t{settings_.width} * settings_.height;
  const std::uint64_t steps = (statistics_.passes + 1) * pixels / chains_;
  if (normalisation_ > 0.0) {
    if (interrupted()) return false;
    refine_normalisation();
    std::optional<Snapshot> before;
    if (film_.keep()) before = snapshot();
    const auto stop = [&] { return before && interrupted(); };
    for (; steps_ < steps; ++steps_) {
      if (run(static_cast<std::uint32_t>(steps_), PPM_CHAINS_MUTATE, chains_, stop)) continue;
      go_back(*before);
      return false;
    }
  }
  ++statistics_.passes;
  statistics_.mutations = statistics_.passes;
  statistics_.pass_seconds.push_back(clock_seconds() - start);
  return true;
}

MltIntegrator::Snapshot MltIntegrator::snapshot() const {
  const auto words = [](const gpu::Buffer& buffer) {
    return buffer.download<std::uint32_t>(buffer.bytes() / 4);
  };
  return {words(words_), words(states_), words(splats_[pool_]), steps_, pool_, statistics_};
}

void MltIntegrator::go_back(const Snapshot& snapshot) {
  film_.revert();
  words_.upload(std::span(snapshot.words));
  states_.upload(std::span(snapshot.chains));
  pool_ = snapshot.pool;
  splats_[pool_].upload(std::span(snapshot.splats));
  proposals_.clear();
  steps_ = snapshot.steps;
  statistics_ = snapshot.statistics;
}

Picture MltIntegrator::resolve() {
  const Stopwatch stopwatch(statistics_.seconds["resolve"]);
  const double pixels = static_cast<double>(settings_.width) * settings_.height;
  const double mutations = static_cast<double>(steps_) * chains_;
  return film_.resolve(steps_ > 0 ? mutations / pixels : 1.0);
}

std::vector<image::Layer> MltIntegrator::layers(std::span<const LayerKind> kinds) {
  return surface_layers(device_, buffers_.table(), traits_, settings_, scene_.frame, kinds);
}

const Statistics& MltIntegrator::statistics() {
  for (const auto& [kernel, time] : device_.times()) {
    statistics_.kernel_seconds[kernel] = time.seconds;
  }
  return statistics_;
}

}  // namespace ppm::render
