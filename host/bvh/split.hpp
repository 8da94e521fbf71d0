// Where to split a range of primitives: the surface area heuristic over binned centroids.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "lanes.hpp"

namespace ppm::bvh {

inline constexpr std::uint32_t kMaxBins = 32;

/// What is known of a range of primitives before it is split.
struct Bounds {
  Box box;        // of the primitives
  Box centroids;  // of their centroids

  void grow(const Primitive& primitive) {
    box.grow(primitive.lower, primitive.upper);
    const Float4 centroid = primitive.centroid();
    centroids.grow(centroid, centroid);
  }
  void grow(const Bounds& other) {
    box.grow(other.box);
    centroids.grow(other.centroids);
  }
};

/// Maps centroids to bins, on the three axes at once.
class BinMap {
 public:
  BinMap(const Box& centroids, std::uint32_t count) : lower_(centroids.lower) {
    bins_ = std::min(kMaxBins, 4 + count / 16);
    const Float4 size = centroids.upper - centroids.lower;
    last_ = splat(static_cast<float>(bins_ - 1));
    for (int axis = 0; axis < 3; ++axis) {
      // A quotient too large to be finite would put everything into one bin all the same.
      const float scale = static_cast<float>(bins_) * 0.9999f / size[axis];
      scale_[axis] = size[axis] > 0.0f && std::isfinite(scale) ? scale : 0.0f;
    }
  }

  std::uint32_t bins() const { return bins_; }
  bool splits(int axis) const { return scale_[axis] > 0.0f; }
  Int4 operator()(const Primitive& primitive) const {
    const Float4 bin = (primitive.centroid() - lower_) * scale_;
    return __builtin_convertvector(minimum(bin, last_), Int4);
  }

 private:
  Float4 lower_;
  Float4 scale_ = splat(0.0f);
  Float4 last_;
  std::uint32_t bins_;
};

/// The primitives of one bin.
struct Bin {
  Box box;
  std::uint32_t count = 0;

  void grow(const Bin& other) {
    box.grow(other.box);
    count += other.count;
  }
};

/// The primitives of a range by bin, on each axis.
struct Histogram {
  std::array<std::array<Bin, kMaxBins>, 3> bins;

  void clear(std::uint32_t used) {
    for (auto& axis : bins) std::fill_n(axis.begin(), used, Bin{});
  }
  void add(const BinMap& map, std::span<const Primitive> primitives) {
    for (const Primitive& primitive : primitives) {
      const Int4 bin = map(primitive);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Bin& target = bins[axis][static_cast<std::size_t>(bin[axis])];
        target.box.grow(primitive.lower, primitive.upper);
        ++target.count;
      }
    }
  }
  void add(const Histogram& other, std::uint32_t used) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::uint32_t i = 0; i < used; ++i) bins[axis][i].grow(other.bins[axis][i]);
  }
};

/// Primitives whose bin on `axis` is below `bin` go left; axis -1 where no plane divides the
/// centroids.
struct Split {
  int axis = -1;
  std::uint32_t bin = 0;
  float cost = std::numeric_limits<float>::infinity();
  std::uint32_t left_count = 0;

  bool sends_left(const BinMap& map, const Primitive& primitive) const {
    return static_cast<std::uint32_t>(map(primitive)[axis]) < bin;
  }
};

/// The split of least cost, number of primitives times half the surface of their box, on both
/// sides.
Split best_split(const Histogram& histogram, const BinMap& map);

}  // namespace ppm::bvh
