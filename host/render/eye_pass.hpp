// The ray tracing pass: from a range of pixels to a tile of hit points.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "counters.hpp"
#include "exclusive_scan.hpp"
#include "hit_tile.hpp"
#include "integrator.hpp"
#include "scene_traits.hpp"

namespace ppm::render {

/// Smaller tiles would take hardly less beside what else there is.
inline constexpr std::uint64_t kFewestTileHits = 1u << 12;

/// Hit points a tile holds at most: as many as asked for, or as the largest buffer takes.
std::uint64_t tile_capacity(const Settings& settings, std::uint64_t storage_bytes);
/// For how many the largest tile has room: fewer where the picture is small.
std::uint64_t tile_records(const Settings& settings, std::uint64_t storage_bytes);

/// How much an eye pass holds at a time.
struct EyeRoom {
  std::uint64_t capacity;  ///< hit points of a tile, at most
  std::uint64_t queue;     ///< eye paths of a tile, and paths in a queue, at most
  std::uint32_t samples;   ///< eye paths a pixel
  double hits_a_pixel;     ///< expected before the first tile tells

  static EyeRoom of(const Settings& settings, std::uint64_t storage_bytes);

  /// Pixels worth trying for a tile, when so many hit points a pixel are expected.
  std::uint32_t pixels_for(double hits_expected) const;
  /// Records for which such a tile gets room; more than are expected, since tracing again costs
  /// more.
  std::uint64_t records_for(double hits_expected, std::uint64_t pixels) const;
  /// What of so much room is left when the hit points are known and the tile stays.
  static std::uint64_t tightened(std::uint64_t room, std::uint64_t hits);
};

/// What takes long to make and depends on little.
struct EyeKernels {
  /// What the paths leave in a tile: hit points and light, or records for surfaces.comp.
  enum class Find { hit_points, surfaces };
  EyeKernels(gpu::Device& device, const SceneTraits& traits, Find find = Find::hit_points);
  gpu::Kernel start, go_on, scatter, order;
  bool layers;  ///< hit points have a fifth plane
};

/// Queues and sorting memory of the eye pass; needed only while tiles are made.
class EyePass {
 public:
  EyePass(gpu::Device& device, const EyeKernels& kernels, const gpu::BindingTable& scene,
          const Settings& settings);

  /// Pixels worth trying for the next tile: what earlier tiles needed a pixel, and some reserve.
  std::uint32_t suggested_pixels() const { return room_.pixels_for(hits_per_pixel_); }

  enum class Result { done, too_large, interrupted };

  /// Traces the eye paths of `pixels` pixels from `first_pixel` on and makes a tile of them, in the
  /// buffers that `tile` has as far as they suffice. too_large: a queue overflowed or a tile cannot
  /// hold the hit points, and fewer pixels must be tried.
  Result trace(std::uint32_t first_pixel, std::uint32_t pixels,
               const std::function<bool()>& interrupted, HitTile& tile);

  /// Moves the tile's geometry to buffers of the size needed, where they are much larger.
  void tighten(HitTile& tile);

  const Counters& counters() const { return counters_; }  ///< of the last trace
  std::uint64_t rays() const { return rays_; }            ///< searches for the closest hit, idem

 private:
  /// Buffers for the geometry of so many hit points, and for sorting them.
  void reserve(HitTile& tile, std::uint64_t hits);
  /// Traces the tile's pixels. Stores as many hit points as there is room for, and counts all.
  Result trace_paths(const HitTile& tile, std::uint64_t room,
                     const std::function<bool()>& interrupted);
  void order_hits(HitTile& tile);

  gpu::Device& device_;
  const EyeKernels& kernels_;
  std::uint32_t samples_;
  Filter filter_;
  EyeRoom room_;
  double hits_per_pixel_;  ///< expected of the next tile
  gpu::BindingTable table_;
  ExclusiveScan scan_;
  gpu::Buffer queue_[2], group_count_, keys_, arrivals_;
  Counters counters_;
  std::uint64_t rays_ = 0;
};

}  // namespace ppm::render
