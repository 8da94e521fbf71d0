// What rough glass and coats keep of light, by integrals over facets instead of directions; and
// dispersion's numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <string>

#include "bsdf_table.hpp"
#include "direction_chart.hpp"
#include "shared/bsdf.h"
#include "shared/bsdf/dispersion.h"

namespace ppm::shared {
namespace {

using glm::dvec3;
using statistics::DirectionChart;

Bsdf rough_glass_of(float roughness, float eta, float thin_ior = 0.0f) {
  Bsdf bsdf{};
  bsdf.glossy.alpha = roughness * roughness;
  bsdf.glass = 1.0f;
  bsdf.glass_tint = vec3(1.0f);
  bsdf.eta = eta;
  bsdf.thin_ior = thin_ior;
  return bsdf;
}

// Light from wo that meets a visible facet of normal h (density G1 <o,h> D / cos_o) is reflected
// with Fresnel's F or refracted, and gets away with G2 / G1(o): the directional albedo, without any
// Jacobian of directions.
double facets_albedo(double alpha, double eta, dvec3 wo) {
  const auto lambda = [&](double z) {
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 / (z * z) - 1.0)) - 1.0);
  };
  const DirectionChart chart(dvec3(0, 0, 1), alpha, true);
  return chart.integrate_all([&](dvec3 h) {
    const double oh = glm::dot(wo, h);
    if (oh <= 0.0) return 0.0;
    const double d =
        alpha * alpha /
        (std::numbers::pi * std::pow(alpha * alpha * h.z * h.z + h.x * h.x + h.y * h.y, 2.0));
    const auto masking = [&](double cos_i) { return 1.0 / (1.0 + lambda(wo.z) + lambda(cos_i)); };
    double f = 1.0, transmitted = 0.0;
    const double cos2 = 1.0 - (1.0 - oh * oh) / (eta * eta);
    if (cos2 > 0.0) {
      const double ct = std::sqrt(cos2);
      const double parallel = (eta * oh - ct) / (eta * oh + ct);
      const double across = (oh - eta * ct) / (oh + eta * ct);
      f = 0.5 * (parallel * parallel + across * across);
      const double z = h.z * (oh / eta - ct) - wo.z / eta;
      if (z < 0.0) transmitted = (1.0 - f) * masking(z);
    }
    const double z = 2.0 * oh * h.z - wo.z;
    const double reflected = z > 0.0 ? f * masking(z) : 0.0;
    return oh * d / wo.z * (reflected + transmitted);
  });
}

// 1e-3: kinks where facets turn away and where total reflection begins, in both integrals.
TEST(RoughGlass, KeepsWhatItsFacetsLetGo) {
  for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
    for (const float eta : {1.5f, 1.0f / 1.5f, 1.33f, 1.0f / 2.4f}) {
      const Bsdf bsdf = rough_glass_of(roughness, eta);
      for (const vec3& wo : statistics::outgoing_directions()) {
        const double albedo = statistics::directional_albedo(bsdf, wo).x;
        const double expected = facets_albedo(bsdf.glossy.alpha, eta, wo);
        EXPECT_NEAR(albedo, expected, 1e-3) << roughness << " " << eta << " from cosine " << wo.z;
        EXPECT_LE(albedo, 1.0 + 1e-4);
        // Single scattering's loss: next to none where facets hardly tilt.
        if (roughness < 0.2f && wo.z > 0.1f) {
          EXPECT_GT(albedo, 0.995);
        }
      }
    }
  }
}

// A thin sheet is its own mirror: what it reflects and transmits makes up a white metal's lobe.
TEST(RoughGlass, SheetsShareTheMetalsLobe) {
  const Bsdf sheet = rough_glass_of(0.4f, 1.0f, 1.5f);
  const GgxLobe metal{vec3(1.0f), 1.0f, 0.16f};
  const vec3 wo = normalize(vec3(0.5f, 0.1f, 0.6f));
  for (const vec3& w : statistics::outgoing_directions()) {
    const vec3 sum = bsdf_eval(sheet, wo, w) + bsdf_eval(sheet, wo, vec3(w.x, w.y, -w.z));
    EXPECT_NEAR(sum.x, ggx_eval(metal, wo, w).x, 2e-6f * sum.x);
  }
}

