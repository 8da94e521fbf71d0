// Medians and their kin against values worked out by hand.
#include "statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ppm::bench {
namespace {

TEST(BenchStatistics, MedianIsInTheMiddleWhateverTheOrder) {
  EXPECT_EQ(median({7.0}), 7.0);
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_EQ(median({1.0, 1e9, 2.0, -1e9, 3.0}), 2.0);  // outliers do not move it
}

TEST(BenchStatistics, DeviationsOfOneToFive) {
  const std::vector<double> values = {5.0, 1.0, 4.0, 2.0, 3.0};
  EXPECT_EQ(mean(values), 3.0);
  EXPECT_NEAR(standard_deviation(values), std::sqrt(2.5), 1e-15);  // (4+1+0+1+4) / 4
  EXPECT_EQ(median_absolute_deviation(values), 1.0);               // of 2, 1, 0, 1, 2
  EXPECT_EQ(least(values), 1.0);
  EXPECT_EQ(most(values), 5.0);
}

TEST(BenchStatistics, MedianAbsoluteDeviationIgnoresAnOutlier) {
  EXPECT_EQ(median_absolute_deviation({1.0, 2.0, 3.0, 4.0, 1000.0}), 1.0);
  EXPECT_EQ(median_absolute_deviation({6.0, 6.0, 6.0, 100.0}), 0.0);
}

TEST(BenchStatistics, OneValueHasNoSpread) {
  EXPECT_EQ(standard_deviation({3.0}), 0.0);
  EXPECT_EQ(median_absolute_deviation({3.0}), 0.0);
}

TEST(BenchStatisticsDeathTest, NoValuesAreAProgrammersMistake) {
  EXPECT_DEATH(median({}), "no values");
  EXPECT_DEATH(mean({}), "no values");
}

}  // namespace
}  // namespace ppm::bench
