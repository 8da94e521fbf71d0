// shared/warp.h: every sampler against its density, and the density against what it should be.
#include "shared/warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chi_squared.hpp"
#include "grid_counts.hpp"

namespace ppm::shared {
namespace {

using glm::dvec2;
using glm::dvec3;
using statistics::expect_density;
using statistics::Rectangles;
using statistics::Units;
constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 1000000;

// In [-pi, pi): a direction rounded to the axis has signed zeros that make +pi.
double azimuth(double y, double x) {
  return std::min(std::atan2(y, x), kPi * (1.0 - 1e-12));
}

// Cosine and azimuth: an area of the rectangle is a solid angle.
dvec2 cylinder(dvec3 w) {
  return {w.z, azimuth(w.y, w.x)};
}

TEST(Sphere, SamplesFollowTheDensity) {
  Units units(21);
  const auto sample = [&] { return cylinder(sample_sphere(units.next2())); };
  expect_density(
      Rectangles{{-1.0, -kPi}, {1.0 + 1e-9, kPi}, 16, 8}, kSamples, sample,
      [](dvec2) { return sphere_pdf_solid_angle(); }, "sphere");
  EXPECT_NEAR(sphere_pdf_solid_angle(), 1.0 / (4.0 * kPi), 1e-8);
}

TEST(CosineHemisphere, SamplesFollowTheDensity) {
  Units units(22);
  const auto sample = [&] { return cylinder(sample_cosine_hemisphere(units.next2())); };
  expect_density(
      Rectangles{{0.0, -kPi}, {1.0 + 1e-9, kPi}, 16, 8}, kSamples, sample,
      [](dvec2 w) { return cosine_hemisphere_pdf_solid_angle(float(w.x)); }, "cosine");
  EXPECT_NEAR(cosine_hemisphere_pdf_solid_angle(0.6f), 0.6 / kPi, 1e-7);
  EXPECT_EQ(cosine_hemisphere_pdf_solid_angle(-0.1f), 0.0f);
}

TEST(Cone, SamplesFollowTheDensity) {
  for (const float cosine : {-0.3f, 0.0f, 0.5f, 0.99f}) {
    Units units(23);
    const auto sample = [&] { return cylinder(sample_cone(units.next2(), cosine)); };
    expect_density(
        Rectangles{{cosine, -kPi}, {1.0 + 1e-9, kPi}, 16, 8}, kSamples, sample,
        [&](dvec2) { return cone_pdf_solid_angle(cosine); }, "cone " + std::to_string(cosine));
  }
  EXPECT_NEAR(cone_pdf_solid_angle(-1.0f), sphere_pdf_solid_angle(), 1e-8);
}

// 1 - z^2 and the square root each round by 6e-8, the circle errs by 4e-7.
TEST(DirectionSamplers, YieldUnitVectors) {
  Units units(24);
  for (int i = 0; i < 100000; ++i) {
    const vec2 u = i == 0 ? vec2(0.0f) : i == 1 ? vec2(1.0f - 0x1p-24f) : units.next2();
    ASSERT_NEAR(length(sample_sphere(u)), 1.0f, 6e-7f);
    ASSERT_NEAR(length(sample_cosine_hemisphere(u)), 1.0f, 6e-7f);
    ASSERT_GT(sample_cosine_hemisphere(u).z, 0.0f);
    ASSERT_NEAR(length(sample_cone(u, 0.8f)), 1.0f, 6e-7f);
    ASSERT_GE(sample_cone(u, 0.8f).z, 0.8f);
    ASSERT_LE(length(sample_disc(u)), 1.0f + 5e-7f);
  }
}

// Squared radius and azimuth: the area is half the rectangle's.
TEST(Disc, SamplesFollowTheDensity) {
  Units units(25);
  const auto sample = [&] {
    const dvec2 p = sample_disc(units.next2());
    return dvec2(glm::dot(p, p), azimuth(p.y, p.x));
  };
  expect_density(
      Rectangles{{0.0, -kPi}, {1.0 + 1e-6, kPi}, 16, 8}, kSamples, sample,
      [](dvec2 p) { return p.x < 1.0 ? 0.5 * disc_pdf_area() : 0.0; }, "disc");
}

// Uniform: cells below the diagonal hold 2 / n^2 of the samples, cells on it half of that.
TEST(Triangle, SamplesAreUniform) {
  Units units(26);
  constexpr int kSide = 16;
  std::vector<double> observed(kSide * kSide, 0.0), expected(kSide * kSide, 0.0);
  for (int i = 0; i < kSamples; ++i) {
    const vec2 b = sample_triangle(units.next2());
    ASSERT_GE(std::min(b.x, b.y), 0.0f);
    ASSERT_LE(b.x + b.y, 1.0f);
    const int cell =
        std::min(int(b.x * kSide), kSide - 1) * kSide + std::min(int(b.y * kSide), kSide - 1);
    ++observed[static_cast<std::size_t>(cell)];
  }
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; x + y < kSide; ++y) {
      const double share = (x + y == kSide - 1 ? 1.0 : 2.0) / (kSide * kSide);
      expected[static_cast<std::size_t>(x * kSide + y)] = kSamples * share;
    }
  }
  statistics::expect_counts(observed, expected, "triangle");
}

