// bsdf_sample, its densities and weights, for every row of the table.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bsdf_table.hpp"
#include "chi_squared.hpp"
#include "shared/bsdf.h"

namespace ppm::shared {
namespace {

using glm::dvec3;
using statistics::BsdfRow;
using statistics::DirectionChart;
using statistics::Units;
constexpr int kSamples = 100000;

class BsdfSampling : public ::testing::TestWithParam<BsdfRow> {
 protected:
  const Bsdf& bsdf() const { return GetParam().bsdf; }
};

std::string at(const BsdfRow& row, vec3 wo) {
  return row.name + " from cosine " + std::to_string(wo.z);
}

// What draws of one direction come to: counts by cell of the charts above and below the surface,
// then absorbed, reflected and transmitted; and the mean of the non-specular weight.
struct Draws {
  std::vector<double> observed, expected;
  std::array<statistics::Moments, 3> weight;
};

// Densities are floats and the quadrature is good to about 1e-5; where facets bend light they are
// met no more beyond a certain angle, and reflect all beyond another, and kinks cost some digits.
double density_slack(const Bsdf& bsdf) {
  return has_rough_glass(bsdf) ? 1e-3 : 3e-5;
}

// Expected: the density's integral over each cell; the probabilities that specular samples report.
Draws draw(const Bsdf& bsdf, vec3 wo, Units& units) {
  const DirectionChart above = statistics::chart_for(bsdf, wo);
  const DirectionChart under = statistics::chart_below(bsdf, wo);
  Draws draws;
  const auto density = [&](dvec3 wi) {
    return kSamples * double(bsdf_pdf_solid_angle(bsdf, wo, vec3(wi)));
  };
  draws.expected = above.integrate_cells(density);
  if (has_rough_glass(bsdf)) {
    const auto more =
        under.integrate_cells([&](dvec3 wi) { return density(statistics::below(wi)); });
    draws.expected.insert(draws.expected.end(), more.begin(), more.end());
  }
  const std::size_t absorbed = draws.expected.size();
  draws.expected.resize(absorbed + 3, 0.0);
  draws.observed.assign(absorbed + 3, 0.0);
  for (int i = 0; i < kSamples; ++i) {
    const BsdfSample sample = bsdf_sample(bsdf, wo, units.next3(), PPM_TRANSPORT_FLUX);
    std::size_t bin = absorbed;
    if (sample.specular == 1u) {
      bin = absorbed + 1 + sample.transmission;
      draws.expected[bin] = kSamples * double(sample.forward_pdf_solid_angle);
    } else if (sample.wi.z > 0.0f) {
      bin = above.bin(sample.wi);
    } else if (sample.wi.z < 0.0f) {
      bin = above.bins() - 1 + under.bin(statistics::below(sample.wi));
    }
    ++draws.observed[bin];
    for (int c = 0; c < 3; ++c) {
      const double weight = sample.specular == 1u ? 0.0 : double(sample.weight[c]);
      draws.weight[static_cast<std::size_t>(c)].add(weight);
    }
  }
  double rest = kSamples;
  for (const double count : draws.expected) rest -= count;
  // More means it is no density.
  const double slack = density_slack(bsdf) * kSamples;
  EXPECT_GT(rest, -slack);
  draws.expected[absorbed] = rest > 3e-5 * kSamples ? rest : 0.0;
  return draws;
}

// Sampling follows the density, and the mean weight is the albedo that quadrature of f cos gives:
// between them sample, density and value are tied together.
TEST_P(BsdfSampling, SamplesFollowTheDensityAndWeighTheAlbedo) {
  Units units(81);
  for (const vec3& wo : statistics::outgoing_directions()) {
    Draws draws = draw(bsdf(), wo, units);
    // Rounding may lay a handful of grazing samples on the horizon where none are expected.
    const std::size_t absorbed = draws.observed.size() - 3;
    if (draws.expected[absorbed] == 0.0) {
      EXPECT_LE(draws.observed[absorbed], density_slack(bsdf()) * kSamples) << at(GetParam(), wo);
      draws.observed[absorbed] = 0.0;
    }
    statistics::expect_counts(draws.observed, draws.expected, at(GetParam(), wo));
    const dvec3 albedo = statistics::non_specular_albedo(bsdf(), wo);
    for (int c = 0; c < 3; ++c) {
      statistics::expect_mean(draws.weight[static_cast<std::size_t>(c)], albedo[c],
                              has_rough_glass(bsdf()) ? 2e-4 : 1e-5, at(GetParam(), wo));
    }
  }
}

// How far values may lie from exact ones, as a share of them. The half vector's components are
// rounded by about 2^-24, which shifts a peak of width alpha by 2^-24 / alpha of itself and changes
// the distribution by up to four times that; where both directions graze on opposite sides their
// sum is short, which multiplies the rounding. The coat lets 1 - F pass, rounded by 2^-24 or so,
// and no less than a grazing cosine. The rest is two dozen roundings.
double value_tolerance(const Bsdf& bsdf, dvec3 wo, dvec3 wi) {
  const bool bends = wi.z < 0.0 && bsdf.thin_ior == 0.0f;
  const dvec3 there = wi.z < 0.0 && !bends ? statistics::below(wi) : wi;
  const double eta = bends ? double(bsdf.eta) : 1.0;
  const dvec3 h = wo + eta * there;
  const double gloss = 4.0 * (1.0 + eta) * 0x1p-24 / glm::length(h);
  double tolerance = 3e-6 + 4.0 * 0x1p-24 / std::min(wo.z, std::abs(wi.z));
  if (bsdf.glossy.alpha > 0.0f) tolerance += gloss / bsdf.glossy.alpha;
  if (has_rough_clearcoat(bsdf)) tolerance += gloss / bsdf.coat.alpha;
  if (has_rough_glass(bsdf)) {
    // What a facet transmits goes with its cosines on either side, to which 1 - F is proportional
    // as well, a difference of numbers near 1: digits go where either grazes, one of them where
    // total reflection begins.
    const double cosine = glm::dot(wo, h) / glm::length(h);
    const double index = bsdf.thin_ior > 0.0f ? double(bsdf.thin_ior) : double(bsdf.eta);
    const double cos2 = std::abs(1.0 - (1.0 - cosine * cosine) / (index * index));
    tolerance += 16.0 * 0x1p-24 * (1.0 / std::max(cos2, 1e-9) + 1.0 / (cosine * cosine)) + gloss;
  }
  return tolerance;
}

// Each sample's own numbers: weight = f cos / density with f from independent double precision, and
// the densities of both senses as bsdf_pdf_solid_angle tells them.
TEST_P(BsdfSampling, WeightsAndDensitiesAreConsistent) {
  Units units(82);
  for (const vec3& wo : statistics::outgoing_directions()) {
    for (int i = 0; i < 20000; ++i) {
      const BsdfSample sample = bsdf_sample(bsdf(), wo, units.next3(), PPM_TRANSPORT_RADIANCE);
      if (sample.specular == 1u || sample.wi == vec3(0.0f)) continue;
      ASSERT_NEAR(length(sample.wi), 1.0f, 2e-6f);
      ASSERT_EQ(sample.wi.z < 0.0f, sample.transmission == 1u);
      ASSERT_TRUE(sample.transmission == 0u || has_rough_glass(bsdf()));
      const float forward = bsdf_pdf_solid_angle(bsdf(), wo, sample.wi);
      ASSERT_EQ(sample.forward_pdf_solid_angle, forward);
      const float reverse =
          sample.transmission == 0u
              ? bsdf_pdf_solid_angle(bsdf(), sample.wi, wo)
              : bsdf_pdf_solid_angle(GetParam().other_side(), vec3(statistics::below(sample.wi)),
                                     vec3(statistics::below(wo)));
      ASSERT_EQ(sample.reverse_pdf_solid_angle, reverse);
      const dvec3 f = statistics::reference_eval(bsdf(), wo, sample.wi);
      const double tolerance = value_tolerance(bsdf(), wo, sample.wi);
      for (int c = 0; c < 3; ++c) {
        const double weight = f[c] * std::abs(double(sample.wi.z)) / forward;
        ASSERT_NEAR(sample.weight[c], weight, tolerance * weight)
            << at(GetParam(), wo) << " to " << sample.wi.z;
      }
    }
  }
}

// f(o, i) = f(i, o), and its value is the reference's. Directions down to 3 degrees of grazing. The
// sense changes the order of some sums, and the cosine to the half vector by two of its roundings,
// of which Schlick's term makes 6 times as much.
TEST_P(BsdfSampling, ValuesAreReciprocalAndRight) {
  Units units(83);
  const float alpha = bsdf().glossy.alpha;
  for (int i = 0; i < 20000; ++i) {
    vec3 wo = units.direction();
    vec3 wi = units.direction();
    wo.z = std::abs(wo.z);
    wi.z = std::abs(wi.z);
    if (i % 2 == 0) wi = normalize(vec3(-wo.x, -wo.y, wo.z) + wi * alpha);  // within the lobe
    if (wo.z < 0.05f || wi.z < 0.05f) continue;
    const vec3 value = bsdf_eval(bsdf(), wo, wi);
    const vec3 swapped = bsdf_eval(bsdf(), wi, wo);
    const dvec3 reference = statistics::reference_eval(bsdf(), wo, wi);
    const double tolerance = value_tolerance(bsdf(), wo, wi);
    float swap_tolerance = 2e-6f + 24.0f * 0x1p-24f / length(wo + wi);
    if (has_rough_glass(bsdf())) swap_tolerance += static_cast<float>(tolerance);
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(value[c], swapped[c], swap_tolerance * value[c]) << GetParam().name;
      ASSERT_NEAR(value[c], reference[c], tolerance * reference[c]) << GetParam().name;
    }
  }
}

// What bends light: f(o, i) eta^2 = f'(i, o), f' being of the surface met from beyond [Veach 1997,
// section 5.2]; and its value is the reference's. Half of the directions are facets' refractions,
// so that rare ones are met, too.
TEST_P(BsdfSampling, TransmissionIsReciprocalAndRight) {
  if (!has_rough_glass(bsdf())) return;
  Units units(84);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    vec3 wo = units.direction();
    wo.z = std::abs(wo.z);
    vec3 wi = units.direction();
    wi.z = -std::abs(wi.z);
    if (i % 2 == 0) {
      uint transmits;
      wi = rough_dielectric_sample(rough_glass(bsdf()), 1.0f, wo, units.next3(), transmits);
    }
    if (wo.z < 0.05f || wi.z > -0.05f) continue;
    const vec3 value = bsdf_eval(bsdf(), wo, wi);
    const vec3 swapped = bsdf_eval(GetParam().other_side(), vec3(statistics::below(wi)),
                                   vec3(statistics::below(wo)));
    const dvec3 reference = statistics::reference_eval(bsdf(), wo, wi);
    const double tolerance = value_tolerance(bsdf(), wo, wi);
    const double eta2 = double(bsdf().eta) * bsdf().eta;
    met += reference.x > 0.0 ? 1 : 0;
    for (int c = 0; c < 3; ++c) {
      const double larger = std::max(value[c] * eta2, double(swapped[c]));
      ASSERT_NEAR(value[c] * eta2, swapped[c], 2.0 * tolerance * larger + 1e-12);
      ASSERT_NEAR(value[c], reference[c], tolerance * reference[c] + 1e-12) << GetParam().name;
    }
  }
  EXPECT_EQ(met > 2000, max_component(bsdf().glass_tint) > 0.0f);
}

