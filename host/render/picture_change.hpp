// How fast a picture still changes.
#pragma once

#include <cstdint>
#include <optional>

#include "integrator.hpp"

namespace ppm::render {

/// Sum of |after - before| over that of |after|, over all pixels and channels; 0 where both are
/// black. The pictures are of one size; what is not finite is left out.
double relative_change(const Picture& before, const Picture& after);

/// Compares the picture with what it was at half as many passes, or fewer, whenever their number
/// has doubled. Where errors of passes are independent of each other, the mean of |I_2n - I_n| is
/// what the mean error of I_2n is without its bias: both have the variance of a pass over 2 n.
class ChangeMeter {
 public:
  struct Change {
    double value = 0.0;       ///< relative_change
    std::uint64_t since = 0;  ///< passes of the earlier picture
  };

  /// Whether the picture after so many passes is worth resolving.
  bool due(std::uint64_t passes) const { return passes > 0 && passes >= 2 * passes_; }
  void take(Picture picture, std::uint64_t passes);
  /// Nothing before two pictures were taken.
  const std::optional<Change>& change() const { return change_; }

 private:
  Picture picture_;
  std::uint64_t passes_ = 0;
  std::optional<Change> change_;
};

}  // namespace ppm::render
