#include "photon_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "failure.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"
#include "shared/grid.h"

namespace ppm::render {
namespace {

// Cells along one axis at most: a hashed table is that much longer than its power of two.
constexpr std::uint32_t kMaxAxis = 65536;
// A dense table may have this many entries: scanning a million costs some 10 ms on lavapipe.
constexpr std::uint64_t kDenseEntries = 1u << 20;

std::uint32_t suitable_entries(std::uint64_t photons) {
  return static_cast<std::uint32_t>(
      std::bit_ceil(std::clamp<std::uint64_t>(2 * photons, 1u << 16, 1u << 22)));
}

// One table of any kind for all photons, and as much more as the device has room for.
std::uint64_t max_entries(const gpu::Device& device, std::uint64_t photons) {
  return std::max<std::uint64_t>(
      {kDenseEntries, suitable_entries(photons) + kMaxAxis, device.profile().grid_entries});
}

}  // namespace

PhotonGrid::PhotonGrid(gpu::Device& device, glm::vec3 bounds_min, glm::vec3 bounds_max,
                       std::uint64_t photon_capacity, std::uint32_t hashed_entries)
    : device_(device),
      bounds_min_(bounds_min),
      bounds_max_(bounds_max),
      table_entries_(hashed_entries != 0 ? hashed_entries : suitable_entries(photon_capacity)),
      max_entries_(max_entries(device, photon_capacity)),
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

PhotonGrid::Shape PhotonGrid::shape(float cell, std::uint64_t photons) const {
  const glm::vec3 extent = bounds_max_ - bounds_min_;
  const float largest = std::max({extent.x, extent.y, extent.z});
  cell = std::clamp(cell, largest / static_cast<float>(kMaxAxis - 1), std::max(largest, 1e-30f));
  const auto cells = [&](float length) {
    return static_cast<std::uint32_t>(
        std::clamp(std::floor(length / cell) + 1.0f, 1.0f, static_cast<float>(kMaxAxis)));
  };
  Shape shape{};
  shape.constants.origin = bounds_min_;
  shape.constants.inverse_cell = 1.0f / cell;
  const glm::uvec3 size = {cells(extent.x), cells(extent.y), cells(extent.z)};
  shape.constants.size = size;
  const std::uint64_t dense = std::uint64_t{size.x} * size.y * size.z;
  if (dense <= kDenseEntries) {
    shape.constants.table_mask = PPM_GRID_DENSE;
    shape.entries = static_cast<std::uint32_t>(dense);
  } else {
    const std::uint32_t hashed = std::min(table_entries_, suitable_entries(photons));
    shape.constants.table_mask = hashed - 1;
    shape.entries = hashed + size.x;
  }
  return shape;
}

std::uint32_t PhotonGrid::most_passes(float cell, std::uint64_t expected_photons) const {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(
      max_entries_ / shape(cell, expected_photons).entries, PPM_BATCH_LIMIT));
}

shared::GridConstants PhotonGrid::constants(std::uint32_t pass) const {
  shared::GridConstants constants = shape_.constants;
  constants.table_first = pass * shape_.entries;
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
  shape_ = shape(cell, photons.expected);
  PPM_ASSERT(std::uint64_t{shape_.entries} * photons.passes <= max_entries_,
             std::to_string(photons.passes) + " tables of " + std::to_string(shape_.entries));
  gpu::BindingTable table = photon_table;
  bind(table);
  table.set(PPM_BIND_CELL_COUNT, cell_count_);
  const shared::GridPush push{0, 0, shape_.constants, photons.share, shape_.entries};
  const gpu::DeviceCount count =
      photons.batch.sortable(photons.passes, photons.share, photons.expected);
  recorder.dispatch(count_, table, push, count);
  scan_.record(recorder, cell_count_, cell_start_, shape_.entries * photons.passes);
  recorder.dispatch(scatter_, table, push, count);
}

void PhotonGrid::bind(gpu::BindingTable& table) const {
  table.set(PPM_BIND_CELL_START, cell_start_);
  table.set(PPM_BIND_SORTED_POSITION, sorted_position_);
  table.set(PPM_BIND_SORTED_FLUX, sorted_flux_);
}

float cell_from_radii(std::span<const std::uint32_t> histogram) {
  std::uint64_t total = 0;
  for (const std::uint32_t count : histogram) total += count;
  if (total == 0) return 0.0f;
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
    below += histogram[bin];
    // Bin b spans R^2 from 2^(b/2 - 64) on; its radius is taken at the upper end.
    if (10 * below >= 9 * total) return std::exp2(0.25f * static_cast<float>(bin + 1) - 32.0f);
  }
  return 0.0f;
}

}  // namespace ppm::render
