// How many rounds of bounces are recorded for a batch of paths before the host looks again, by what
// the last batch took.
#pragma once

#include <array>
#include <cstdint>

#include "device_batch.hpp"
#include "shared/layout.h"

namespace ppm::render {

class TracingRounds {
 public:
  TracingRounds();

  /// Paths start anew: as many rounds are to be recorded as usually end them.
  void begin();
  /// The rounds of the last submission are done; as many again, for those that are left.
  void go_on() { traced_ += recorded_; }
  /// What the batch of `paths` paths says, whose rounds have run, about the next ones.
  void learn(const DeviceBatch& batch, std::uint32_t paths);

  /// Rounds to record, an even number: what is left then lies in the first queue.
  std::uint32_t count() const { return recorded_; }
  /// Whether this round of the submission in hand starts paths rather than following them.
  bool starts_paths(std::uint32_t round) const { return traced_ + round == 0; }
  /// How many of `paths` that round is likely to begin with.
  std::uint64_t expected(std::uint32_t round, std::uint32_t paths) const;

 private:
  std::uint32_t recorded_ = 0;                        // in a submission
  std::uint32_t traced_ = 0;                          // in earlier ones, of the same paths
  std::uint32_t usual_;                               // by experience
  std::array<double, PPM_TRACE_ROUNDS> usual_alive_;  // share of the paths, idem
};

}  // namespace ppm::render
