#include "alias_table.hpp"

#include <numeric>

namespace ppm::render {

AliasTable make_alias_table(std::span<const double> weights) {
  const std::size_t n = weights.size();
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> scaled(n);
  std::vector<std::uint32_t> small, large;
  for (std::size_t i = 0; i < n; ++i) {
    scaled[i] = weights[i] / sum * static_cast<double>(n);
    (scaled[i] < 1.0 ? small : large).push_back(static_cast<std::uint32_t>(i));
  }
  AliasTable table{std::vector<std::uint32_t>(n, 0xffffffffu), std::vector<std::uint32_t>(n)};
  std::iota(table.alias.begin(), table.alias.end(), 0u);
  while (!small.empty() && !large.empty()) {
    const std::uint32_t less = small.back();
    const std::uint32_t more = large.back();
    small.pop_back();
    table.threshold[less] = static_cast<std::uint32_t>(scaled[less] * 4294967295.0);
    table.alias[less] = more;
    scaled[more] -= 1.0 - scaled[less];
    if (scaled[more] < 1.0) {
      large.pop_back();
      small.push_back(more);
    }
  }
  return table;  // what is left over is full to rounding, and is its own alias
}

}  // namespace ppm::render
