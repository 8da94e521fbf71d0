#include "split.hpp"

namespace ppm::bvh {
namespace {

void sweep(const std::array<Bin, kMaxBins>& bins, std::uint32_t used, int axis, Split& best) {
  std::array<float, kMaxBins> right_cost;
  Bin right;
  for (std::uint32_t i = used - 1; i > 0; --i) {
    right.grow(bins[i]);
    right_cost[i] = right.count == 0 ? std::numeric_limits<float>::infinity()
                                     : right.box.half_area() * static_cast<float>(right.count);
  }
  Bin left;
  for (std::uint32_t i = 1; i < used; ++i) {
    left.grow(bins[i - 1]);
    if (left.count == 0) continue;
    const float cost = left.box.half_area() * static_cast<float>(left.count) + right_cost[i];
    if (cost < best.cost) best = Split{axis, i, cost, left.count};
  }
}

}  // namespace

Split best_split(const Histogram& histogram, const BinMap& map) {
  Split best;
  for (int axis = 0; axis < 3; ++axis)
    if (map.splits(axis))
      sweep(histogram.bins[static_cast<std::size_t>(axis)], map.bins(), axis, best);
  return best;
}

}  // namespace ppm::bvh
