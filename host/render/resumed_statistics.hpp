// Statistics of a rendering that was stopped and goes on.
#pragma once

#include "integrator.hpp"

namespace ppm::render {

class ResumedStatistics {
 public:
  /// `before`: when it was stopped; `restored`: what the integrator says right after it was
  /// restored, which may count work that was done before and was repeated now.
  ResumedStatistics(Statistics before, Statistics restored);

  /// `now`: what the integrator says. Counts are as if it had never stopped; times are all that was
  /// spent.
  Statistics joined(const Statistics& now) const;

 private:
  Statistics before_, restored_;
};

}  // namespace ppm::render
