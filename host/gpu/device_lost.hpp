// A device that its driver has given up: whatever else is asked of it fails as well.
#pragma once

#include "failure.hpp"

namespace ppm::gpu {

/// Those who go on after other Failures have nothing to go on with after this one.
class DeviceLost : public Failure {
 public:
  using Failure::Failure;
};

}  // namespace ppm::gpu
