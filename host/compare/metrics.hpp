// How far a picture is from a reference, and how fast it comes nearer.
//
// Pictures are linear RGB, row-major, three floats a pixel. Means are over pixels and channels that
// are finite in both pictures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ppm::compare {

using Rgb = std::array<double, 3>;

struct Errors {
  double rmse = 0.0;          ///< root of the mean of (I - R)^2, radiance
  double relative_mse = 0.0;  ///< mean of (I - R)^2 / (R^2 + epsilon), no unit
  /// The same without the thousandth of the pixels that are worst (rounded up): what is left when a
  /// few fireflies, or pixels at the rims of lamps, do not decide.
  double trimmed_relative_mse = 0.0;
  Rgb mean{};                  ///< of the picture by channel, radiance
  Rgb mean_difference{};       ///< of I - R by channel, radiance
  std::uint64_t left_out = 0;  ///< values that are NaN or infinite in either picture
};

/// What keeps black pixels of the reference from counting for everything: the square of a tenth of
/// the mean of all its values. (Of the mean and not of the root mean square, which a single lamp
/// that is seen directly may decide.) Radiance squared; 0 where the reference is black.
double relative_epsilon(std::span<const float> reference);

/// Both of one size. `epsilon` is relative_epsilon of the reference; where it is 0 the relative
/// error is 0.
Errors errors_of(std::span<const float> picture, std::span<const float> reference, double epsilon);

/// One value a pixel: the root of the mean over channels of (I - R)^2 / (R^2 + epsilon), NaN where
/// a value is not finite.
std::vector<float> relative_error_map(std::span<const float> picture,
                                      std::span<const float> reference, double epsilon);

/// Mean and spread of pictures that differ by their seeds alone.
class PictureMean {
 public:
  /// All of one size.
  void add(std::span<const float> picture);
  std::size_t count() const { return count_; }
  std::vector<float> mean() const;
  /// Standard error of the mean, value by value; zeros for fewer than two pictures.
  std::vector<float> standard_error() const;
  /// Mean over all values of the variance of ONE picture (unbiased); 0 for fewer than two.
  double mean_variance() const;

 private:
  std::size_t count_ = 0;
  std::vector<double> mean_, squares_;  ///< Welford's: sums of squared deviations
};

struct Sample {
  double x = 0.0, y = 0.0;
};

/// Slope of the least-squares line through (log x, log y): -0.5 for the RMSE of an unbiased method
/// against time. Nothing for fewer than two different x; points that are not positive are left out.
std::optional<double> log_log_slope(std::span<const Sample> points);

/// Of at least one value; the mean of the two in the middle where their number is even.
double median(std::vector<double> values);

/// Mean and its standard error (0 for one value) of at least one value.
struct Estimate {
  double mean = 0.0, standard_error = 0.0;
};
Estimate estimate(std::span<const double> values);

}  // namespace ppm::compare
