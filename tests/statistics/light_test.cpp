// shared/light.h: emission, connection, and that the two tell of the same light.
#include "shared/light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "chi_squared.hpp"
#include "grid_counts.hpp"
#include "quadrature.hpp"

namespace ppm::shared {
namespace {

using glm::dvec2;
using glm::dvec3;
using statistics::expect_density;
using statistics::Rectangles;
using statistics::Units;
constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 200000;

struct LightRow {
  std::string name;
  Light light;
};

void PrintTo(const LightRow& row, std::ostream* out) {
  *out << row.name;
}

Light blank(uint kind) {
  Light light{};
  light.record.kind = kind;
  light.record.emission = vec3(3.0f, 0.5f, 7.0f);
  light.record.position = vec3(0.2f, -0.3f, 0.4f);
  light.record.direction = normalize(vec3(0.4f, -0.8f, 0.3f));
  light.record.triangle = floatBitsToUint(1e30f);  // no range
  light.bounding_centre = vec3(0.1f, 0.2f, -0.1f);
  light.bounding_radius = 1.5f;
  return light;
}

Light triangle(bool two_sided) {
  Light light = blank(PPM_LIGHT_TRIANGLE);
  light.corner0 = vec3(0.1f, 0.2f, 0.3f);
  light.corner1 = vec3(0.7f, -0.1f, 0.4f);
  light.corner2 = vec3(0.2f, 0.5f, 0.9f);
  light.two_sided = two_sided ? 1.0f : 0.0f;
  return light;
}

Light spot(double inner, double outer) {
  Light light = blank(PPM_LIGHT_SPOT);
  light.record.cos_inner = static_cast<float>(std::cos(inner));
  light.record.cos_outer = static_cast<float>(std::cos(outer));
  return light;
}

Light within(Light light, float range) {
  light.record.triangle = floatBitsToUint(range);
  return light;
}

// A new kind of light needs its rows here, and its emitted power and irradiance below.
const std::vector<LightRow>& lights() {
  static const std::vector<LightRow> rows{{"triangle", triangle(false)},
                                          {"triangle_two_sided", triangle(true)},
                                          {"point", blank(PPM_LIGHT_POINT)},
                                          {"point_range", within(blank(PPM_LIGHT_POINT), 0.87f)},
                                          {"spot_wide", spot(0.2, 1.2)},
                                          {"spot_soft", spot(0.0, 0.5)},
                                          {"spot_hard", spot(0.4999, 0.5)},
                                          {"spot_range", within(spot(0.2, 1.2), 1.25f)},
                                          {"directional", blank(PPM_LIGHT_DIRECTIONAL)}};
  return rows;
}

class LightTest : public ::testing::TestWithParam<LightRow> {
 protected:
  const Light& light() const { return GetParam().light; }
};

double area_of(const Light& light) {
  return 0.5 * glm::length(glm::cross(dvec3(light.corner1) - dvec3(light.corner0),
                                      dvec3(light.corner2) - dvec3(light.corner0)));
}
dvec3 normal_of(const Light& light) {
  return glm::normalize(glm::cross(dvec3(light.corner1) - dvec3(light.corner0),
                                   dvec3(light.corner2) - dvec3(light.corner0)));
}

// KHR_lights_punctual: the square of a clamped ramp between the cones' cosines.
double spot_intensity(const LightRecord& record, double cosine) {
  const double ramp = std::max(0.001, double(record.cos_inner) - record.cos_outer);
  return std::pow(std::clamp((cosine - record.cos_outer) / ramp, 0.0, 1.0), 2.0);
}

// Power per unit of emission, by quadrature over what the light sends where.
double emitted_power(const Light& light) {
  if (light.record.kind == PPM_LIGHT_TRIANGLE) {
    const double side = statistics::integrate([](double c) { return 2.0 * kPi * c; }, 0.0, 1.0);
    return area_of(light) * side * (light.two_sided > 0.0f ? 2.0 : 1.0);
  }
  if (light.record.kind == PPM_LIGHT_DIRECTIONAL) {
    return kPi * light.bounding_radius * light.bounding_radius;
  }
  if (light.record.kind == PPM_LIGHT_POINT) return 4.0 * kPi;
  return statistics::integrate(
      [&](double c) { return 2.0 * kPi * spot_intensity(light.record, c); },
      double(light.record.cos_outer), 1.0, 500);
}

// 500 panels put the kink of a spot's ramp within 1/500 of the cone: 1e-6 of the power.
TEST_P(LightTest, PowerIsWhatItEmits) {
  const dvec3 power = light_power(light());
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(power[c] / (emitted_power(light()) * light().record.emission[c]), 1.0, 5e-6);
  }
}

// The mean flux of a photon is the power; its flux is emission times cosine over the densities.
TEST_P(LightTest, EmitsItsPower) {
  Units units(111);
  std::array<statistics::Moments, 3> flux;
  for (int i = 0; i < kSamples; ++i) {
    const LightEmission photon = light_emit(light(), units.next4(), units.next());
    ASSERT_NEAR(length(photon.direction), 1.0f, 2e-6f);
    double value = 1.0 / (double(photon.pdf_position_area) * photon.pdf_direction_solid_angle);
    if (light().record.kind == PPM_LIGHT_TRIANGLE) {
      const double cosine = glm::dot(dvec3(photon.normal), dvec3(photon.direction));
      ASSERT_GT(cosine, 0.0);
      value *= cosine;
    } else {
      ASSERT_EQ(photon.normal, vec3(0.0f));
    }
    if (light().record.kind == PPM_LIGHT_SPOT) {
      value *= spot_intensity(light().record,
                              glm::dot(dvec3(photon.direction), dvec3(light().record.direction)));
    }
    for (int c = 0; c < 3; ++c) {
      flux[static_cast<std::size_t>(c)].add(photon.flux[c]);
      const double expected = value * light().record.emission[c];
      // Directions are rounded to 2e-7, against a grazing cosine or a ramp of 0.001 at least.
      ASSERT_NEAR(photon.flux[c], expected, 1e-3 * expected + 1e-3) << GetParam().name;
    }
  }
  const dvec3 power = light_power(light());
  for (int c = 0; c < 3; ++c) {
    statistics::expect_mean(flux[static_cast<std::size_t>(c)], power[c], 1e-6 * power[c],
                            GetParam().name);
  }
}

// Cosine and azimuth about an axis.
dvec2 about(dvec3 axis, dvec3 w) {
  const dvec3 t = glm::normalize(glm::cross(axis, dvec3(0.36, 0.48, 0.8)));
  return {glm::dot(w, axis), std::atan2(glm::dot(w, glm::cross(axis, t)), glm::dot(w, t))};
}

// Directions against the density that connections state for them, which is thereby the density of
// emission; positions against the reported one.
TEST_P(LightTest, DirectionsFollowTheirDensity) {
  const LightRecord& record = light().record;
  Units units(112);
  if (record.kind == PPM_LIGHT_DIRECTIONAL) {
    const LightEmission photon = light_emit(light(), units.next4(), 0.3f);
    EXPECT_EQ(photon.direction, record.direction);
    EXPECT_EQ(photon.pdf_direction_solid_angle, 1.0f);
    return;
  }
  const bool is_triangle = record.kind == PPM_LIGHT_TRIANGLE;
  const dvec3 axis = is_triangle ? normal_of(light()) : glm::normalize(dvec3(record.direction));
  const double low = record.kind == PPM_LIGHT_SPOT ? double(record.cos_outer) : -1.0;
  const auto sample = [&] {
    const LightEmission photon = light_emit(light(), units.next4(), units.next());
    const dvec2 w = about(axis, photon.direction);
    EXPECT_GT(w.x, low - 1e-6);  // rounding may go past a cone's edge or the axis
    return dvec2(std::clamp(w.x, low, 1.0 - 1e-12), w.y);
  };
  const auto density = [&](dvec2 w) {
    if (is_triangle)
      return (light().two_sided > 0.0f ? 0.5 * std::abs(w.x) : std::max(0.0, w.x)) / kPi;
    if (record.kind == PPM_LIGHT_POINT) return 0.25 / kPi;
    return 0.5 / (kPi * (1.0 - record.cos_outer));
  };
  expect_density(Rectangles{{low, -kPi}, {1.0, kPi}}, kSamples, sample, density,
                 GetParam().name + " directions");
  for (int i = 0; i < 1000; ++i) {
    const LightEmission photon = light_emit(light(), units.next4(), units.next());
    const dvec2 w = about(axis, photon.direction);
    ASSERT_NEAR(photon.pdf_direction_solid_angle, density(w), 1e-6 + 1e-5 * density(w));
  }
}

TEST_P(LightTest, PositionsFollowTheirDensity) {
  Units units(113);
  const Light& l = light();
  if (l.record.kind == PPM_LIGHT_TRIANGLE) {
    // Barycentric coordinates by Cramer's rule; uniform below the diagonal of the unit square.
    const dvec3 e1 = dvec3(l.corner1) - dvec3(l.corner0), e2 = dvec3(l.corner2) - dvec3(l.corner0);
    const double a = glm::dot(e1, e1), b = glm::dot(e1, e2), c = glm::dot(e2, e2);
    const auto sample = [&] {
      const LightEmission photon = light_emit(l, units.next4(), units.next());
      EXPECT_NEAR(photon.pdf_position_area * area_of(l), 1.0, 1e-6);
      const dvec3 p = dvec3(photon.position) - dvec3(l.corner0);
      EXPECT_NEAR(glm::dot(p, normal_of(l)), 0.0, 1e-6);
      const double x = glm::dot(p, e1), y = glm::dot(p, e2), det = a * c - b * b;
      const dvec2 bary((x * c - y * b) / det, (y * a - x * b) / det);
      // Folds the triangle to a square: along the ray through corner 0, and across it.
      const double sum = std::clamp(bary.x + bary.y, 1e-12, 1.0 - 1e-12);
      return dvec2(sum * sum, std::clamp(bary.y / sum, 0.0, 1.0 - 1e-12));
    };
    expect_density(
        Rectangles{{0.0, 0.0}, {1.0, 1.0}}, kSamples, sample, [](dvec2) { return 1.0; },
        "triangle positions");
  } else if (l.record.kind == PPM_LIGHT_DIRECTIONAL) {
    const double radius = l.bounding_radius;
    const auto sample = [&] {
      const LightEmission photon = light_emit(l, units.next4(), units.next());
      EXPECT_NEAR(photon.pdf_position_area * kPi * radius * radius, 1.0, 1e-6);
      const dvec3 off = dvec3(photon.position) - dvec3(l.bounding_centre);
      EXPECT_NEAR(glm::dot(off, dvec3(l.record.direction)), -radius, 1e-6);
      const dvec2 polar = about(glm::normalize(dvec3(l.record.direction)), off);
      const double r2 = (glm::dot(off, off) - radius * radius) / (radius * radius);
      return dvec2(std::clamp(r2, 0.0, 1.0 - 1e-12), polar.y);
    };
    expect_density(
        Rectangles{{0.0, -kPi}, {1.0, kPi}}, kSamples, sample, [](dvec2) { return 0.5 / kPi; },
        "disc positions");
  } else {
    const LightEmission photon = light_emit(l, units.next4(), units.next());
    EXPECT_EQ(photon.position, l.record.position);
    EXPECT_EQ(photon.pdf_position_area, 1.0f);
  }
}

struct Receiver {
  vec3 point, normal;
};

// Irradiance per unit of emission. Triangle: Lambert's formula, the sum over edges of the angle
// they subtend times their plane's slant; it needs the whole light above the receiver's horizon.
double irradiance(const Light& light, const Receiver& at) {
  const dvec3 point(at.point), normal(at.normal);
  if (light.record.kind == PPM_LIGHT_DIRECTIONAL) {
    return std::max(0.0, -glm::dot(dvec3(light.record.direction), normal));
  }
  if (light.record.kind == PPM_LIGHT_TRIANGLE) {
    const bool behind = glm::dot(point - dvec3(light.corner0), normal_of(light)) < 0.0;
    if (behind && light.two_sided == 0.0f) return 0.0;
    const std::array<dvec3, 3> w{glm::normalize(dvec3(light.corner0) - point),
                                 glm::normalize(dvec3(light.corner1) - point),
                                 glm::normalize(dvec3(light.corner2) - point)};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3 edge = glm::cross(w[i], w[(i + 1) % 3]);
      const double sine = glm::length(edge);
      const double angle = std::atan2(sine, glm::dot(w[i], w[(i + 1) % 3]));
      sum += 0.5 * angle * glm::dot(edge, normal) / sine;
    }
    return std::abs(sum);
  }
  const dvec3 to = dvec3(light.record.position) - point;
  const double distance2 = glm::dot(to, to);
  const dvec3 w = to / std::sqrt(distance2);
  // KHR_lights_punctual: max(min(1 - (distance / range)^4, 1), 0) / distance^2.
  const double range = glm::uintBitsToFloat(light.record.triangle);
  const double window = std::clamp(1.0 - std::pow(distance2 / (range * range), 2.0), 0.0, 1.0);
  const double plain = window * std::max(0.0, glm::dot(w, normal)) / distance2;
  if (light.record.kind == PPM_LIGHT_POINT) return plain;
  return plain * spot_intensity(light.record, -glm::dot(w, dvec3(light.record.direction)));
}

