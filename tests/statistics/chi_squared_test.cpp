// The yardstick itself.
#include "chi_squared.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "direction_chart.hpp"
#include "quadrature.hpp"

namespace ppm::statistics {
namespace {

// With one degree of freedom chi-squared is the square of a normal variable; with an even number 2k
// the survival is the chance of fewer than k events of a Poisson process of mean x / 2.
TEST(ChiSquaredHelper, SurvivalEqualsClosedForms) {
  for (const double x : {1e-6, 0.1, 1.0, 2.0, 3.841458820694124, 10.0, 40.0, 90.0}) {
    const double closed = std::erfc(std::sqrt(0.5 * x));
    EXPECT_NEAR(chi_squared_survival(x, 1) / closed, 1.0, 1e-12) << x;
  }
  for (const int k : {1, 2, 10, 50, 200}) {
    for (const double ratio : {0.5, 0.9, 1.0, 1.1, 1.6}) {
      const double mean = ratio * k;
      double term = std::exp(-mean);
      double closed = 0.0;
      for (int n = 0; n < k; ++n, term *= mean / n) closed += term;
      EXPECT_NEAR(chi_squared_survival(2.0 * mean, 2 * k), closed, 1e-12 + 1e-11 * closed) << k;
    }
  }
}

// Published quantiles (Abramowitz and Stegun, table 26.8).
TEST(ChiSquaredHelper, SurvivalEqualsTable) {
  EXPECT_NEAR(chi_squared_survival(3.84146, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_survival(18.3070, 10), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_survival(29.5883, 10), 0.001, 1e-7);
  EXPECT_NEAR(chi_squared_survival(124.342, 100), 0.05, 1e-5);
}

TEST(ChiSquaredHelper, StatisticIsPearsons) {
  const std::vector<double> observed{18, 22, 30, 10}, expected{20, 20, 20, 20};
  const ChiSquared result = chi_squared(observed, expected);
  EXPECT_DOUBLE_EQ(result.statistic, (4.0 + 4.0 + 100.0 + 100.0) / 20.0);
  EXPECT_EQ(result.degrees_of_freedom, 3);
}

TEST(ChiSquaredHelper, PoolsSmallCellsAndRejectsTheImpossible) {
  const std::vector<double> observed{3, 4, 5, 20, 68}, expected{3, 3, 4, 20, 70};
  const ChiSquared pooled = chi_squared(observed, expected);
  EXPECT_EQ(pooled.degrees_of_freedom, 2);
  EXPECT_NEAR(pooled.statistic, 4.0 / 10.0 + 4.0 / 70.0, 1e-12);
  const std::vector<double> impossible{1, 49, 50}, never{0, 50, 50};
  EXPECT_EQ(chi_squared(impossible, never).p_value, 0.0);
}

// p-values of the test under its own hypothesis are uniform, and a slope of 3% is seen.
TEST(ChiSquaredHelper, IsCalibratedAndHasPower) {
  Units units(1);
  std::vector<double> deciles(10, 0.0), uniform(10, 200.0);
  const std::vector<double> expected(50, 200.0);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> observed(50, 0.0);
    for (int i = 0; i < 10000; ++i) ++observed[static_cast<std::size_t>(units.next() * 50.0f)];
    ++deciles[static_cast<std::size_t>(chi_squared(observed, expected).p_value * 9.999999)];
  }
  expect_counts(deciles, uniform, "p-values");
  std::vector<double> observed(50, 0.0), even(50, 8000.0);
  for (int i = 0; i < 400000; ++i) {
    const double u = units.next();
    ++observed[static_cast<std::size_t>((u + 0.03 * u * (1.0 - u)) * 50.0)];
  }
  EXPECT_LT(chi_squared(observed, even).p_value, single_significance());
}

TEST(Quadrature, IntegratesPolynomialsExactly) {
  for (int degree = 0; degree < 32; ++degree) {
    const double value = integrate([&](double x) { return std::pow(x, degree); }, 0.0, 1.0);
    EXPECT_NEAR(value, 1.0 / (degree + 1), 1e-14) << degree;
  }
}

// Cells cover the hemisphere once, whatever the axis, and the horizon does not blur.
TEST(DirectionChart, CellsCoverTheHemisphere) {
  for (const double cosine : {1.0, 0.6, 0.05}) {
    for (const double scale : {1.0, 0.003}) {
      const glm::dvec3 axis(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
      const DirectionChart chart(axis, scale, true);
      const double solid_angle = chart.integrate_all([](glm::dvec3) { return 1.0; });
      const double projected = chart.integrate_all([](glm::dvec3 w) { return w.z; });
      EXPECT_NEAR(solid_angle, 2.0 * std::numbers::pi, 1e-3);
      EXPECT_NEAR(projected, std::numbers::pi, 1e-6);
    }
  }
}

// Integration points fall into the bin that they stand for.
TEST(DirectionChart, BinsAgreeWithCells) {
  const DirectionChart chart(glm::normalize(glm::dvec3(0.3, -0.5, 0.4)), 0.05, false);
  Units units(2);
  std::vector<double> observed(chart.bins(), 0.0);
  for (int i = 0; i < 200000; ++i) ++observed[chart.bin(units.direction())];
  std::vector<double> expected =
      chart.integrate_cells([](glm::dvec3) { return 200000.0 / (4.0 * std::numbers::pi); });
  expected.push_back(0.0);
  expect_counts(observed, expected, "uniform directions");
}

}  // namespace
}  // namespace ppm::statistics
