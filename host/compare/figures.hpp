// The paper's Figures 4 and 5: hit points and pictures against the number of passes.
#pragma once

#include <optional>
#include <vector>

#include "integrator.hpp"
#include "plan.hpp"
#include "report_folder.hpp"
#include "timed_run.hpp"

namespace ppm::compare {

/// A hit point after a pass.
struct ProbeSample {
  std::uint64_t passes = 0;
  render::ProbeReading reading;
};

struct ProbeCurve {
  PixelPosition at;
  std::vector<ProbeSample> samples;  ///< a pass each; empty: the pixel has no hit point
};

struct Figures {
  std::vector<ProbeCurve> probes;  ///< Figure 4
  RunRecord record;                ///< Figure 5: its pictures
  std::string run;                 ///< the folder's name for it
};

/// Nothing when interrupted, or where the plan asks for none. Throws Failure.
std::optional<Figures> make_figures(Stage& stage, const ReportFolder& folder, const Plan& plan);

}  // namespace ppm::compare
