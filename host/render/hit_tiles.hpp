// All hit points of the picture, and what they know: on the device, all of them or tile by tile.
//
// Where memory suffices the tiles stay on the device. Where it does not there is one at a time: its
// eye paths are traced anew whenever it is needed, and the host keeps no more of it than its
// statistics, 20 bytes instead of some 150 a hit point. Hit points and their canonical order are a
// function of scene and options alone, so that the picture is the same to the byte, however often
// they are traced and however the picture is cut into tiles.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "eye_tiles.hpp"
#include "integrator.hpp"
#include "memory_shortage.hpp"
#include "tally.hpp"

namespace ppm::render {

/// What a hit point knows between passes; also as saved states have it.
struct KeptHit {
  float statistics[4];  ///< as HitTile::statistics
  std::uint32_t photon_count;
};
static_assert(sizeof(KeptHit) == 20);

class HitTiles {
 public:
  /// `scene`: the table of scene buffers. Settings::traces_anew and the allowances decide whether
  /// the tiles stay.
  HitTiles(gpu::Device& device, const gpu::BindingTable& scene, const Settings& settings, Log& log);

  /// Traces all eye paths for the first time, and adds to the statistics what they took. The
  /// kernels must outlive the tiles. Returns false when interrupted.
  bool trace(const EyeKernels& kernels, const std::function<bool()>& interrupted,
             Statistics& statistics);
  /// Forgets all of them; they may be traced for the first time again.
  void clear();

  bool are_traced_anew() const { return anew_; }
  /// Lets go of all that is on the device, with what the hit points know: from now on they are
  /// traced anew. Throws `shortage` where they are already.
  void trace_anew(const gpu::MemoryShortage& shortage);

  /// All of them; none when they are traced anew.
  std::span<HitTile> all() { return tiles_; }
  std::uint64_t hits() const { return hits_; }
  std::uint64_t most_hits() const;  ///< of a tile, or an upper bound

  /// Calls `use` with each tile, one after another. Those that are traced anew have the statistics
  /// that were kept last, and those that `use` leaves them are kept if `keep` says so; search_order
  /// they have none. Returns false as soon as `interrupted` says yes or `use` returns false (then
  /// nothing is kept of the tile). `use` may throw MemoryShortage before it has had any effect
  /// outside of the tile, and is called again with a smaller one.
  enum class Keep { no, yes };
  bool for_each(const std::function<bool()>& interrupted, Keep keep,
                const std::function<bool(HitTile&)>& use);

  /// Appends what all hit points know, in canonical order: a function of the picture, not of its
  /// tiles.
  void save(SavedState& state) const;
  /// From `hits()` of them as `save` leaves them.
  void restore(const std::uint8_t* saved);
  /// The same, when they are traced anew.
  std::span<const KeptHit> kept() const { return kept_; }

 private:
  struct Totals {
    Tally tally;
    std::uint64_t hits = 0, rays = 0, tiles = 0;
    std::uint64_t most_hits = 0;
    void add(const HitTile& tile, const EyePass& eye);
  };
  /// All to the device. False: interrupted. Nothing: they would not fit.
  std::optional<bool> trace_to_stay(const std::function<bool()>& interrupted, Totals& totals);
  bool fits(std::uint64_t before, std::uint64_t pixels) const;

  gpu::Device& device_;
  gpu::BindingTable scene_;
  Settings settings_;
  Log& log_;
  bool anew_;
  const EyeKernels* kernels_ = nullptr;  ///< once they have been traced
  std::optional<EyeTiles> maker_;        ///< when they are traced anew
  std::vector<HitTile> tiles_;
  std::vector<KeptHit> kept_;  ///< in canonical order, of the first hit points or of all
  std::uint64_t hits_ = 0, tile_bytes_ = 0, most_hits_ = 0;
};

}  // namespace ppm::render
