// The pilot pass: initial radii from photons that are discarded afterwards.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "counters.hpp"
#include "hit_tile.hpp"
#include "photon_grid.hpp"
#include "scene_traits.hpp"

namespace ppm::render {

/// Needed only until all hit points have their radius.
class Pilot {
 public:
  /// The tiles' hit points must have the mark of Estimator::set_radii; they must outlive this.
  Pilot(gpu::Device& device, const SceneTraits& traits, std::span<const HitTile> tiles);

  /// Hit points without a radius look for photons within `radius` (working units), half of the
  /// round before.
  struct Round {
    std::uint32_t index;
    bool last;
    float radius;
  };

  /// A round among the photons of `grid`, all there are. Returns how many hit points are still
  /// without a radius. coarse: the grid's cells are larger than the round's radius; then nothing is
  /// returned where that makes too many photons to look at, and the round must be run again in
  /// cells of its radius.
  std::optional<std::uint64_t> decide(const PhotonGrid& grid, const Round& round, bool coarse);

  /// The same where photons come in chunks: counts those of one chunk, in cells of the radius ...
  void count(const PhotonGrid& grid, const Round& round);
  /// ... and decides when all have been counted. Rounds in chunks and others do not mix.
  std::uint64_t decide(const Round& round);

 private:
  struct Undecided {
    gpu::Buffer list[2];  ///< from one round to the next; the first round asks all
    std::uint32_t count;
  };
  gpu::BindingTable table_for(const HitTile& tile) const;

  gpu::Device& device_;
  std::span<const HitTile> tiles_;
  SceneTraits traits_;
  gpu::Kernel decide_at_once_;
  std::optional<gpu::Kernel> count_, decide_;  ///< made when photons do come in chunks
  std::vector<Undecided> undecided_;
  Counters counters_;
};

}  // namespace ppm::render
