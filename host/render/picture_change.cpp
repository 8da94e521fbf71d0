#include "picture_change.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "failure.hpp"

namespace ppm::render {

double relative_change(const Picture& before, const Picture& after) {
  PPM_ASSERT(before.rgb.size() == after.rgb.size(), std::to_string(after.rgb.size()));
  double difference = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < after.rgb.size(); ++i) {
    const double a = after.rgb[i], b = before.rgb[i];
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    difference += std::abs(a - b);
    sum += std::abs(a);
  }
  return sum > 0.0 ? difference / sum : difference > 0.0 ? 1.0 : 0.0;
}

void ChangeMeter::take(Picture picture, std::uint64_t passes) {
  if (passes_ > 0) change_ = {relative_change(picture_, picture), passes_};
  picture_ = std::move(picture);
  passes_ = passes;
}

}  // namespace ppm::render
