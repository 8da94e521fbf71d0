// Errors, spreads and slopes against what they are in closed form.
#include "metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace ppm::compare {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Metrics, ErrorsOfTwoPixels) {
  const std::vector<float> reference = {1.0f, 2.0f, 0.0f, 1.0f, 2.0f, 4.0f};
  const std::vector<float> picture = {2.0f, 2.0f, 0.0f, 1.0f, 0.0f, 7.0f};
  // Mean of the reference: (1 + 2 + 0 + 1 + 2 + 4) / 6 = 10 / 6.
  const double epsilon = relative_epsilon(reference);
  EXPECT_DOUBLE_EQ(epsilon, 0.01 * 100.0 / 36.0);
  const Errors errors = errors_of(picture, reference, epsilon);
  EXPECT_DOUBLE_EQ(errors.rmse, std::sqrt((1.0 + 4.0 + 9.0) / 6.0));
  EXPECT_DOUBLE_EQ(errors.relative_mse,
                   (1.0 / (1.0 + epsilon) + 4.0 / (4.0 + epsilon) + 9.0 / (16.0 + epsilon)) / 6.0);
  EXPECT_EQ(errors.mean, (Rgb{1.5, 1.0, 3.5}));
  EXPECT_EQ(errors.mean_difference, (Rgb{0.5, -1.0, 1.5}));
  EXPECT_EQ(errors.left_out, 0u);

  const std::vector<float> map = relative_error_map(picture, reference, epsilon);
  ASSERT_EQ(map.size(), 2u);
  EXPECT_FLOAT_EQ(map[0], static_cast<float>(std::sqrt(1.0 / (1.0 + epsilon) / 3.0)));
  EXPECT_FLOAT_EQ(map[1], static_cast<float>(
                              std::sqrt((4.0 / (4.0 + epsilon) + 9.0 / (16.0 + epsilon)) / 3.0)));
}

TEST(Metrics, TheSamePictureHasNoErrorAndScaleDoesNotMatterToRelativeOnes) {
  const std::vector<float> reference = {1.0f, 2.0f, 0.5f}, picture = {1.5f, 2.0f, 0.25f};
  const Errors none = errors_of(reference, reference, relative_epsilon(reference));
  EXPECT_EQ(none.rmse, 0.0);
  EXPECT_EQ(none.relative_mse, 0.0);
  std::vector<float> bright = reference, bright_picture = picture;
  for (float& value : bright) value *= 1024.0f;
  for (float& value : bright_picture) value *= 1024.0f;
  const Errors errors = errors_of(picture, reference, relative_epsilon(reference));
  const Errors scaled = errors_of(bright_picture, bright, relative_epsilon(bright));
  EXPECT_NEAR(scaled.relative_mse, errors.relative_mse, 1e-12);
  EXPECT_NEAR(scaled.rmse, 1024.0 * errors.rmse, 1e-9);
}

TEST(Metrics, WhatIsNotFiniteIsLeftOutAndCounted) {
  const std::vector<float> reference = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, kNan};
  const std::vector<float> picture = {kNan, 2.0f, 1.0f, 1.0f, 1.0f, 1.0f};
  const Errors errors = errors_of(picture, reference, relative_epsilon(reference));
  EXPECT_EQ(errors.left_out, 2u);
  EXPECT_DOUBLE_EQ(errors.rmse, std::sqrt(1.0 / 4.0));
  EXPECT_EQ(errors.mean_difference, (Rgb{0.0, 0.5, 0.0}));
  const std::vector<float> map = relative_error_map(picture, reference, 0.01);
  EXPECT_TRUE(std::isnan(map[0]) && std::isnan(map[1]));
}

TEST(Metrics, TheWorstThousandthIsTrimmed) {
  // 2000 pixels: two are left out, whatever they are.
  const std::vector<float> reference(6000, 1.0f);
  std::vector<float> picture(6000, 1.1f);
  for (std::size_t i = 0; i < 6; ++i) picture[600 + i] = 1e9f;
  const double epsilon = relative_epsilon(reference);
  const Errors errors = errors_of(picture, reference, epsilon);
  EXPECT_NEAR(errors.trimmed_relative_mse, 0.01 / 1.01, 1e-6);
  EXPECT_GT(errors.relative_mse, 1e12);
  for (std::size_t i = 0; i < 3; ++i) picture[3000 + i] = 2.0f;  // a third one counts
  EXPECT_NEAR(errors_of(picture, reference, epsilon).trimmed_relative_mse,
              (1997.0 * 0.01 + 1.0) / 1998.0 / 1.01, 1e-6);
}

