// shared/bsdf/ggx.h: what a distribution of microfacets must satisfy, whatever surface it is part
// of.
#include "shared/bsdf/ggx.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chi_squared.hpp"
#include "direction_chart.hpp"

namespace ppm::shared {
namespace {

using glm::dvec3;
using statistics::DirectionChart;
using statistics::Units;
constexpr double kPi = std::numbers::pi;

// Squares of the roughnesses 0.03 (the least that is no delta), 0.05, 0.1, 0.3, 0.6, 1.
const std::vector<float> kAlphas{0.0009f, 0.0025f, 0.01f, 0.09f, 0.36f, 1.0f};
const std::vector<float> kCosines{1.0f, 0.8f, 0.4f, 0.1f};

vec3 at_cosine(float cosine) {
  return {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine};
}

// Facets' normals gather around the surface's.
DirectionChart chart_of(float alpha) {
  return {dvec3(0.0, 0.0, 1.0), std::min(double(alpha), 1.0), true};
}

double g1(float alpha, vec3 w) {
  return 1.0 / (1.0 + double(ggx_lambda(alpha, w)));
}

TEST(Ggx, DistributionIsTheLiteratures) {
  for (const float alpha : kAlphas) {
    for (const double tangent : {0.0, 0.3, 1.0, 2.0, 20.0}) {
      const double t = tangent * alpha;
      const vec3 h = normalize(vec3(float(t), 0.0f, 1.0f));
      const double tan2 = double(h.x) * h.x / (double(h.z) * h.z), a2 = double(alpha) * alpha;
      const double walter = a2 / (kPi * std::pow(double(h.z), 4.0) * std::pow(a2 + tan2, 2.0));
      EXPECT_NEAR(ggx_distribution(alpha, h) / walter, 1.0, 2e-6) << alpha;
    }
  }
}

// Lambda of the cosine alone; at the normal nothing is masked.
TEST(Ggx, LambdaIsTheLiteratures) {
  for (const float alpha : kAlphas) {
    EXPECT_EQ(ggx_lambda(alpha, vec3(0, 0, 1)), 0.0f);
    for (const float cosine : {0.9f, 0.5f, 0.1f, 0.01f}) {
      const double tan2 = 1.0 / (double(cosine) * cosine) - 1.0;
      const double smith = 0.5 * (std::sqrt(1.0 + double(alpha) * alpha * tan2) - 1.0);
      // sqrt(1 + x) - 1 keeps 2^-24 absolutely.
      EXPECT_NEAR(ggx_lambda(alpha, at_cosine(cosine)), smith, 1e-7 + 2e-6 * smith);
    }
  }
}

// The facets' projected area is the surface's: integral of D cos = 1. 1e-5: values are floats.
TEST(Ggx, ProjectedDistributionIntegratesToOne) {
  for (const float alpha : kAlphas) {
    const double area = chart_of(alpha).integrate_all(
        [&](dvec3 h) { return double(ggx_distribution(alpha, vec3(h))) * h.z; });
    EXPECT_NEAR(area, 1.0, 1e-5) << alpha;
  }
}

// What is seen of the facets from w is what is seen of the surface: the integral of
// G1 <w, h> D is cos(w) [Heitz 2014, Eq. 14]. As the density of a reflection about a visible normal
// it is the weak white furnace: all light leaves, if no second facet takes it up.
TEST(Ggx, VisibleAreaIsTheSurfaces) {
  for (const float alpha : kAlphas) {
    for (const float cosine : kCosines) {
      const vec3 w = at_cosine(cosine);
      const double area = chart_of(alpha).integrate_all([&](dvec3 h) {
        const double facing = std::max(0.0, glm::dot(dvec3(w), h));
        return g1(alpha, w) * facing * double(ggx_distribution(alpha, vec3(h)));
      });
      // Where facets turn away (rough, grazing) the integrand has a kink, which costs some digits.
      EXPECT_NEAR(area / cosine, 1.0, 1e-4) << alpha << " " << cosine;
      const double furnace = chart_of(alpha).integrate_all([&](dvec3 h) {
        const double facing = glm::dot(dvec3(w), h);
        if (facing <= 1e-3) return 0.0;  // there w + wi is too short for floats
        const vec3 wi(2.0 * facing * h - dvec3(w));
        return 4.0 * facing * double(ggx_pdf_solid_angle(alpha, w, wi));
      });
      EXPECT_NEAR(furnace, 1.0, 1e-3) << alpha << " " << cosine;
    }
  }
}

// The normals about which ggx_sample reflects follow G1 <w, h> D / cos(w).
TEST(Ggx, SamplesVisibleNormals) {
  constexpr int kSamples = 200000;
  for (const float alpha : {0.0025f, 0.09f, 0.36f, 1.0f}) {
    const DirectionChart chart = chart_of(alpha);
    for (const float cosine : kCosines) {
      const vec3 w = at_cosine(cosine);
      Units units(101);
      std::vector<double> observed(chart.bins(), 0.0);
      for (int i = 0; i < kSamples; ++i) {
        const dvec3 wi = ggx_sample(alpha, w, units.next2());
        ++observed[chart.bin(glm::normalize(dvec3(w) + wi))];
      }
      std::vector<double> expected = chart.integrate_cells([&](dvec3 h) {
        const double facing = std::max(0.0, glm::dot(dvec3(w), h));
        return kSamples * g1(alpha, w) * facing / cosine * double(ggx_distribution(alpha, vec3(h)));
      });
      expected.push_back(0.0);
      statistics::expect_counts(observed, expected,
                                std::to_string(alpha) + " from cosine " + std::to_string(cosine));
    }
  }
}

}  // namespace
}  // namespace ppm::shared
