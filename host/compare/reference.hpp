// The picture that all others are measured against, and how much it is to be trusted.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plan.hpp"
#include "report_folder.hpp"
#include "timed_run.hpp"

namespace ppm::compare {

struct Reference {
  std::vector<float> rgb;             ///< mean over its seeds
  std::vector<float> standard_error;  ///< of that mean, value by value; empty: not known
  std::string method;                 ///< its label; empty: a file of the user
  std::string account;                ///< sentences: what it is, who made it and why
  double rmse = 0.0;                  ///< root mean square of the standard error; 0: not known
  double relative_mse = 0.0;          ///< mean of its square / (R^2 + epsilon)
};

/// The share of blocks of 8 x 8 pixels (less at the edges) whose mean luminances differ by more
/// than a tenth of the greater one plus a hundredth of the picture's. Both of one size.
double share_of_differing_blocks(std::span<const float> a, std::span<const float> b,
                                 std::uint32_t width);

/// Light is seen by a method whose trial differs from that of photons in no more of its blocks.
constexpr double kTolerableShare = 0.05;

/// Reads or makes it, as the plan says. Where nothing is said, each candidate and ppm render two
/// seeds for a twentieth of the time: the first candidate that agrees with ppm makes it, and where
/// none does, ppm. Nothing when interrupted; throws Failure where nobody can make it.
std::optional<Reference> make_reference(Stage& stage, const ReportFolder& folder, const Plan& plan);

}  // namespace ppm::compare
