// The photon hash grid, rebuilt for every chunk of photons by a counting sort.
#pragma once

#include <span>
#include <utility>

#include "cell_table.hpp"
#include "device_batch.hpp"
#include "exclusive_scan.hpp"
#include "kernel.hpp"
#include "shared/layout.h"

namespace ppm::render {

class PhotonGrid {
 public:
  /// Over the box [bounds_min, bounds_max] (working frame) for up to `photon_capacity` photons.
  /// hashed_entries: size of the table where rows are hashed, a power of two; 0 suits the photons.
  /// table_room: entries of all passes' tables, if more than one pass needs.
  PhotonGrid(gpu::Device& device, glm::vec3 bounds_min, glm::vec3 bounds_max,
             std::uint64_t photon_capacity, std::uint32_t hashed_entries = 0,
             std::uint64_t table_room = 0);

  /// Sorts `photons` photons (bound in `photon_table`) into cells of about `cell` working units.
  /// The size of cells decides how fast searches are, never what they find.
  void build(gpu::Device& device, const gpu::BindingTable& photon_table, std::uint32_t photons,
             float cell);

  /// Exchanges the buffers of the sorted photons for others of as many bytes.
  void exchange_photons(gpu::Buffer& position, gpu::Buffer& flux) {
    std::swap(sorted_position_, position);
    std::swap(sorted_flux_, flux);
  }

  /// The photons of a batch: `passes` passes whose photons begin `share` apart, as many as
  /// `batch.sortable` says, some `expected` of each. `batch` is bound in `photon_table`.
  struct Photons {
    const DeviceBatch& batch;
    std::uint32_t passes, share;
    std::uint64_t expected;
  };
  /// Records the same for a batch. Each pass gets a table of its own.
  void record(gpu::Recorder& recorder, const gpu::BindingTable& photon_table,
              const Photons& photons, float cell);
  /// Passes whose tables are sure to fit in cells of about `cell` working units.
  std::uint32_t most_passes(float cell, std::uint64_t expected_photons) const;

  void bind(gpu::BindingTable& table) const;
  /// For searches among the photons of one pass of the batch that was sorted last.
  shared::GridConstants constants(std::uint32_t pass = 0) const;

 private:
  /// Of one pass.
  CellTable table(float cell, std::uint64_t photons) const;

  gpu::Device& device_;
  glm::vec3 bounds_min_, bounds_max_;
  std::uint32_t table_entries_;  ///< of a hashed table, a power of two
  std::uint64_t max_entries_;    ///< of all tables together
  gpu::Kernel count_, scatter_;
  ExclusiveScan scan_;
  gpu::Buffer cell_count_, cell_start_, sorted_position_, sorted_flux_;
  DeviceBatch single_;  ///< tells `build`'s kernels of its photons
  CellTable cells_{};   ///< of what was sorted last
};

/// Cell size with which searches in discs whose radii have this histogram (PPM_RADIUS_BINS bins)
/// cost least: small cells are many rows to large discs, large cells many photons to small ones. 0
/// when there are none. photons_a_disc: that such a disc holds.
float cell_from_radii(std::span<const std::uint32_t> histogram, double photons_a_disc = 20.0);

}  // namespace ppm::render
