// The photon map of classic photon mapping: all photons of a rendering, in grids.
//
// Where one buffer cannot hold them there are several grids. Photons are appended as they are
// traced and sorted when they are to be searched, through a spare pair of buffers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "integrator.hpp"
#include "pass_capacities.hpp"
#include "photon_grid.hpp"

namespace ppm::render {

/// How many photons are kept in how many grids.
struct PhotonMapShape {
  std::uint32_t grids;
  std::uint64_t grid_photons;  ///< of each, at most

  /// For all that are asked for. Settings::photon_capacity is what a grid holds at most.
  static PhotonMapShape of(const Settings& settings, const PassLimits& limits);
  std::uint64_t bytes() const;  ///< on the device, tables and spare buffers included
};

class PhotonMap {
 public:
  /// Over the box [bounds_min, bounds_max], working frame.
  PhotonMap(gpu::Device& device, glm::vec3 bounds_min, glm::vec3 bounds_max, PhotonMapShape shape);

  std::uint64_t photons() const { return photons_; }
  std::uint64_t capacity() const { return grids_.size() * grid_photons_; }

  /// Adds the first `count` photons that are bound in `table`; they must fit.
  void append(const gpu::BindingTable& table, std::uint64_t count);
  /// Forgets all but the first `photons`; of those sorted already none may be forgotten.
  void truncate(std::uint64_t photons);
  void clear() { photons_ = sorted_ = 0; }

  /// Sorts all into cells of about `cell` working units.
  void sort(float cell);
  /// Those that hold photons, as sorted last.
  std::span<const PhotonGrid> grids() const;

 private:
  std::uint64_t photons_in(std::size_t grid) const;

  gpu::Device& device_;
  std::uint64_t grid_photons_;
  std::vector<PhotonGrid> grids_;
  gpu::Buffer spare_position_, spare_flux_;
  std::uint64_t photons_ = 0, sorted_ = 0;
};

}  // namespace ppm::render
