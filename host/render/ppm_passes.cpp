// Photon passes: in batches, or under the host's eyes where something does not fit.
#include <algorithm>

#include "ppm.hpp"
#include "shared/random.h"
#include "stopwatch.hpp"

namespace ppm::render {

std::optional<std::uint32_t> PpmIntegrator::for_each_chunk(std::uint32_t stream, std::uint32_t pass,
                                                           float cell,
                                                           const std::function<bool()>& interrupted,
                                                           const std::function<bool()>& use) {
  const auto sort_and_use = [&] {
    grid_.build(device_, photons_, tracer_.photon_count(), cell);
    return use();
  };
  return chunks_.trace(stream, pass, 0, static_cast<std::uint32_t>(settings_.photons_per_pass),
                       interrupted, sort_and_use);
}

bool PpmIntegrator::advance(const std::function<bool()>& interrupted) {
  return advance_up_to(1, interrupted) == 1;
}

std::uint64_t PpmIntegrator::advance_up_to(std::uint64_t passes,
                                           const std::function<bool()>& interrupted) {
  const double start = clock_seconds();
  const auto regions_before = device_.region_times();
  const float cell = estimator_.cell_size();
  std::uint32_t made = 0;
  if (buffers_.light_count() == 0 || cell <= 0.0f) {
    made = 1;  // no photons, or nobody to see them
  } else {
    const std::optional<std::uint32_t> done = advance_lit(passes, cell, interrupted);
    if (!done) return 0;
    made = *done;
  }
  const auto add_seconds = [&](const char* part, const char* region) {
    const auto now = device_.region_times().find(region);
    const auto before = regions_before.find(region);
    statistics_.seconds[part] += (now == device_.region_times().end() ? 0.0 : now->second.seconds) -
                                 (before == regions_before.end() ? 0.0 : before->second.seconds);
  };
  for (const char* region : {"photons", "grid", "update"}) add_seconds(region, region);
  add_seconds("update", "gather");
  record_passes(made, clock_seconds() - start);
  return made;
}

std::optional<std::uint32_t> PpmIntegrator::advance_lit(std::uint64_t passes, float cell,
                                                        const std::function<bool()>& interrupted) {
  if (tiles_.are_traced_anew()) {
    if (!advance_tile_by_tile(cell, interrupted)) return std::nullopt;
    return 1;
  }
  while (const std::uint32_t size = batch_size(passes, cell)) {
    const std::optional<std::uint32_t> made = advance_batch(size, cell, interrupted);
    if (!made || *made > 0) return made;
  }
  if (!advance_in_steps(cell, interrupted)) return std::nullopt;
  return 1;
}

std::uint32_t PpmIntegrator::batch_size(std::uint64_t passes, float cell) const {
  if (in_steps_ || !estimator_.searches_fit_batch()) return 0;
  if (chunks_.paths() < settings_.photons_per_pass) return 0;
  return batch_.fitting(std::min<std::uint64_t>(passes, batch_limit_), settings_.photons_per_pass,
                        cell);
}

std::optional<std::uint32_t> PpmIntegrator::advance_batch(
    std::uint32_t passes, float cell, const std::function<bool()>& interrupted) {
  const PassBatch::Result result =
      batch_.make(tiles_.all(),
                  {static_cast<std::uint32_t>(statistics_.passes), passes,
                   static_cast<std::uint32_t>(settings_.photons_per_pass),
                   static_cast<float>(settings_.alpha), cell},
                  interrupted);
  if (result.end == PassBatch::End::long_searches) in_steps_ = true;
  if (result.end == PassBatch::End::photons_overflow) {
    if (passes > 1) {
      batch_limit_ = (passes + 1) / 2;
    } else {
      chunks_.halve();
    }
  }
  if (result.passes == 0) {
    return result.end == PassBatch::End::interrupted ? std::nullopt : std::optional(0u);
  }
  Tally tally;
  tally.photons_stored = result.photons_stored;
  tally.overflow = result.overflow;
  tally.clamped = result.clamped;
  tally.add(tracer_.counters());
  tally.add_to(statistics_);
  return result.passes;
}

bool PpmIntegrator::advance_in_steps(float cell, const std::function<bool()>& interrupted) {
  Tally tally;
  const auto gather = [&] {
    for (const HitTile& tile : tiles_.all()) {
      if (interrupted()) return false;
      const Estimator::Rejected rejected = estimator_.gather(tile, grid_);
      tally.overflow += rejected.overflow;
      tally.clamped += rejected.clamped;
    }
    tally.photons_stored += tracer_.photon_count();
    tally.add(tracer_.counters());
    return true;
  };
  const auto pass = static_cast<std::uint32_t>(statistics_.passes);
  if (!for_each_chunk(PPM_STREAM_PHOTON, pass, cell, interrupted, gather)) {
    estimator_.clear_sums(tiles_.all());
    return false;
  }
  estimator_.update(tiles_.all(), static_cast<float>(settings_.alpha));
  tally.add_to(statistics_);
  in_steps_ = false;
  return true;
}

bool PpmIntegrator::advance_tile_by_tile(float cell, const std::function<bool()>& interrupted) {
  const auto pass = static_cast<std::uint32_t>(statistics_.passes);
  Tally tally;
  bool first = true, whole = false;  // this tile; all photons are in the grid
  const auto stop = [&] { return first && interrupted(); };
  estimator_.clear_radii();
  const auto advance = [&](HitTile& tile) {
    estimator_.order_searches(tile, cell);
    Estimator::Rejected rejected;
    Tally photons;
    const auto gather = [&] {
      rejected += estimator_.gather(tile, grid_);
      photons.photons_stored += tracer_.photon_count();
      photons.add(tracer_.counters());
      return true;
    };
    if (whole) {
      gather();
    } else {
      const auto chunks = for_each_chunk(PPM_STREAM_PHOTON, pass, cell, stop, gather);
      if (!chunks) return false;
      whole = *chunks == 1;
    }
    estimator_.update_and_add_radii(tile, static_cast<float>(settings_.alpha));
    tally.overflow += rejected.overflow;
    tally.clamped += rejected.clamped;
    if (first) tally += photons;  // every tile sees the same
    first = false;
    return true;
  };
  if (!tiles_.for_each(stop, HitTiles::Keep::yes, advance)) {
    measure_kept_radii();
    return false;
  }
  tally.add_to(statistics_);
  return true;
}

void PpmIntegrator::record_passes(std::uint32_t passes, double seconds) {
  statistics_.passes += passes;
  statistics_.photons_emitted += passes * settings_.photons_per_pass;
  statistics_.pass_seconds.insert(statistics_.pass_seconds.end(), passes, seconds / passes);
}

}  // namespace ppm::render
