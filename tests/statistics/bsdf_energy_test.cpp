// Energy, specular lobes and the packed form, for every row of the table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bsdf_table.hpp"
#include "chi_squared.hpp"
#include "shared/bsdf_record.h"

namespace ppm::shared {
namespace {

using glm::dvec3;
using statistics::BsdfRow;
using statistics::Units;

class BsdfEnergy : public ::testing::TestWithParam<BsdfRow> {
 protected:
  const Bsdf& bsdf() const { return GetParam().bsdf; }
};

std::vector<vec3> many_directions() {
  std::vector<vec3> result;
  for (int i = 1; i <= 20; ++i) {
    const double cosine = i / 20.0;
    result.emplace_back(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  }
  result.emplace_back(std::sqrt(1.0 - 1e-4), 0.0, 1e-2);
  return result;
}

// A base under a rough coat receives what a smooth coat would let through, while a rough coat
// reflects slightly more than a smooth one between 35 and 65 degrees: together up to 8.5e-4 too
// much (roughness 0.2, F0 = 0.04, cosine 0.55), a property of the model; a clearcoat of roughness
// 0.3 1.4e-3. All else errs by 1e-5 at most, which float densities and quadrature leave.
double energy_tolerance(const Bsdf& bsdf) {
  const bool coated_gloss = has_rough_gloss(bsdf) && max_component(bsdf.diffuse.albedo) > 0.0f;
  if (has_rough_clearcoat(bsdf)) return 1.4e-3;
  return coated_gloss ? 1e-3 : 1e-5;
}

// No surface gives back more light than it receives, from any direction; lossless ones all of it.
TEST_P(BsdfEnergy, IsConserved) {
  for (const vec3& wo : many_directions()) {
    const dvec3 albedo = statistics::directional_albedo(bsdf(), wo);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(albedo[c], 0.0);
      EXPECT_LE(albedo[c], 1.0 + energy_tolerance(bsdf()))
          << GetParam().name << " at cosine " << wo.z;
      if (GetParam().lossless) {
        EXPECT_NEAR(albedo[c], 1.0, 1e-5) << wo.z;
      }
    }
  }
}

// A mirror and glass in double precision, by angles (see fresnel_test.cpp for the formulas).
dvec3 reference_reflection(const Bsdf& bsdf, double cosine) {
  dvec3 result(0.0);
  const double glass = has_rough_glass(bsdf) ? 0.0 : double(bsdf.glass);
  if (bsdf.glossy.alpha == 0.0f) {
    const double weight = std::pow(1.0 - cosine, 5.0);
    result = dvec3(bsdf.glossy.f0) * (1.0 - weight) + double(bsdf.glossy.f90) * weight;
  }
  const double index = bsdf.thin_ior > 0.0f ? double(bsdf.thin_ior) : double(bsdf.eta);
  const double incident = std::acos(std::min(cosine, 1.0));
  const double sine = std::sin(incident) / index;
  double r = 1.0;
  if (sine < 1.0) {
    const double refracted = std::asin(sine);
    const double s = std::sin(incident - refracted) / std::sin(incident + refracted);
    const double t = std::tan(incident - refracted) / std::tan(incident + refracted);
    const double normal = (index - 1.0) / (index + 1.0);
    r = incident < 1e-3 ? normal * normal : 0.5 * (s * s + t * t);
  }
  if (bsdf.thin_ior > 0.0f) r = 2.0 * r / (1.0 + r);
  return result + glass * r;
}

double reference_coat(const Bsdf& bsdf, double cosine) {
  return double(bsdf.coat.strength) * (0.04 + 0.96 * std::pow(1.0 - cosine, 5.0));
}

// Reflection and transmission share out what Fresnel's equations say. 1e-5: see fresnel_test.cpp;
// none of these cosines lies within 1e-2 of a critical angle.
TEST_P(BsdfEnergy, SpecularLobesFollowFresnel) {
  for (const vec3& wo : many_directions()) {
    const SpecularLobes lobes = specular_lobes(bsdf(), wo.z);
    const double coat = reference_coat(bsdf(), wo.z);
    const dvec3 reflected = reference_reflection(bsdf(), wo.z) * (1.0 - coat) +
                            (bsdf().coat.alpha == 0.0f ? coat : 0.0);
    const double sine2 = (1.0 - double(wo.z) * wo.z) / (double(bsdf().eta) * bsdf().eta);
    const double least = std::min(double(wo.z), std::sqrt(std::max(1.0 - sine2, 0.0)));
    const double under = 1.0 - reference_coat(bsdf(), least);
    const double glass = has_rough_glass(bsdf()) ? 0.0 : double(bsdf().glass);
    Bsdf glass_alone = bsdf();
    glass_alone.glossy = GgxLobe{vec3(0.0f), 0.0f, 0.0f};
    glass_alone.glass = static_cast<float>(glass);
    const dvec3 from_glass = reference_reflection(glass_alone, wo.z);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(lobes.reflected[c], reflected[c], 1e-5) << wo.z;
      const double transmitted = under * bsdf().glass_tint[c] * (glass - from_glass[c]);
      EXPECT_NEAR(lobes.transmitted[c], transmitted, 1e-5) << wo.z;
    }
  }
}

BsdfSample reverse_of(const BsdfRow& row, vec3 wi, float u, uint transport) {
  const vec3 from_there(wi.x, wi.y, -wi.z);  // in the frame of the other side, mirrored
  return bsdf_sample(row.other_side(), from_there, vec3(u, 0.5f, 0.5f), transport);
}

// A specular sample carries its lobe over its probability, mirrors or obeys Snell's law, and can be
// walked backwards: the way back leads to wo, with the probability that was announced, and carries
// the same flux. As radiance it carries flux times the squared ratio of indices [Veach 1997,
// section 5.2]: radiance forward is flux backward over eta^2.
TEST_P(BsdfEnergy, SpecularSamplesAreReciprocal) {
  Units units(91);
  int transmitted = 0;
  for (int i = 0; i < 20000; ++i) {
    const vec3 wo = many_directions()[static_cast<std::size_t>(i % 21)];
    const float u = units.next();
    const BsdfSample flux = bsdf_sample(bsdf(), wo, vec3(u, 0.5f, 0.5f), PPM_TRANSPORT_FLUX);
    if (flux.specular == 0u) continue;
    const BsdfSample radiance =
        bsdf_sample(bsdf(), wo, vec3(u, 0.5f, 0.5f), PPM_TRANSPORT_RADIANCE);
    const SpecularLobes lobes = specular_lobes(bsdf(), wo.z);
    const float eta = flux.transmission == 1u ? bsdf().eta : 1.0f;
    const vec3 lobe = flux.transmission == 1u ? lobes.transmitted : lobes.reflected;
    ASSERT_LT(length(flux.weight * flux.forward_pdf_solid_angle - lobe), 1e-6f);
    ASSERT_LT(length(radiance.weight * (eta * eta) - flux.weight), 1e-5f * length(flux.weight));
    ASSERT_NEAR(length(flux.wi), 1.0f, 1e-6f);
    if (flux.transmission == 0u) {
      ASSERT_EQ(flux.wi, vec3(-wo.x, -wo.y, wo.z));
      ASSERT_EQ(flux.reverse_pdf_solid_angle, flux.forward_pdf_solid_angle);
      continue;
    }
    ++transmitted;
    ASSERT_LT(flux.wi.z, 0.0f);
    ASSERT_NEAR(flux.wi.x * eta, -wo.x, 1e-6f);
    // Transmission lies behind reflection in the choice's interval; its middle is found by halving.
    const SpecularLobes back_lobes = specular_lobes(GetParam().other_side(), -flux.wi.z);
    const LobeChoice choice = lobe_choice(GetParam().other_side(), back_lobes, -flux.wi.z);
    const float middle = choice.reflection + 0.5f * choice.transmission;
    const BsdfSample back = reverse_of(GetParam(), flux.wi, middle, PPM_TRANSPORT_FLUX);
    ASSERT_EQ(back.transmission, 1u);
    // Rounding of a refracted cosine is amplified by the ratio of sines where it grazes.
    const float slack = 1e-6f * (1.0f + 1.0f / wo.z);
    ASSERT_LT(length(vec3(back.wi.x, back.wi.y, -back.wi.z) - wo), slack);
    ASSERT_NEAR(flux.reverse_pdf_solid_angle, back.forward_pdf_solid_angle, 3.0f * slack)
        << GetParam().name << " at cosine " << wo.z;
    const vec3 there = flux.weight * flux.forward_pdf_solid_angle;
    const vec3 and_back = back.weight * back.forward_pdf_solid_angle;
    ASSERT_LT(length(there - and_back), 3.0f * slack);
  }
  EXPECT_EQ(transmitted > 0, bsdf().glass > 0.0f && !has_rough_glass(bsdf()));
}

INSTANTIATE_TEST_SUITE_P(Table, BsdfEnergy, ::testing::ValuesIn(statistics::bsdf_table()),
                         statistics::row_name);

// At the normal, of a grey surface of coat F0 = 0.04 under a rough gloss the diffuse part is
// (1 - F0) (1 - F_avg) / (1 - F_avg) of the albedo: (1 - F0) whatever the average.
TEST(CoatedDiffuse, AlbedoIsTheCoatsTransmittance) {
  Bsdf bsdf{};
  bsdf.diffuse = {vec3(0.8f, 0.4f, 1.0f), 0.04f, 1.0f};
  bsdf.eta = 1.0f;
  for (const vec3& wo : many_directions()) {
    const double transmittance = 0.96 * (1.0 - std::pow(1.0 - double(wo.z), 5.0));
    const dvec3 albedo = statistics::non_specular_albedo(bsdf, wo);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(albedo[c], bsdf.diffuse.albedo[c] * transmittance, 1e-5);
    }
  }
}

