#include "photon_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "failure.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"

namespace ppm::render {
namespace {

// What a search in a disc of that radius costs in cells of that size, in photons looked at. First
// discs hold about as many photons whatever their size, so that the square of cells around one that
// lies in a plane holds some of them for each of its areas; and a row of cells costs about as much
// as kRowCost photons, empty or not.
double search_cost(double radius, double cell, double photons_a_disc) {
  constexpr double kRowCost = 12.0, kPi = 3.14159265358979324;
  const double side = 2.0 + cell / radius;  // of the square, in radii
  const double rows = 2.0 * radius / cell + 1.5;
  return photons_a_disc / kPi * side * side + kRowCost * rows * rows;
}

}  // namespace

PhotonGrid::PhotonGrid(gpu::Device& device, glm::vec3 bounds_min, glm::vec3 bounds_max,
                       std::uint64_t photon_capacity, std::uint32_t hashed_entries,
                       std::uint64_t table_room)
    : device_(device),
      bounds_min_(bounds_min),
      bounds_max_(bounds_max),
      table_entries_(hashed_entries != 0 ? hashed_entries : hashed_entries_for(photon_capacity)),
      max_entries_(std::max(max_entries(hashed_entries_for(photon_capacity)), table_room)),
      count_(device, shaders::grid_count),
      scatter_(device, shaders::grid_scatter),
      scan_(device, max_entries_),
      cell_count_(device, "cell counts", max_entries_ * 4, gpu::Usage::storage),
      cell_start_(device, "cell starts", (max_entries_ + 1) * 4, gpu::Usage::storage_and_texels),
      sorted_position_(device, "sorted photon positions", photon_capacity * 16,
                       gpu::Usage::storage_and_texels),
      sorted_flux_(device, "sorted photon fluxes", photon_capacity * 16,
                   gpu::Usage::storage_and_texels),
      single_(device) {
  device.run([&](gpu::Recorder& recorder) { recorder.fill(cell_count_, 0, cell_count_.bytes()); });
}

CellTable PhotonGrid::table(float cell, std::uint64_t photons) const {
  return cell_table(bounds_min_, bounds_max_, cell,
                    std::min(table_entries_, hashed_entries_for(photons)));
}

std::uint32_t PhotonGrid::most_passes(float cell, std::uint64_t expected_photons) const {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(
      max_entries_ / table(cell, expected_photons).entries, PPM_BATCH_LIMIT));
}

shared::GridConstants PhotonGrid::constants(std::uint32_t pass) const {
  shared::GridConstants constants = cells_.constants;
  constants.table_first = pass * cells_.entries;
  return constants;
}

void PhotonGrid::build(gpu::Device& device, const gpu::BindingTable& photon_table,
                       std::uint32_t photons, float cell) {
  gpu::BindingTable table = photon_table;
  single_.bind(table);
  device.run([&](gpu::Recorder& recorder) {
    single_.set_sortable(recorder, photons);
    record(recorder, table, {single_, 1, photons, photons}, cell);
  });
}

void PhotonGrid::record(gpu::Recorder& recorder, const gpu::BindingTable& photon_table,
                        const Photons& photons, float cell) {
  const gpu::Region region(device_, "grid");
  cells_ = table(cell, photons.expected);
  PPM_ASSERT(std::uint64_t{cells_.entries} * photons.passes <= max_entries_,
             std::to_string(photons.passes) + " tables of " + std::to_string(cells_.entries));
  gpu::BindingTable table = photon_table;
  bind(table);
  table.set(PPM_BIND_CELL_COUNT, cell_count_);
  const shared::GridPush push{0, 0, cells_.constants, photons.share, cells_.entries};
  const gpu::DeviceCount count =
      photons.batch.sortable(photons.passes, photons.share, photons.expected);
  recorder.dispatch(count_, table, push, count);
  scan_.record(recorder, cell_count_, cell_start_, cells_.entries * photons.passes);
  recorder.dispatch(scatter_, table, push, count);
}

void PhotonGrid::bind(gpu::BindingTable& table) const {
  table.set(PPM_BIND_CELL_START, cell_start_);
  table.set(PPM_BIND_SORTED_POSITION, sorted_position_);
  table.set(PPM_BIND_SORTED_FLUX, sorted_flux_);
}

float cell_from_radii(std::span<const std::uint32_t> histogram, double photons_a_disc) {
  // Bin b spans R^2 from 2^(b/2 - 64) on; all of it counts as its geometric mean.
  const auto radius = [](std::size_t bin) {
    return std::exp2(0.25 * (static_cast<double>(bin) + 0.5) - 32.0);
  };
  // Larger cells than nine in ten discs' radii would pay for the tenth's rows alone.
  const std::uint64_t all = std::accumulate(histogram.begin(), histogram.end(), std::uint64_t{0});
  std::uint64_t smaller = 0;
  double least = std::numeric_limits<double>::infinity();
  double best = 0.0;
  for (std::size_t candidate = 0; candidate < histogram.size() && 10 * smaller < 9 * all;
       ++candidate) {
    smaller += histogram[candidate];
    const double cell = radius(candidate);
    double cost = 0.0;
    for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
      if (histogram[bin] > 0)
        cost += histogram[bin] * search_cost(radius(bin), cell, photons_a_disc);
    }
    if (cost > 0.0 && cost < least) {
      least = cost;
      best = cell;
    }
  }
  return static_cast<float>(best);
}

}  // namespace ppm::render
