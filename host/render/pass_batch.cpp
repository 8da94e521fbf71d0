#include "pass_batch.hpp"

#include <algorithm>

#include "ppm_shaders.hpp"
#include "shared/random.h"

namespace ppm::render {

PassBatch::PassBatch(gpu::Device& device, PhotonTracer& tracer, PhotonGrid& grid,
                     Estimator& estimator)
    : device_(device),
      tracer_(tracer),
      grid_(grid),
      estimator_(estimator),
      check_(device, shaders::batch_check) {
  tracer.bind_photons(photons_);
  tracer.batch().bind(photons_);
  tracer.batch().bind(check_table_);
  estimator.bind_counters(check_table_);
}

std::uint32_t PassBatch::fitting(std::uint64_t most, std::uint64_t paths, float cell) const {
  // A fifth more photons than usual still fit.
  const std::uint64_t photons = tracer_.expected_photons(paths) * 6 / 5 + 1;
  const std::uint64_t fit = std::min<std::uint64_t>(
      {most, PPM_BATCH_LIMIT, tracer_.path_capacity() / std::max<std::uint64_t>(paths, 1),
       tracer_.photon_share(1) / photons, grid_.most_passes(cell, photons)});
  return static_cast<std::uint32_t>(std::max<std::uint64_t>(fit, 1));
}

PassBatch::Result PassBatch::make(std::span<const HitTile> tiles, const Request& request,
                                  const std::function<bool()>& interrupted) {
  if (interrupted()) return {.end = End::interrupted};
  bool recorded = true;
  const auto record_rest = [&](gpu::Recorder& recorder) {
    record_sort(recorder, request);
    recorded = record_passes(recorder, tiles, request, interrupted);
  };
  device_.run([&](gpu::Recorder& recorder) {
    tracer_.record(recorder,
                   {PPM_STREAM_PHOTON, request.first_pass, request.passes, 0, request.paths});
    record_rest(recorder);
  });
  // Paths that outlive the usual rounds are followed to their ends, and then comes the rest.
  const bool more = tracer_.has_more();
  switch (tracer_.finish(interrupted)) {
    case PhotonTracer::Result::overflow:
      return {.end = End::photons_overflow};
    case PhotonTracer::Result::interrupted:
      return {.end = End::interrupted};
    case PhotonTracer::Result::done:
      break;
  }
  if (more) device_.run(record_rest);

  const shared::BatchWords& words = *tracer_.batch();
  Result result;
  result.passes = words.completed;
  result.clamped = words.clamped;
  result.overflow = words.overflow;
  for (std::uint32_t pass = 0; pass < result.passes; ++pass)
    result.photons_stored += words.sortable[pass];
  if (result.passes < request.passes) {
    result.end = recorded ? End::long_searches : End::interrupted;
    estimator_.clear_sums(tiles);
    estimator_.measure_radii(tiles);
  }
  return result;
}

void PassBatch::record_sort(gpu::Recorder& recorder, const Request& request) {
  record_check(recorder, request, PPM_CHECK_TRACED, 0);
  grid_.record(recorder, photons_,
               {tracer_.batch(), request.passes, tracer_.photon_share(request.passes),
                tracer_.expected_photons(request.paths)},
               request.cell);
}

// False when interrupted: what is recorded until then has its passes complete, but for the last.
bool PassBatch::record_passes(gpu::Recorder& recorder, std::span<const HitTile> tiles,
                              const Request& request, const std::function<bool()>& interrupted) {
  estimator_.clear_counters(recorder);
  bool stopped = false;
  for (std::uint32_t pass = 0; pass < request.passes && !stopped; ++pass) {
    for (const HitTile& tile : tiles) {
      stopped = interrupted();
      if (stopped) break;
      estimator_.record_gather(recorder, tile, grid_, pass, tracer_.batch());
      const bool last = &tile == &tiles.back();
      record_check(recorder, request, last ? PPM_CHECK_ALL_SEARCHED : PPM_CHECK_TILE_SEARCHED,
                   pass);
    }
    if (stopped) break;
    estimator_.record_update(recorder, tiles, request.alpha, &tracer_.batch());
  }
  estimator_.read_histogram(recorder);
  tracer_.batch().read(recorder);
  return !stopped;
}

void PassBatch::record_check(gpu::Recorder& recorder, const Request& request, std::uint32_t step,
                             std::uint32_t pass) const {
  recorder.dispatch(check_, check_table_,
                    shared::BatchCheckPush{0, 0, step, pass, request.passes,
                                           tracer_.photon_share(request.passes), tracer_.rounds()},
                    1);
}

}  // namespace ppm::render
