#include "photon_tracer.hpp"

#include <algorithm>
#include <cmath>

#include "failure.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"
#include "shared/layout.h"
#include "shared/random.h"

namespace ppm::render {
namespace {

constexpr double kFirstPhotons = 4.0;  // a path, before anything is known

}  // namespace

PhotonTracer::PhotonTracer(gpu::Device& device, const gpu::BindingTable& scene,
                           const SceneTraits& traits, std::uint64_t photon_capacity,
                           std::uint64_t path_capacity)
    : device_(device),
      kernel_(make_kernel(device, traits, shaders::photon, shaders::photon_plain)),
      table_(scene),
      photon_capacity_(photon_capacity),
      path_capacity_(path_capacity),
      queue_{{device, "photon paths A", path_capacity * sizeof(shared::PhotonPath),
              gpu::Usage::storage},
             {device, "photon paths B", path_capacity * sizeof(shared::PhotonPath),
              gpu::Usage::storage}},
      position_(device, "photon positions", photon_capacity * 16, gpu::Usage::storage_and_texels),
      flux_(device, "photon fluxes", photon_capacity * 16, gpu::Usage::storage_and_texels),
      batch_(device),
      counters_(device),
      usual_photons_(kFirstPhotons) {
  bind_photons(table_);
  batch_.bind(table_);
  counters_.bind(table_);
}

void PhotonTracer::bind_photons(gpu::BindingTable& table) const {
  table.set(PPM_BIND_PHOTON_POSITION, position_);
  table.set(PPM_BIND_PHOTON_FLUX, flux_);
}

std::uint64_t PhotonTracer::expected_photons(std::uint64_t paths) const {
  return static_cast<std::uint64_t>(std::ceil(usual_photons_ * static_cast<double>(paths)));
}

bool PhotonTracer::overflowed() const {
  const auto first = std::begin(batch_->photons);
  return *std::max_element(first, first + range_.passes) > photon_share(range_.passes);
}

void PhotonTracer::record(gpu::Recorder& recorder, const PathRange& range) {
  PPM_ASSERT(range.passes >= 1 && range.passes <= PPM_BATCH_LIMIT &&
                 std::uint64_t{range.paths} * range.passes <= path_capacity_,
             std::to_string(range.passes) + " passes of " + std::to_string(range.paths) + " paths");
  range_ = range;
  rounds_.begin();
  batch_.begin(recorder, range.paths * range.passes);
  counters_.clear(recorder);
  record_rounds(recorder);
}

void PhotonTracer::record_rounds(gpu::Recorder& recorder) {
  const gpu::Region region(device_, "photons");
  shared::PhotonPush push{};
  push.pass = range_.first_pass;
  push.paths = range_.paths;
  push.passes = range_.passes;
  push.emit_first = range_.first_path;
  push.photon_share = photon_share(range_.passes);
  push.path_capacity = static_cast<std::uint32_t>(path_capacity_);
  push.stream = range_.stream;
  const std::uint32_t all = range_.paths * range_.passes;
  for (push.round = 0; push.round < rounds_.count(); ++push.round) {
    push.generate = rounds_.starts_paths(push.round) ? 1 : 0;
    table_.set(PPM_BIND_PATHS_IN, queue_[push.round % 2]);
    table_.set(PPM_BIND_PATHS_OUT, queue_[(push.round + 1) % 2]);
    recorder.dispatch(kernel_, table_, push,
                      batch_.alive(push.round, all, rounds_.expected(push.round, all)));
  }
  batch_.read(recorder);
  counters_.read(recorder);
}

PhotonTracer::Result PhotonTracer::finish(const std::function<bool()>& interrupted) {
  for (;;) {
    learn();
    if (overflowed()) return Result::overflow;
    if (!has_more()) return Result::done;
    if (interrupted()) return Result::interrupted;
    device_.run([&](gpu::Recorder& recorder) {
      batch_.begin_again(recorder, rounds_.count());
      rounds_.go_on();
      record_rounds(recorder);
    });
  }
}

// What the rounds that have run say about the next range's.
void PhotonTracer::learn() {
  rounds_.learn(batch_, range_.paths * range_.passes);
  if (!has_more()) usual_photons_ = batch_->photons[0] / std::max<double>(range_.paths, 1.0);
}

PhotonTracer::Result PhotonTracer::trace(std::uint32_t stream, std::uint32_t pass,
                                         std::uint32_t first_path, std::uint32_t paths,
                                         const std::function<bool()>& interrupted) {
  if (interrupted()) return Result::interrupted;
  device_.run([&](gpu::Recorder& recorder) {
    record(recorder, {stream, pass, 1, first_path, paths});
  });
  return finish(interrupted);
}

}  // namespace ppm::render
