// shared/fresnel.h against the textbook in double precision.
#include "shared/fresnel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ppm::shared {
namespace {

// By angles: Fresnel's sine and tangent formulas, which share nothing with the code under test.
double reference(double cosine, double eta) {
  const double incident = std::acos(cosine);
  const double sine = std::sin(incident) / eta;
  if (sine >= 1.0) return 1.0;
  const double refracted = std::asin(sine);
  if (incident < 1e-6) return std::pow((eta - 1.0) / (eta + 1.0), 2.0);
  const double perpendicular = std::sin(incident - refracted) / std::sin(incident + refracted);
  const double parallel = std::tan(incident - refracted) / std::tan(incident + refracted);
  return 0.5 * (perpendicular * perpendicular + parallel * parallel);
}

float fresnel(float cosine, float eta) {
  float unused;
  return fresnel_dielectric(cosine, eta, unused);
}

// sin^2 of the refracted angle is rounded by about e = 2^-23, the cosine therefore by e / cos, at
// most sqrt(e); F changes by less than 8 times that (2 dF/dcos of either polarisation, times eta).
double tolerance(double cos_transmitted) {
  const double e = 0x1p-23;
  return 4.0 * e + 8.0 * std::min(e / std::max(cos_transmitted, 1e-9), std::sqrt(e));
}

TEST(FresnelDielectric, EqualsTheTextbook) {
  for (const float eta :
       {1.0001f, 1.1f, 1.33f, 1.5f, 2.4f, 1.0f / 1.33f, 1.0f / 1.5f, 1.0f / 2.4f}) {
    for (int i = 1; i <= 1000; ++i) {
      const float cosine = static_cast<float>(i) / 1000.0f;
      float cos_transmitted;
      const float value = fresnel_dielectric(cosine, eta, cos_transmitted);
      ASSERT_NEAR(value, reference(cosine, eta), tolerance(cos_transmitted))
          << cosine << " " << eta;
      const double sine2 = (1.0 - double(cosine) * cosine) / (double(eta) * eta);
      if (sine2 < 1.0 - 1e-6) {
        ASSERT_NEAR(double(cos_transmitted) * cos_transmitted, 1.0 - sine2, 4e-7);  // Snell
      }
    }
  }
}

TEST(FresnelDielectric, NormalAndGrazingIncidence) {
  for (const float n : {1.2f, 1.5f, 2.0f, 0.5f}) {
    EXPECT_NEAR(fresnel(1.0f, n), std::pow((n - 1.0) / (n + 1.0), 2.0), 1e-7);
    EXPECT_EQ(fresnel(0.0f, n), 1.0f);
  }
}

TEST(FresnelDielectric, NothingIsReflectedWithoutAnInterface) {
  for (const float cosine : {0.01f, 0.3f, 1.0f}) EXPECT_NEAR(fresnel(cosine, 1.0f), 0.0f, 1e-7f);
}

// At tan(angle) = n the parallel part vanishes; of the other, (1 - n^2) / (1 + n^2) squared, half
// remains.
TEST(FresnelDielectric, ParallelPartVanishesAtBrewstersAngle) {
  for (const double n : {1.33, 1.5, 2.4}) {
    const double cosine = 1.0 / std::sqrt(1.0 + n * n);
    const double perpendicular = (1.0 - n * n) / (1.0 + n * n);
    EXPECT_NEAR(fresnel(float(cosine), float(n)), 0.5 * perpendicular * perpendicular, 3e-7);
  }
}

TEST(FresnelDielectric, ReflectsTotallyBeyondTheCriticalAngle) {
  for (const double n : {1.33, 1.5, 2.4}) {
    const double critical = std::sqrt(1.0 - 1.0 / (n * n));  // cosine inside
    float cos_transmitted = 7.0f;
    EXPECT_EQ(fresnel_dielectric(float(critical * 0.999), float(1.0 / n), cos_transmitted), 1.0f);
    EXPECT_EQ(cos_transmitted, 0.0f);
    EXPECT_LT(fresnel_dielectric(float(critical * 1.001), float(1.0 / n), cos_transmitted), 1.0f);
    EXPECT_GT(cos_transmitted, 0.0f);
  }
}

// Stokes: the same share is reflected in either sense, which the reversibility of paths rests on.
TEST(FresnelDielectric, IsTheSameFromEitherSide) {
  for (const float eta : {1.1f, 1.5f, 2.4f}) {
    for (int i = 1; i <= 1000; ++i) {
      const float cosine = static_cast<float>(i) / 1000.0f;
      float inside, back;
      const float out = fresnel_dielectric(cosine, eta, inside);
      ASSERT_NEAR(fresnel_dielectric(inside, 1.0f / eta, back), out, 2.0 * tolerance(cosine))
          << cosine;
      ASSERT_NEAR(back * back, cosine * cosine, 1e-6f);
    }
  }
}

// Reflection at the first face, and all that comes back after 1, 3, 5 ... reflections inside.
TEST(ThinSheet, SumsAllOrdersOfReflection) {
  for (const double r : {0.0, 0.04, 0.2, 0.5, 0.9, 0.99}) {
    double reflected = r, transmitted = 0.0, inside = 1.0 - r;
    for (int order = 0; order < 5000; ++order) {
      transmitted += inside * (1.0 - r);
      inside *= r;
      reflected += inside * (1.0 - r);
      inside *= r;
    }
    EXPECT_NEAR(thin_sheet_reflectance(float(r)), reflected, 2e-7) << r;
    EXPECT_NEAR(1.0 - thin_sheet_reflectance(float(r)), transmitted, 2e-7) << r;
    EXPECT_NEAR(transmitted, (1.0 - r) / (1.0 + r), 1e-12) << r;
  }
  EXPECT_EQ(thin_sheet_reflectance(1.0f), 1.0f);
}

TEST(SchlickWeight, IsTheFifthPower) {
  for (const float cosine : {0.0f, 0.1f, 0.5f, 0.9f, 1.0f}) {
    EXPECT_NEAR(schlick_weight(cosine), std::pow(1.0 - cosine, 5.0), 3e-7);
  }
  EXPECT_EQ(schlick_weight(1.0000001f), 0.0f);
  EXPECT_EQ(schlick_weight(-1e-7f), 1.0f);
}

}  // namespace
}  // namespace ppm::shared