// Newton's method on std::erf, in double.
double reference_inverse_erf(double x) {
  double y = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double miss =
        std::abs(x) < 0.5 ? std::erf(y) - std::abs(x) : (1.0 - std::abs(x)) - std::erfc(y);
    y -= miss * 0.5 * std::sqrt(kPi) * std::exp(y * y);
  }
  return std::copysign(y, x);
}

TEST(InverseErf, ErrsByLessThanItPromises) {
  Units units(27);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    float x = 2.0f * units.next() - 1.0f;
    if (i % 4 == 1) x = 1.0f - std::exp2(-24.0f * units.next()) * 0.5f;
    if (i % 4 == 2) x = std::exp2(-40.0f * units.next());
    if (x <= -1.0f || x >= 1.0f || x == 0.0f) continue;
    worst = std::max(worst, std::abs(inverse_erf(x) / reference_inverse_erf(x) - 1.0));
  }
  EXPECT_LT(worst, 4e-7);
  EXPECT_EQ(inverse_erf(0.0f), 0.0f);
}

struct Filter {
  uint kind;
  double radius;
  double (*distribution)(double);  // cumulative, on [-radius, radius]
  double tolerance;
};

double box(double x) {
  return x + 0.5;
}
double tent(double x) {
  return x < 0.0 ? 0.5 * (1.0 + x) * (1.0 + x) : 1.0 - 0.5 * (1.0 - x) * (1.0 - x);
}
double gaussian(double x) {
  const double whole = std::erf(3.0 / std::numbers::sqrt2);
  return 0.5 + 0.5 * std::erf(x / (0.5 * std::numbers::sqrt2)) / whole;
}

// The filter's distribution function undoes the sampler. An offset errs by about 1.2e-7 (box, tent:
// two roundings of numbers up to 1) or 1.5 * 4e-7 (Gaussian, its promise), times the density, which
// is at most 1.
const std::vector<Filter> kFilters{{PPM_FILTER_BOX, 0.5, box, 1.2e-7},
                                   {PPM_FILTER_TENT, 1.0, tent, 2e-7},
                                   {PPM_FILTER_GAUSSIAN, 1.5, gaussian, 5e-7}};

TEST(Filters, AreUndoneByTheirDistribution) {
  Units units(28);
  for (const Filter& filter : kFilters) {
    for (int i = 0; i < 200000; ++i) {
      float u = units.next();
      if (i == 0) u = 0.0f;
      if (i == 1) u = 1.0f - 0x1p-24f;
      if (i == 2) u = 0.5f;
      const double x = sample_filter(filter.kind, u);
      ASSERT_LE(std::abs(x), filter.radius * (1.0 + 1e-6)) << filter.kind;
      ASSERT_NEAR(filter.distribution(x), u, filter.tolerance) << filter.kind;
    }
  }
}

}  // namespace
}  // namespace ppm::shared
