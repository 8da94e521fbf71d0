// Comparison of samples with what they should be distributed as.
//
// Seeds are fixed, so that a run either always or never passes. All p-values of the suite are held
// against one significance, corrected by Sidak for their number: a correct program fails anywhere
// in it with probability kFamilySignificance over the choice of seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace ppm::statistics {

inline constexpr double kFamilySignificance = 0.01;
/// An upper bound of the p-values that one run of the whole suite looks at; exceeding it fails.
inline constexpr int kComparisons = 2000;

/// What a single p-value must exceed: 1 - (1 - family)^(1 / comparisons) [Sidak 1967].
double single_significance();

/// Q(a, x) = Gamma(a, x) / Gamma(a), a > 0, x >= 0; relative error below 1e-12.
double regularized_gamma_q(double a, double x);

/// Chance that chi-squared with these degrees of freedom (> 0) exceeds `statistic`.
double chi_squared_survival(double statistic, double degrees_of_freedom);

/// Chance that a standard normal variable lies further from 0 than z.
double normal_two_sided(double z);

struct ChiSquared {
  double statistic = 0.0;
  int degrees_of_freedom = 0;
  double p_value = 1.0;
};

/// Pearson's test of counts (equally many, equal sums). Cells that expect fewer than 8 are pooled,
/// smallest first, until each expects that many. A count where nothing is expected has p = 0.
ChiSquared chi_squared(std::span<const double> observed, std::span<const double> expected);

/// Fails the running test if the p-value is not above single_significance().
void expect_plausible(double p_value, const std::string& what);

/// Fails the running test if the counts do not fit.
void expect_counts(std::span<const double> observed, std::span<const double> expected,
                   const std::string& what);

/// Mean and variance by Welford's recurrence.
class Moments {
 public:
  void add(double x);
  double mean() const { return mean_; }
  double standard_error() const;

 private:
  double count_ = 0.0, mean_ = 0.0, squares_ = 0.0;
};

/// Fails the running test if the mean is implausible; `slack` is what the arithmetic may err by.
void expect_mean(const Moments& moments, double expected, double slack, const std::string& what);

/// The tests' own random numbers, which owe nothing to the code under test: 24 bits in [0, 1).
class Units {
 public:
  explicit Units(std::uint64_t seed) : engine_(seed) {}

  float next() { return static_cast<float>(engine_() >> 40u) * 0x1p-24f; }
  glm::vec2 next2() {
    const float x = next();
    return {x, next()};
  }
  glm::vec3 next3() {
    const glm::vec2 xy = next2();
    return {xy, next()};
  }
  glm::vec4 next4() {
    const glm::vec3 xyz = next3();
    return {xyz, next()};
  }
  /// Uniform on the sphere, rounded to float only at the end.
  glm::vec3 direction();
  std::uint32_t word() { return static_cast<std::uint32_t>(engine_() >> 32u); }
  double between(double low, double high) { return low + (high - low) * next(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace ppm::statistics
