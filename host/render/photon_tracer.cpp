#include "photon_tracer.hpp"

#include "ppm_shaders.hpp"
#include "region.hpp"
#include "shared/layout.h"
#include "shared/random.h"

namespace ppm::render {
namespace {

// Bounces that one dispatch follows a path. Few, while many paths are alive and lanes would idle
// beside longer ones; many at the end, when rounds of few paths would cost more to submit than to
// trace.
constexpr std::uint32_t kBouncesOfMany = 2;
constexpr std::uint32_t kBouncesOfFew = 4;
constexpr std::uint32_t kFewPaths = 4096;

}  // namespace

PhotonTracer::PhotonTracer(gpu::Device& device, const gpu::BindingTable& scene,
                           std::uint64_t photon_capacity, std::uint64_t path_capacity)
    : device_(device),
      kernel_(device, shaders::photon),
      table_(scene),
      photon_capacity_(photon_capacity),
      path_capacity_(path_capacity),
      queue_{{device, "photon paths A", path_capacity * sizeof(shared::PhotonPath),
              gpu::Usage::storage},
             {device, "photon paths B", path_capacity * sizeof(shared::PhotonPath),
              gpu::Usage::storage}},
      position_(device, "photon positions", photon_capacity * 16, gpu::Usage::storage_and_texels),
      flux_(device, "photon fluxes", photon_capacity * 16, gpu::Usage::storage_and_texels),
      counters_(device) {
  bind_photons(table_);
  counters_.bind(table_);
}

void PhotonTracer::bind_photons(gpu::BindingTable& table) const {
  table.set(PPM_BIND_PHOTON_POSITION, position_);
  table.set(PPM_BIND_PHOTON_FLUX, flux_);
}

PhotonTracer::Result PhotonTracer::trace(std::uint32_t stream, std::uint32_t pass,
                                         std::uint32_t first_path, std::uint32_t paths,
                                         const std::function<bool()>& interrupted) {
  const gpu::Region region(device_, "photons");
  shared::PhotonPush push{};
  push.pass = pass;
  push.emit_first = first_path;
  push.photon_capacity = static_cast<std::uint32_t>(photon_capacity_);
  push.path_capacity = static_cast<std::uint32_t>(path_capacity_);
  push.stream = stream;
  std::uint32_t alive = paths;
  for (std::uint32_t round = 0; alive > 0; ++round) {
    if (interrupted()) return Result::interrupted;
    push.generate = round == 0 ? 1 : 0;
    push.bounces = alive > kFewPaths ? kBouncesOfMany : kBouncesOfFew;
    table_.set(PPM_BIND_PATHS_IN, queue_[round % 2]);
    table_.set(PPM_BIND_PATHS_OUT, queue_[(round + 1) % 2]);
    device_.run([&](gpu::Recorder& recorder) {
      if (round == 0) {
        counters_.clear(recorder);
      } else {
        counters_.clear(recorder, PPM_COUNTER_PATHS_OUT);
      }
      recorder.dispatch(kernel_, table_, push, alive);
      counters_.read(recorder);
    });
    if (counters_[PPM_COUNTER_PHOTONS] > photon_capacity_) return Result::overflow;
    alive = counters_[PPM_COUNTER_PATHS_OUT];
  }
  photon_count_ = counters_[PPM_COUNTER_PHOTONS];
  return Result::done;
}

}  // namespace ppm::render
