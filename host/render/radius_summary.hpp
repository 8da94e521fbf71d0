// Radii of hit points for the statistics file.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace ppm::render {

struct RadiusSummary {
  double min = 0.0, median = 0.0, max = 0.0;  ///< world units; 0 when there are none
};

/// Of squares in working units; scale: that of the scene's frame.
inline RadiusSummary summarize_radii(std::vector<float> radii2, double scale) {
  if (radii2.empty()) return {};
  const auto to_world = [&](float radius2) {
    return std::sqrt(static_cast<double>(radius2)) / scale;
  };
  const auto [least, most] = std::minmax_element(radii2.begin(), radii2.end());
  RadiusSummary summary{to_world(*least), 0.0, to_world(*most)};
  const auto middle = radii2.begin() + static_cast<std::ptrdiff_t>(radii2.size() / 2);
  std::nth_element(radii2.begin(), middle, radii2.end());
  summary.median = to_world(*middle);
  return summary;
}

}  // namespace ppm::render
