// One rendering of a comparison against the clock.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "driver.hpp"
#include "plan.hpp"
#include "run_record.hpp"

namespace ppm::compare {

/// What all renderings of a comparison share.
struct Stage {
  const scene::Scene& scene;  ///< its arrays are kept
  gpu::Device& device;
  render::Circumstances circumstances;
  unsigned threads = 1;
  std::function<bool()> interrupted;
  std::function<void(const std::string&)> tell;  ///< a line of progress
  /// Throws Failure where a rendering with these settings would not fit the machine.
  std::function<render::Settings(const render::Settings&)> admit;
  std::set<std::string> warm;  ///< methods whose pipelines are there
};

/// All of the method's settings that decide the pixels, but for the seed.
Options options_of(const Stage& stage, const Method& method);

/// When pictures are kept, and when a rendering ends.
struct Schedule {
  double seconds = 0.0;               ///< of the clock; the pass in hand is finished. 0: any time
  std::vector<double> moments;        ///< of the clock, ascending
  std::vector<std::uint64_t> passes;  ///< exactly, ascending
  std::optional<std::uint64_t> last_pass;  ///< nothing: any number
  bool pass_by_pass = false;               ///< no more than one at a time
  /// Called off the clock after each pass or handful of them.
  std::function<void(render::Integrator&)> after_passes;
};

/// Renders, and writes the pictures that the schedule asks for and the last one as EXR files into
/// `folder`. The clock runs from before Integrator::prepare; it stands still while pictures are
/// resolved and written, but a picture's own resolving counts for it. Nothing when interrupted.
std::optional<RunRecord> timed_run(const Stage& stage, const Method& method, std::uint32_t seed,
                                   const Schedule& schedule, const std::filesystem::path& folder);

}  // namespace ppm::compare