// A 16-bit unorm errs by half of 1/65535; the promise is 2^-16 a parameter.
TEST(PackBsdf, KeepsEveryParameter) {
  Units units(92);
  for (int i = 0; i < 100000; ++i) {
    Bsdf bsdf{};
    bsdf.diffuse = {units.next3(), units.next(), units.next()};
    const float roughness = PPM_DELTA_ROUGHNESS + (1.0f - PPM_DELTA_ROUGHNESS) * units.next();
    bsdf.glossy = {units.next3(), units.next(), roughness * roughness};
    bsdf.glass = units.next();
    bsdf.glass_tint = units.next3();
    bsdf.thin_ior = i % 2 == 0 ? 1.0f + units.next() : 0.0f;
    bsdf.eta = i % 2 == 0 ? 1.0f : 0.4f + 2.0f * units.next();
    bsdf.coat = {units.next(), square(units.next())};
    uvec4 words;
    uint extra;
    pack_bsdf(bsdf, words, extra);
    const Bsdf kept = with_layers(unpack_bsdf(words, extra), pack_layers(bsdf));
    const float most = 0x1p-16f;
    ASSERT_EQ(kept.eta, bsdf.eta);
    ASSERT_EQ(kept.thin_ior, bsdf.thin_ior);
    ASSERT_NEAR(kept.glass, bsdf.glass, most);
    ASSERT_NEAR(kept.coat.strength, bsdf.coat.strength, most);
    ASSERT_NEAR(std::sqrt(kept.coat.alpha), std::sqrt(bsdf.coat.alpha), most);
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(kept.diffuse.albedo[c], bsdf.diffuse.albedo[c], most);
      ASSERT_NEAR(kept.glossy.f0[c], bsdf.glossy.f0[c], most);
      ASSERT_NEAR(kept.glass_tint[c], bsdf.glass_tint[c], most);
    }
    ASSERT_NEAR(kept.diffuse.coat_f0, bsdf.diffuse.coat_f0, most);
    ASSERT_NEAR(kept.diffuse.coat_f90, bsdf.diffuse.coat_f90, most);
    ASSERT_NEAR(kept.glossy.f90, bsdf.glossy.f90, most);
    ASSERT_NEAR(std::sqrt(kept.glossy.alpha), roughness, most);
  }
}

