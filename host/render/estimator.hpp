// Searches, the progressive update and the picture: all that is done to tiles of hit points after
// the eye pass.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "counters.hpp"
#include "device_batch.hpp"
#include "hit_tiles.hpp"
#include "integrator.hpp"
#include "photon_grid.hpp"
#include "search_order.hpp"

namespace ppm::render {

class Estimator {
 public:
  /// `scene` is the table of scene buffers; hit points per tile are at most `tile_hits`.
  Estimator(gpu::Device& device, const gpu::BindingTable& scene, const SceneTraits& traits,
            std::uint64_t tile_hits);

  /// Adds the grid's photons to the sums of the tile's hit points [HOJ08 Eq. 11]. Returns how many
  /// terms were out of the range of fixed point and how many normal factors were clamped.
  struct Rejected {
    std::uint64_t overflow = 0, clamped = 0;

    Rejected& operator+=(const Rejected& more) {
      overflow += more.overflow;
      clamped += more.clamped;
      return *this;
    }
  };
  Rejected gather(const HitTile& tile, const PhotonGrid& grid);

  /// The parts of a batch (PassBatch). Searches among the photons of one pass of the grid, as long
  /// as the batch may go on, long ones in as many dispatches as `gather` needed last. Searches that
  /// are left, rejected terms and clamped factors are in the counters.
  void record_gather(gpu::Recorder& recorder, const HitTile& tile, const PhotonGrid& grid,
                     std::uint32_t pass, const DeviceBatch& batch);
  bool searches_fit_batch() const;  ///< the dispatches that `gather` needed are few enough
  void clear_counters(gpu::Recorder& recorder) const { counters_.clear(recorder); }
  void bind_counters(gpu::BindingTable& table) const { counters_.bind(table); }
  /// As `update`; with a batch, as long as it may go on. The histogram is read apart.
  void record_update(gpu::Recorder& recorder, std::span<const HitTile> tiles, float alpha,
                     const DeviceBatch* batch);
  void read_histogram(gpu::Recorder& recorder);

  /// Eqs. 7, 9 and 12 for every hit point, from its sums, which are zero afterwards.
  void update(std::span<const HitTile> tiles, float alpha);

  /// Forgets the sums of a pass that was not completed.
  void clear_sums(std::span<const HitTile> tiles);

  /// Radiance of the tile's pixels, in their order, 4 floats each [HOJ08 Eq. 13].
  /// scale: total power / photons emitted.
  std::vector<glm::vec4> resolve(const HitTile& tile, std::uint32_t samples, float scale);
  /// Memory for that, beforehand.
  void reserve_pixels(std::uint64_t pixels);

  /// The same for all pixels of a picture. scale: idem.
  Picture picture(HitTiles& tiles, const Settings& settings, float scale);

  /// Cell size that suits the radii as of the last update (or of `set_radii`), working units; 0
  /// without hit points.
  float cell_size() const { return cell_from_radii(radius_histogram_); }

  /// Gives the hit points of a tile their radius: `fixed_radius` (working units) if positive, else
  /// `footprints` times their pixel's footprint if positive, else the mark that the pilot replaces.
  void set_radii(const HitTile& tile, float fixed_radius, float footprints);

  /// Once radii are known and before the first `gather`: reads their histogram, and puts the tiles'
  /// hit points in search order. Returns R^2 of all of them, working units, in any order.
  std::vector<float> prepare_searches(std::span<HitTile> tiles);

  /// The same for tiles that are not all there at a time: the histogram is cleared, then that of
  /// each tile is added, by itself (R^2 of its hit points are appended) or after its update.
  void clear_radii() { radius_histogram_.fill(0); }
  void add_radius(float radius2);
  void add_radii(const HitTile& tile, std::vector<float>& radii2);
  void update_and_add_radii(const HitTile& tile, float alpha);
  /// Puts the tile's hit points in search order, in cells that suit photon cells of that size.
  void order_searches(HitTile& tile, float cell);
  /// Reads the histogram of radii without changing anything else.
  void measure_radii(std::span<const HitTile> tiles);

 private:
  gpu::BindingTable table_for(const HitTile& tile) const;
  void paint(const HitTile& tile, const Settings& settings, float scale, Picture& picture);
  shared::GatherPush gather_push(const PhotonGrid& grid, std::uint32_t pass) const;

  gpu::Device& device_;
  gpu::BindingTable scene_;
  SearchOrder order_;
  gpu::Kernel gather_, gather_slices_, update_, resolve_, radius_;
  gpu::Buffer cursors_[2], histogram_buffer_, pixels_;
  std::uint64_t cursor_capacity_;
  std::uint32_t usual_slices_ = 0;  // dispatches after the first: of the last tile, or one less
                                    // than of an earlier one
  Counters counters_;
  std::array<std::uint32_t, PPM_RADIUS_BINS> radius_histogram_{};
};

}  // namespace ppm::render