// In front of the triangle and behind it, within the spots' cones, on their ramps and outside, near
// their range and beyond.
std::vector<Receiver> receivers(const Light& light) {
  std::vector<Receiver> result;
  if (light.record.kind == PPM_LIGHT_TRIANGLE) {
    const vec3 centre = (light.corner0 + light.corner1 + light.corner2) / 3.0f;
    const vec3 n = normal_of(light);
    result = {{centre + n * 0.5f, -n},
              {centre + n * 0.2f, -n},
              {centre - n * 0.7f, n},
              {centre + n * 2.0f + vec3(0.3f, 0.0f, 0.0f), normalize(vec3(0.1f, 0.0f, 0.2f) - n)}};
    return result;
  }
  for (const float angle : {0.0f, 0.1f, 0.3f, 0.45f, 0.6f, 1.0f, 1.5f, 3.0f}) {
    vec3 t, b;
    tangent_frame(light.record.direction, t, b);
    const vec3 way = light.record.direction * std::cos(angle) + t * std::sin(angle);
    result.push_back({light.record.position + way * (0.3f + angle), normalize(b * 0.5f - way)});
  }
  return result;
}

// radiance * cosine / density estimates the irradiance: for delta lights every single connection.
TEST_P(LightTest, ConnectionsEstimateTheIrradiance) {
  for (const Receiver& at : receivers(light())) {
    Units units(114);
    statistics::Moments estimate;
    const bool delta = light().record.kind != PPM_LIGHT_TRIANGLE;
    const bool unlit =
        light().record.kind != PPM_LIGHT_DIRECTIONAL && irradiance(light(), at) == 0.0;
    for (int i = 0; i < (delta ? 2 : kSamples / 2); ++i) {
      const LightConnection seen = light_connect(light(), at.point, units.next2());
      const double cosine = std::max(0.0f, dot(seen.direction, at.normal));
      estimate.add(double(seen.radiance.z) * cosine / seen.pdf_solid_angle);
      ASSERT_NEAR(seen.radiance.x * 7.0f, seen.radiance.z * 3.0f, 1e-5f * seen.radiance.z);
      ASSERT_NEAR(length(seen.direction), 1.0f, 1e-6f);
      ASSERT_EQ(seen.radiance == vec3(0.0f), unlit) << "the dark side of a light gives nothing";
    }
    const double expected = light().record.emission.z * irradiance(light(), at);
    if (delta || expected == 0.0) {
      // As for emission: the narrowest ramp amplifies the direction's rounding by 1000 at most.
      EXPECT_NEAR(estimate.mean(), expected, 1e-3 * expected + 1e-9) << at.point.x;
    } else {
      statistics::expect_mean(estimate, expected, 2e-6 * expected, GetParam().name);
    }
  }
}