// Nothing below the surface but for rough glass, and no samples from there.
TEST_P(BsdfSampling, HasNoValueBelowTheSurface) {
  const vec3 up = normalize(vec3(0.3f, 0.1f, 0.8f));
  const vec3 down = normalize(vec3(0.3f, 0.1f, -0.8f));
  for (const auto& [wo, wi] : {std::pair(up, down), std::pair(down, up), std::pair(down, down)}) {
    if (wo.z > 0.0f && has_rough_glass(bsdf())) continue;
    EXPECT_EQ(bsdf_eval(bsdf(), wo, wi), vec3(0.0f));
    EXPECT_EQ(bsdf_pdf_solid_angle(bsdf(), wo, wi), 0.0f);
  }
  const BsdfSample sample = bsdf_sample(bsdf(), down, vec3(0.5f), PPM_TRANSPORT_FLUX);
  EXPECT_EQ(sample.wi, vec3(0.0f));
  EXPECT_EQ(sample.weight, vec3(0.0f));
}

// The ends of the random interval may not break anything: finite weights, unit directions.
TEST_P(BsdfSampling, CopesWithTheEndsOfTheInterval) {
  for (const vec3& wo : statistics::outgoing_directions()) {
    for (int corner = 0; corner < 27; ++corner) {
      const std::array<float, 3> ends{0.0f, 0.5f, 1.0f - 0x1p-24f};
      const auto end = [&](int i) { return ends[static_cast<std::size_t>(i % 3)]; };
      const vec3 u(end(corner), end(corner / 3), end(corner / 9));
      for (const uint transport : {PPM_TRANSPORT_RADIANCE, PPM_TRANSPORT_FLUX}) {
        const BsdfSample sample = bsdf_sample(bsdf(), wo, u, transport);
        EXPECT_TRUE(is_finite3(sample.wi) && is_finite3(sample.weight)) << at(GetParam(), wo);
        EXPECT_TRUE(is_finite(sample.forward_pdf_solid_angle));
        EXPECT_TRUE(is_finite(sample.reverse_pdf_solid_angle));
        const bool absorbed = sample.wi == vec3(0.0f);
        EXPECT_NEAR(length(sample.wi), absorbed ? 0.0f : 1.0f, 2e-6f);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, BsdfSampling, ::testing::ValuesIn(statistics::bsdf_table()),
                         statistics::row_name);

}  // namespace
}  // namespace ppm::shared
