// The distance of each hit point's n-th nearest photon, exactly (shaders/shared/nearest.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "counters.hpp"
#include "hit_tile.hpp"
#include "photon_grid.hpp"
#include "scene_traits.hpp"

namespace ppm::render {

class NearestPhotons {
 public:
  /// For tiles of up to `tile_hits` hit points.
  NearestPhotons(gpu::Device& device, const SceneTraits& traits, std::uint64_t tile_hits);

  /// Bytes on the device for each hit point of a tile.
  static constexpr std::uint64_t kHitBytes =
      sizeof(shared::NearestSearch) + 2 * sizeof(std::uint32_t) + 2 * sizeof(shared::GatherCursor);

  struct Request {
    std::uint32_t wanted = 1;     ///< n, at least 1
    std::uint32_t max_depth = 0;  ///< as in Settings
    float largest_radius = 1.0f;  ///< working units; whoever has fewer photons within takes it
    /// R^2 is likely to lie within a factor of `spread` around this; not positive: around -guess2
    /// times what it was. It decides how long the search takes, never what it finds.
    float guess2 = 1.0f, spread = 1.0f;
    std::uint32_t stride = 1;  ///< one hit point in so many takes part
  };
  /// Gives the tile's hit points (in their search order) the R^2 that reaches to their n-th nearest
  /// photon in all of the grids together, and clears the rest of their statistics. Photons that
  /// do not count at the hit point are passed over; those at the same distance as the n-th lie
  /// within R, too.
  void find(const HitTile& tile, std::span<const PhotonGrid> grids, const Request& request);

  /// Histogram of the radii that were found since it was cleared (PPM_RADIUS_BINS bins).
  std::array<std::uint32_t, PPM_RADIUS_BINS> histogram();
  void clear_histogram();

  std::uint64_t rounds() const { return rounds_; }  ///< that the last `find` took

 private:
  std::uint32_t begin(const HitTile& tile, const Request& request);
  /// One round; returns how many hit points need another.
  std::uint32_t make_round(const HitTile& tile, std::span<const PhotonGrid> grids,
                           const Request& request, std::uint32_t searches);
  void search(const HitTile& tile, const PhotonGrid& grid, const Request& request,
              std::uint32_t searches);
  shared::NearestStepPush step_push(const Request& request) const;
  gpu::BindingTable table_for(const HitTile& tile) const;
  const gpu::Buffer& list() const { return list_[rounds_ % 2]; }
  const gpu::Buffer& next_list() const { return list_[(rounds_ + 1) % 2]; }

  gpu::Device& device_;
  gpu::Kernel begin_, search_, slices_, decide_;
  gpu::Buffer searches_, list_[2], cursors_[2], histogram_;
  std::uint64_t cursor_capacity_;
  std::uint32_t rounds_ = 0;
  Counters counters_;
};

}  // namespace ppm::render
