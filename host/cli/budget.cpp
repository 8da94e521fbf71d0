#include "budget.hpp"

#include <algorithm>
#include <limits>

namespace ppm::cli {
namespace {

constexpr std::uint64_t kMostPasses = std::numeric_limits<std::uint32_t>::max();

}  // namespace

render::Budget budget_for(const RenderOptions& options) {
  render::Budget budget{options.passes, options.seconds};
  if (options.run.total_photons) {
    const std::uint64_t a_pass = options.settings.photons_per_pass;
    const std::uint64_t whole = (*options.run.total_photons - 1) / a_pass + 1;
    budget.passes = std::min({budget.passes.value_or(kMostPasses), whole, kMostPasses});
  }
  const bool bounded = budget.passes || budget.seconds ||
                       render::method_named(options.settings.integrator).ends_itself;
  if (!bounded) budget.passes = options.usual_passes;
  return budget;
}

}  // namespace ppm::cli