// Nearly equal indices have no facets' normals: such an interface is smooth, from both sides.
TEST(RoughGlass, OfNearlyEqualIndicesIsSmooth) {
  EXPECT_FALSE(has_rough_glass(rough_glass_of(0.5f, 1.005f)));
  EXPECT_FALSE(has_rough_glass(rough_glass_of(0.5f, 1.0f / 1.005f)));
  EXPECT_FALSE(is_non_specular(rough_glass_of(0.5f, 1.0f)));
  EXPECT_TRUE(has_rough_glass(rough_glass_of(0.5f, 1.02f)));
  EXPECT_TRUE(has_rough_glass(rough_glass_of(0.5f, 1.0f / 1.02f)));
  EXPECT_GT(specular_lobes(rough_glass_of(0.5f, 1.005f), 0.5f).transmitted.x, 0.99f);
}

// What a coat costs lobes other than the diffuse: light that leaves at a lower angle than it came
// pays for that angle. Of a white lobe of roughness 0.5, seen from the normal, it is a few per
// cent; never does anything gain.
TEST(Clearcoat, TakesNoMoreThanItsMeanReflectance) {
  Bsdf bsdf{};
  bsdf.glossy = {vec3(1.0f), 1.0f, 0.25f};
  bsdf.eta = 1.0f;
  const vec3 up(0.0f, 0.0f, 1.0f);
  const double bare = statistics::directional_albedo(bsdf, up).x;
  bsdf.coat = {1.0f, 0.0f};
  const double coated = statistics::directional_albedo(bsdf, up).x;
  EXPECT_LT(coated, 0.04 + 0.96 * bare);
  EXPECT_GT(coated, 0.04 + (0.96 - 0.03) * bare);
}

// KHR_materials_dispersion: a material of index 1.5 and Abbe's number 20 (dispersion 1) spreads by
// (n - 1) / V = 0.025 between red and blue.
TEST(Dispersion, SpreadsByAbbesNumber) {
  EXPECT_FLOAT_EQ(dispersed_ior(1.5f, 1.0f, 0u), 1.4875f);
  EXPECT_FLOAT_EQ(dispersed_ior(1.5f, 1.0f, 1u), 1.5f);
  EXPECT_FLOAT_EQ(dispersed_ior(1.5f, 1.0f, 2u), 1.5125f);
  EXPECT_FLOAT_EQ(dispersed_ior(1.5f, 1.0f, PPM_ALL_CHANNELS), 1.5f);
  for (uint c = 0; c < 4u; ++c) EXPECT_EQ(dispersed_ior(1.7f, 0.0f, c), 1.7f);
  EXPECT_EQ(dispersed_ior(1.5f, 100.0f, 0u), 1.0f);
}

TEST(Dispersion, DrawsChannelsByTheirFlux) {
  const vec3 flux(0.5f, 0.25f, 1.25f);
  glm::dvec3 mean(0.0);
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const vec3 drawn = drawn_channel(flux, (static_cast<float>(i) + 0.5f) / kDraws);
    EXPECT_LT(channel_of(drawn), PPM_ALL_CHANNELS);
    mean += glm::dvec3(drawn) / double{kDraws};
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], flux[c], 2.0 / kDraws);
  const float last = 1.0f - 0x1p-24f;
  EXPECT_EQ(drawn_channel(vec3(1, 0, 0), last), vec3(1, 0, 0));
  EXPECT_EQ(drawn_channel(vec3(0, 2, 0), last), vec3(0, 2, 0));
  EXPECT_EQ(drawn_channel(vec3(0, 0, 2), 0.0f), vec3(0, 0, 2));
  EXPECT_EQ(drawn_channel(vec3(1, 2, 0), last), vec3(0, 3, 0));
  EXPECT_EQ(channel_of(vec3(1, 2, 0)), PPM_ALL_CHANNELS);
  EXPECT_EQ(channel_of(vec3(0, 0, 3)), 2u);
  EXPECT_EQ(in_channel(flux, 2u), vec3(0.0f, 0.0f, 1.25f));
}

}  // namespace
}  // namespace ppm::shared
