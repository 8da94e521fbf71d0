// From pictures and a reference to errors, curves and slopes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "metrics.hpp"
#include "plan.hpp"
#include "reference.hpp"
#include "report_folder.hpp"
#include "run_record.hpp"

namespace ppm::compare {

/// A run and the errors of its pictures, in their order.
struct SeedResult {
  RunRecord record;
  std::string run;  ///< the folder's name for it
  std::vector<Errors> errors;
};

/// What can be said of a method. Errors are those of the last pictures; with several seeds their
/// median.
struct MethodResult {
  std::string label, integrator;
  std::string failure;            ///< the line that says why it has no runs, or fewer
  std::vector<SeedResult> seeds;  ///< may be empty
  double rmse = 0.0, relative_mse = 0.0, trimmed_relative_mse = 0.0;
  std::optional<double> rmse_slope, relative_slope,
      trimmed_slope;  ///< against time; medians over seeds
  /// Of two seeds and more: what differs between seeds (root mean variance) and what is common to
  /// all of them (root of the mean square that is left of (I - R)^2; the reference's own errors are
  /// part of it).
  std::optional<double> noise, bias;
  std::array<Estimate, 3> mean, mean_difference;  ///< over seeds, by channel
  std::vector<Sample> rmse_curve, relative_curve,
      trimmed_curve;  ///< medians over seeds against seconds
};

/// Errors of all pictures of a run.
SeedResult measure_seed(const ReportFolder& folder, const std::string& run, RunRecord record,
                        const Reference& reference, double epsilon, std::uint32_t width,
                        std::uint32_t height);

/// Fills in all but label, integrator, failure and seeds. `last_pictures`: of the seeds.
void summarise(MethodResult& result, const PictureMean& last_pictures);

/// The sum over pixels and channels that the method's last pictures have, as a share of the
/// reference's; 1 where nothing can be said.
double share_of_light(const MethodResult& result);
/// What is less than this is told: the method misses light, or finds it too seldom.
constexpr double kEnoughLight = 0.9;

/// Medians over seeds of the k-th last picture, for all k that every seed has; ascending in x.
/// `curves`: a seed each.
std::vector<Sample> median_curve(const std::vector<std::vector<Sample>>& curves);

/// Points (seconds, error) of one seed.
std::vector<Sample> rmse_points(const SeedResult& seed);
std::vector<Sample> relative_points(const SeedResult& seed);
std::vector<Sample> trimmed_points(const SeedResult& seed);

/// Where methods differ most: `count` parts of about a sixth of the picture's width that do not
/// overlap, by the sum of the methods' error maps (one value a pixel, NaN counts as nothing).
std::vector<Crop> crops_of_interest(const std::vector<std::vector<float>>& maps,
                                    std::uint32_t width, std::uint32_t height, unsigned count);

/// The exposure that shows nine tenths of the pixels below white, rounded to a tenth.
double suitable_exposure(std::span<const float> rgb);

}  // namespace ppm::compare
