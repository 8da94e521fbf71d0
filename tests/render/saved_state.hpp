// What a saved state of progressive photon mapping says of each hit point.
#pragma once

#include <cstring>
#include <glm/glm.hpp>
#include <stdexcept>
#include <vector>

#include "integrator.hpp"

namespace ppm::test {

struct HitStatistics {
  glm::vec3 lambda;            // sum over passes of tau_M / (pi R^2)
  float radius2;               // working frame; 0 for light seen
  std::uint32_t photon_count;  // C
};

/// Five 64-bit words, then a record of 20 bytes for each hit point.
inline std::vector<HitStatistics> hit_statistics(const render::SavedState& state) {
  constexpr std::size_t kHeader = 40;
  static_assert(sizeof(HitStatistics) == 20);
  if (state.size() < kHeader || (state.size() - kHeader) % sizeof(HitStatistics) != 0)
    throw std::invalid_argument("a saved state of another layout");
  std::vector<HitStatistics> statistics((state.size() - kHeader) / sizeof(HitStatistics));
  if (!statistics.empty()) std::memcpy(statistics.data(), &state[kHeader], state.size() - kHeader);
  return statistics;
}

}  // namespace ppm::test
