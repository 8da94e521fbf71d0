#include "tracing_rounds.hpp"

#include <algorithm>

namespace ppm::render {
namespace {

// Before anything is known: rounds to record, the share of paths that survive each.
constexpr std::uint32_t kFirstRounds = 16;
constexpr double kFirstSurvival = 0.7;
// Rounds recorded beyond the usual ones: they cost less than a look from the host.
constexpr std::uint32_t kSpareRounds = 2;
static_assert(PPM_TRACE_ROUNDS % 2 == 0, "paths that are left must lie in the first queue");

std::uint32_t even(std::uint32_t rounds) {
  return std::clamp((rounds + 1) / 2 * 2, 2u, std::uint32_t{PPM_TRACE_ROUNDS});
}

}  // namespace

TracingRounds::TracingRounds() : usual_(kFirstRounds) {
  double share = 1.0;
  for (double& usual : usual_alive_) {
    usual = share;
    share *= kFirstSurvival;
  }
}

void TracingRounds::begin() {
  recorded_ = usual_;
  traced_ = 0;
}

void TracingRounds::learn(const DeviceBatch& batch, std::uint32_t paths) {
  const double all = std::max(paths, 1u);
  std::uint32_t used = 0;
  for (; used < recorded_ && batch->alive[used] > 0; ++used) {
    if (traced_ + used < PPM_TRACE_ROUNDS) usual_alive_[traced_ + used] = batch->alive[used] / all;
  }
  usual_ = even(traced_ + used + kSpareRounds);
}

std::uint64_t TracingRounds::expected(std::uint32_t round, std::uint32_t paths) const {
  const std::uint32_t known = std::min<std::uint32_t>(traced_ + round, PPM_TRACE_ROUNDS - 1);
  return static_cast<std::uint64_t>(usual_alive_[known] * paths);
}

}  // namespace ppm::render
