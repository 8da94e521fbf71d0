// A device whose memory did not suffice: the one failure that smaller pieces of work may mend.
#pragma once

#include "failure.hpp"

namespace ppm::gpu {

/// Thrown by whatever allocates on the device, which is as usable afterwards as before. Nobody need
/// catch it apart from other Failures.
class MemoryShortage : public Failure {
 public:
  using Failure::Failure;
};

}  // namespace ppm::gpu