TEST(Metrics, ABlackReferenceHasNoRelativeError) {
  const std::vector<float> reference(6, 0.0f), picture(6, 0.5f);
  EXPECT_EQ(relative_epsilon(reference), 0.0);
  const Errors errors = errors_of(picture, reference, 0.0);
  EXPECT_EQ(errors.relative_mse, 0.0);
  EXPECT_DOUBLE_EQ(errors.rmse, 0.5);
}

TEST(Metrics, SlopesOfPowerLaws) {
  for (const double power : {-0.5, -1.0 / 3.0, 0.0, 1.5}) {
    std::vector<Sample> points;
    for (double x = 0.25; x < 100.0; x *= 2.0) points.push_back({x, 7.0 * std::pow(x, power)});
    EXPECT_NEAR(log_log_slope(points).value(), power, 1e-12);
    points.push_back({0.0, 1.0});  // not on logarithmic axes
    points.push_back({1.0, -1.0});
    EXPECT_NEAR(log_log_slope(points).value(), power, 1e-12);
  }
  // Three points by hand, natural logarithms 0, 1, 2 and 0, 0, 3: slope 3 / 2.
  const double e = std::exp(1.0);
  const std::vector<Sample> bent = {{1.0, 1.0}, {e, 1.0}, {e * e, e * e * e}};
  EXPECT_NEAR(log_log_slope(bent).value(), 1.5, 1e-12);
  EXPECT_FALSE(log_log_slope(std::vector<Sample>{{1.0, 1.0}}));
  EXPECT_FALSE(log_log_slope(std::vector<Sample>{{2.0, 1.0}, {2.0, 3.0}}));
}

TEST(Metrics, MediansAndEstimates) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
  const std::vector<double> values = {1.0, 2.0, 3.0, 6.0};
  const Estimate result = estimate(values);
  EXPECT_DOUBLE_EQ(result.mean, 3.0);
  EXPECT_DOUBLE_EQ(result.standard_error, std::sqrt((4.0 + 1.0 + 0.0 + 9.0) / (4.0 * 3.0)));
  EXPECT_EQ(estimate(std::vector<double>{5.0}).standard_error, 0.0);
}

TEST(Metrics, PicturesOfSeveralSeeds) {
  PictureMean mean;
  for (const float value : {1.0f, 2.0f, 6.0f}) {
    mean.add(std::vector<float>{value, 2.0f * value, 5.0f});
  }
  EXPECT_EQ(mean.mean(), (std::vector<float>{3.0f, 6.0f, 5.0f}));
  // Squared deviations 4 + 1 + 9 = 14: variance 7, of the mean 7 / 3.
  const std::vector<float> error = mean.standard_error();
  EXPECT_FLOAT_EQ(error[0], std::sqrt(7.0f / 3.0f));
  EXPECT_FLOAT_EQ(error[1], std::sqrt(28.0f / 3.0f));
  EXPECT_EQ(error[2], 0.0f);
  EXPECT_NEAR(mean.mean_variance(), (7.0 + 28.0 + 0.0) / 3.0, 1e-12);
  PictureMean one;
  one.add(std::vector<float>{1.0f, 1.0f, 1.0f});
  EXPECT_EQ(one.standard_error(), (std::vector<float>{0.0f, 0.0f, 0.0f}));
  EXPECT_EQ(one.mean_variance(), 0.0);
}

// Mean square error = variance + squared bias: what the table tells apart.
TEST(Metrics, NoiseAndBiasAddUpToTheError) {
  constexpr double kNoise = 0.3, kBias = 0.4;
  constexpr int kSeeds = 16;
  constexpr std::size_t kValues = 30000;
  std::mt19937 random(1);
  std::normal_distribution<double> normal(kBias, kNoise);
  const std::vector<float> reference(kValues, 1.0f);
  PictureMean mean;
  double squares = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::vector<float> picture(kValues);
    for (float& value : picture) value = static_cast<float>(1.0 + normal(random));
    mean.add(picture);
    squares += std::pow(errors_of(picture, reference, 0.01).rmse, 2.0) / kSeeds;
  }
  // 480 000 values: relative standard error of a variance sqrt(2 / 480 000) = 0.2 %; six of them.
  EXPECT_NEAR(mean.mean_variance(), kNoise * kNoise, 0.012 * kNoise * kNoise);
  EXPECT_NEAR(squares - mean.mean_variance(), kBias * kBias, 0.012 * kBias * kBias);
}

}  // namespace
}  // namespace ppm::compare
