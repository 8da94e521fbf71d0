// Random choice in proportion to weights.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ppm::render {

/// Vose's alias method (1991) over `weights` (all >= 0, their sum > 0): bin i keeps i while a
/// random 32-bit word is below threshold[i], else takes alias[i]. The chance of each index is
/// weights[i] / sum up to 2^-32.
struct AliasTable {
  std::vector<std::uint32_t> threshold, alias;
};
AliasTable make_alias_table(std::span<const double> weights);

}  // namespace ppm::render