// What a hit point evaluates is the surface itself, and a delta stays one.
TEST(PackBsdf, KeepsEveryRowsValue) {
  const vec3 wo = normalize(vec3(0.3f, -0.2f, 0.7f));
  const vec3 wi = normalize(vec3(-0.2f, 0.3f, 0.8f));
  const vec3 beyond = normalize(vec3(-0.3f, 0.1f, -0.8f));
  for (const BsdfRow& row : statistics::bsdf_table()) {
    uvec4 words;
    uint extra;
    pack_bsdf(row.bsdf, words, extra);
    const Bsdf kept = with_layers(unpack_bsdf(words, extra), pack_layers(row.bsdf));
    EXPECT_EQ(has_mirror(kept), has_mirror(row.bsdf)) << row.name;
    EXPECT_EQ(is_non_specular(kept), is_non_specular(row.bsdf)) << row.name;
    for (const vec3& from : {wi, beyond}) {
      const vec3 value = bsdf_eval(row.bsdf, wo, from);
      // Roughness enters in the fourth power: four times its relative error of 2^-17 / 0.05 at
      // most.
      EXPECT_LT(length(bsdf_eval(kept, wo, from) - value), 1e-4f + 1e-3f * length(value))
          << row.name;
    }
  }
}

TEST(NormalFactors, AreVeachsRatios) {
  EXPECT_FLOAT_EQ(shading_normal_factor(0.5f, 0.8f, 0.4f, 0.9f), 0.5f * 0.9f / (0.8f * 0.4f));
  EXPECT_FLOAT_EQ(shading_normal_factor(-0.5f, 0.8f, 0.4f, -0.9f), 0.5f * 0.9f / (0.8f * 0.4f));
  EXPECT_EQ(shading_normal_factor(0.3f, 0.3f, 0.6f, 0.6f), 1.0f);
  EXPECT_TRUE(is_finite(shading_normal_factor(1.0f, 0.0f, 0.0f, 1.0f)));
  EXPECT_FLOAT_EQ(merge_normal_factor(-0.5f, 0.8f), 0.625f);
  EXPECT_TRUE(is_finite(merge_normal_factor(1.0f, 0.0f)));
}

}  // namespace
}  // namespace ppm::shared
