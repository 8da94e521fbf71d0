// Curves over seeds, crops and exposures.
#include "analysis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "image.hpp"

namespace ppm::compare {
namespace {

/// A run whose RMSE falls as `scale` * seconds^power at 1, 2, 4 and 8 s.
SeedResult seed_result(double scale, double power) {
  SeedResult seed;
  for (double seconds = 1.0; seconds <= 8.0; seconds *= 2.0) {
    KeptPicture picture;
    picture.seconds = seconds;
    seed.record.pictures.push_back(picture);
    Errors errors;
    errors.rmse = scale * std::pow(seconds, power);
    errors.relative_mse = errors.rmse * errors.rmse;
    errors.mean = {scale, 0.0, 0.0};
    errors.mean_difference = {scale - 2.0, 0.0, 0.0};
    seed.errors.push_back(errors);
  }
  return seed;
}

TEST(CompareAnalysis, MediansAreOverSeeds) {
  MethodResult result;
  result.seeds = {seed_result(1.0, -0.5), seed_result(2.0, -0.25), seed_result(9.0, -0.125)};
  summarise(result, {});
  EXPECT_NEAR(result.rmse_slope.value(), -0.25, 1e-12);
  EXPECT_NEAR(result.relative_slope.value(), -0.5, 1e-12);
  EXPECT_NEAR(result.rmse, 2.0 * std::pow(8.0, -0.25), 1e-12);
  ASSERT_EQ(result.rmse_curve.size(), 4u);
  EXPECT_EQ(result.rmse_curve[0].x, 1.0);
  EXPECT_EQ(result.rmse_curve[0].y, 2.0);
  EXPECT_DOUBLE_EQ(result.mean[0].mean, 4.0);
  EXPECT_DOUBLE_EQ(result.mean_difference[0].mean, 2.0);
  EXPECT_DOUBLE_EQ(result.mean_difference[0].standard_error, std::sqrt((9.0 + 4.0 + 25.0) / 6.0));
  EXPECT_FALSE(result.noise);
}

TEST(CompareAnalysis, LightThatAMethodMissesIsAShareOfTheReferences) {
  MethodResult result;
  EXPECT_EQ(share_of_light(result), 1.0);
  // The reference has 2, 4 and 2; the method 1, 1 and 2.
  result.mean = {Estimate{1.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  result.mean_difference = {Estimate{-1.0, 0.0}, {-3.0, 0.0}, {0.0, 0.0}};
  EXPECT_DOUBLE_EQ(share_of_light(result), 0.5);
}

TEST(CompareAnalysis, CurvesOfDifferentLengthMeetAtTheirEnds) {
  const std::vector<Sample> curve =
      median_curve({{{1.0, 8.0}, {2.0, 4.0}, {4.0, 2.0}}, {{2.0, 6.0}, {5.0, 3.0}}});
  ASSERT_EQ(curve.size(), 2u);
  EXPECT_EQ(curve[0].x, 2.0);
  EXPECT_EQ(curve[0].y, 5.0);
  EXPECT_EQ(curve[1].x, 4.5);
  EXPECT_EQ(curve[1].y, 2.5);
  EXPECT_TRUE(median_curve({}).empty());
}

TEST(CompareAnalysis, CropsAreWhereMethodsDiffer) {
  constexpr std::uint32_t kWidth = 96, kHeight = 64;
  std::vector<float> a(kWidth * kHeight, 0.1f), b = a;
  for (std::uint32_t y = 40; y < 56; ++y) {
    for (std::uint32_t x = 64; x < 80; ++x) b[y * kWidth + x] = 1.0f;
  }
  b[0] = 1e30f;  // one pixel, however wrong, does not decide
  const std::vector<Crop> crops = crops_of_interest({a, b}, kWidth, kHeight, 3);
  ASSERT_EQ(crops.size(), 3u);
  EXPECT_EQ(crops[0].x, 64u);
  EXPECT_EQ(crops[0].y, 40u);
  EXPECT_EQ(crops[0].width, 16u);
  for (const Crop& crop : crops) {
    EXPECT_LE(crop.x + crop.width, kWidth);
    EXPECT_LE(crop.y + crop.height, kHeight);
  }
  // Pictures smaller than a crop, and a single method.
  EXPECT_EQ(crops_of_interest({std::vector<float>(12, 1.0f)}, 4, 3, 3).size(), 1u);
}

TEST(CompareAnalysis, ExposureShowsNineTenthsBelowWhite) {
  std::vector<float> rgb;
  for (int i = 1; i <= 1000; ++i) {
    for (int channel = 0; channel < 3; ++channel) rgb.push_back(1e-3f * static_cast<float>(i));
  }
  for (float& value : rgb) value *= 0x1p-10f;
  const double exposure = suitable_exposure(rgb);
  EXPECT_NEAR(exposure, 10.0 - std::log2(0.9 / 0.8), 0.06);
  const auto white = std::count_if(rgb.begin(), rgb.end(), [&](float value) {
    return image::srgb_byte(value, exposure) == 255;
  });
  EXPECT_LT(white, 300);
  EXPECT_EQ(suitable_exposure(std::vector<float>(30, 0.0f)), 0.0);
  EXPECT_EQ(suitable_exposure({}), 0.0);
}

}  // namespace
}  // namespace ppm::compare