// A photon sent out and a connection back from where it arrives tell of the same event: the same
// densities, directions and cosine, and area turned to solid angle by distance^2 / cosine.
TEST_P(LightTest, EmissionAndConnectionAgree) {
  Units units(115);
  for (int i = 0; i < 20000; ++i) {
    const vec4 u = units.next4();
    const LightEmission photon = light_emit(light(), u, units.next());
    const double distance = units.between(0.3, 2.0);
    const vec3 point = photon.position + photon.direction * float(distance);
    const LightConnection seen = light_connect(light(), point, vec2(u));
    const bool is_triangle = light().record.kind == PPM_LIGHT_TRIANGLE;
    const double cosine = is_triangle ? double(dot(photon.normal, photon.direction)) : 1.0;
    // Skipped: where rounding of the point by 1e-7 changes a grazing cosine, or leaves the cone.
    if (cosine < 0.01) continue;
    if (light().record.kind == PPM_LIGHT_SPOT &&
        dot(photon.direction, light().record.direction) < light().record.cos_outer + 1e-5f) {
      continue;
    }
    ASSERT_LT(length(seen.direction + photon.direction), 3e-6f);
    ASSERT_NEAR(seen.light_cosine, cosine, 2e-6);
    ASSERT_NEAR(seen.pdf_position_area, photon.pdf_position_area, 1e-6f * photon.pdf_position_area);
    ASSERT_NEAR(seen.emit_pdf_direction_solid_angle, photon.pdf_direction_solid_angle,
                3e-6f + 1e-5f * photon.pdf_direction_solid_angle);
    if (is_triangle) {
      const double solid = double(photon.pdf_position_area) * distance * distance / cosine;
      ASSERT_NEAR(seen.pdf_solid_angle, solid, 5e-4 * solid);
      ASSERT_NEAR(seen.distance, distance, 2e-6);
      ASSERT_EQ(seen.radiance, light().record.emission);
    } else {
      ASSERT_EQ(seen.pdf_solid_angle, 1.0f);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LightTest, ::testing::ValuesIn(lights()),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace ppm::shared
