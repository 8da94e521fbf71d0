#include "chi_squared.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace ppm::statistics {
namespace {

constexpr double kFewest = 8.0;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// P(a, x) by its power series; converges fast for x < a + 1.
double lower_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (double n = a + 1.0; term > sum * kEpsilon; n += 1.0) {
    term *= x / n;
    sum += term;
  }
  return sum;
}

// Q(a, x) by Lentz's evaluation of Legendre's continued fraction; for x >= a + 1.
double upper_fraction(double a, double x) {
  double b = x + 1.0 - a;
  double c = 1.0 / std::numeric_limits<double>::min();
  double d = 1.0 / b;
  double fraction = d;
  for (int i = 1; i < 100000; ++i) {
    const double numerator = -i * (i - a);
    b += 2.0;
    d = 1.0 / (numerator * d + b);
    c = b + numerator / c;
    fraction *= c * d;
    if (std::abs(c * d - 1.0) < kEpsilon) break;
  }
  return fraction;
}

}  // namespace

double single_significance() {
  return -std::expm1(std::log1p(-kFamilySignificance) / kComparisons);
}

double regularized_gamma_q(double a, double x) {
  if (x <= 0.0) return 1.0;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  return x < a + 1.0 ? 1.0 - scale * lower_series(a, x) : scale * upper_fraction(a, x);
}

double chi_squared_survival(double statistic, double degrees_of_freedom) {
  return regularized_gamma_q(0.5 * degrees_of_freedom, 0.5 * statistic);
}

double normal_two_sided(double z) {
  return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

ChiSquared chi_squared(std::span<const double> observed, std::span<const double> expected) {
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  ChiSquared result;
  int cells = 0;
  double pooled_observed = 0.0;
  double pooled_expected = 0.0;
  double nowhere = 0.0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (expected[order[k]] <= 0.0) nowhere += observed[order[k]];
    pooled_observed += observed[order[k]];
    pooled_expected += std::max(expected[order[k]], 0.0);
    const bool last = k + 1 == order.size();
    if ((pooled_expected < kFewest && !last) || pooled_expected <= 0.0) continue;
    const double difference = pooled_observed - pooled_expected;
    result.statistic += difference * difference / pooled_expected;
    pooled_observed = pooled_expected = 0.0;
    ++cells;
  }
  result.degrees_of_freedom = cells - 1;
  if (cells > 1) result.p_value = chi_squared_survival(result.statistic, cells - 1);
  if (nowhere > 0.0) result.p_value = 0.0;
  return result;
}

void expect_plausible(double p_value, const std::string& what) {
  static int comparisons = 0;
  EXPECT_LE(++comparisons, kComparisons) << "kComparisons must bound the number of comparisons";
  EXPECT_GT(p_value, single_significance()) << what;
}

void expect_counts(std::span<const double> observed, std::span<const double> expected,
                   const std::string& what) {
  const ChiSquared result = chi_squared(observed, expected);
  expect_plausible(result.p_value, what + ": chi-squared " + std::to_string(result.statistic) +
                                       " at " + std::to_string(result.degrees_of_freedom) +
                                       " degrees of freedom");
}

void Moments::add(double x) {
  count_ += 1.0;
  const double delta = x - mean_;
  mean_ += delta / count_;
  squares_ += delta * (x - mean_);
}

double Moments::standard_error() const {
  return std::sqrt(squares_ / (count_ * (count_ - 1.0)));
}

void expect_mean(const Moments& moments, double expected, double slack, const std::string& what) {
  const double excess = std::max(0.0, std::abs(moments.mean() - expected) - slack);
  const double error = std::max(moments.standard_error(), std::numeric_limits<double>::min());
  expect_plausible(normal_two_sided(excess / error), what + ": mean " +
                                                         std::to_string(moments.mean()) + " +- " +
                                                         std::to_string(moments.standard_error()) +
                                                         ", expected " + std::to_string(expected));
}

glm::vec3 Units::direction() {
  const double z = 1.0 - 2.0 * next();
  const double angle = 2.0 * std::numbers::pi * next();
  const double r = std::sqrt(1.0 - z * z);
  return glm::vec3(r * std::cos(angle), r * std::sin(angle), z);
}

}  // namespace ppm::statistics
