// shared/environment.h and the table it reads, against the definition of the map in double
// precision: what is shown, what is drawn how often, and what is emitted.
#include "environment_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "grid_counts.hpp"
#include "light_table.hpp"
#include "shared/random.h"

namespace ppm::render {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using shared::EnvironmentSight;
using statistics::Units;

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 200000;

struct Sky {
  std::string name;
  std::uint32_t height;  // half the width
  double rotation;       // degrees
  std::function<vec3(std::uint32_t column, std::uint32_t row)> texel;
};

void PrintTo(const Sky& sky, std::ostream* out) {
  *out << sky.name;
}

scene::Environment environment_of(const Sky& sky) {
  scene::Environment environment;
  environment.width = 2 * sky.height;
  environment.height = sky.height;
  environment.strength = 2.0f;
  environment.rotation = sky.rotation * kPi / 180.0;
  for (std::uint32_t row = 0; row < sky.height; ++row) {
    for (std::uint32_t column = 0; column < 2 * sky.height; ++column) {
      environment.texels.push_back(sky.texel(column, row));
    }
  }
  return environment;
}

// A new kind of map needs a row here.
const std::vector<Sky>& skies() {
  static const std::vector<Sky> rows{
      {"single_row", 1, 0.0, [](auto, auto) { return vec3(0.5f, 1.0f, 0.25f); }},
      {"constant", 8, 30.0, [](auto, auto) { return vec3(1.0f, 2.0f, 3.0f); }},
      {"sun", 16, -77.0,
       [](auto column, auto row) {
         return column == 5 && row == 4 ? vec3(1000.0f, 900.0f, 700.0f) : vec3(0.0f);
       }},
      {"sun_at_the_pole", 16, 0.0,
       [](auto column, auto row) {
         return column == 0 && row == 0 ? vec3(50.0f) : vec3(0.0f, 0.0f, 0.01f);
       }},
      {"sun_below", 16, 200.0,
       [](auto column, auto row) {
         return column == 31 && row == 15 ? vec3(50.0f) : vec3(0.1f, 0.0f, 0.0f);
       }},
      {"gradient", 12, 123.0,
       [](auto column, auto row) {
         return vec3(static_cast<float>(row), static_cast<float>(column) * 0.1f,
                     static_cast<float>((3 * row + column) % 7));
       }},
      {"chequered", 10, 0.0,
       [](auto column, auto row) { return vec3((column + row) % 2 == 0 ? 1.0f : 0.0f); }},
  };
  return rows;
}

// Longitude from the middle of the map, and angle from the pole, of a direction in the world.
dvec2 angles_of(const Sky& sky, dvec3 direction) {
  const double longitude = std::atan2(direction.z, direction.x) + sky.rotation * kPi / 180.0;
  return {std::remainder(longitude, 2.0 * kPi), std::acos(std::clamp(direction.y, -1.0, 1.0))};
}

// The map by its definition: bilinear between centres of texels.
dvec3 shown(const Sky& sky, dvec2 angles) {
  const double width = 2.0 * sky.height, height = sky.height;
  const double x = (angles.x / (2.0 * kPi) + 0.5) * width - 0.5;
  const double y = angles.y / kPi * height - 0.5;
  dvec3 sum(0.0);
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const double left = std::floor(x), upper = std::floor(y);
      const double column = std::fmod(left + dx + 2.0 * width, width);
      const double row = std::clamp(upper + dy, 0.0, height - 1.0);
      const double weight = (1.0 - std::abs(x - left - dx)) * (1.0 - std::abs(y - upper - dy));
      sum += weight *
             dvec3(sky.texel(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)));
    }
  }
  return 2.0 * sum;  // the strength
}

class EnvironmentTest : public ::testing::TestWithParam<Sky> {
 protected:
  EnvironmentTest() : table_(make_environment_table(environment_of(GetParam()))) {}

  EnvironmentSight sight_at(vec2 texel) const {
    const shared::EnvironmentTaps taps = shared::environment_taps(table_.shape, texel);
    const auto radiance = [&](unsigned tap) {
      const uvec4 words = table_.texels.at(taps.index[static_cast<int>(tap)]);
      return shared::unpack_radiance(glm::uvec2(words.x, words.y));
    };
    return shared::environment_sight(table_.shape, texel, taps, radiance(0), radiance(1),
                                     radiance(2), radiance(3));
  }
  EnvironmentSight sight_towards(vec3 direction) const {
    return sight_at(shared::environment_texel(table_.shape, direction));
  }
  // A point of the map as the kernels draw it.
  vec2 draw(Units& units) const {
    const auto count = static_cast<std::uint32_t>(table_.texels.size());
    const std::uint32_t bin = shared::index_from_word(units.word(), count);
    const uvec4 words = table_.texels.at(bin);
    const std::uint32_t texel = units.word() < words.z ? bin : words.w;
    return shared::environment_sample_texel(table_.shape, texel, units.next2());
  }

  EnvironmentTable table_;
};

// Positions on the map are rounded to 1e-7 of its width, texels to 2^-17 of their largest channel.
TEST_P(EnvironmentTest, ShowsTheMap) {
  Units units(501);
  double largest = 0.0;
  for (const uvec4& words : table_.texels) {
    const vec3 radiance = shared::unpack_radiance(glm::uvec2(words.x, words.y));
    largest = std::max({largest, double(radiance.x), double(radiance.y), double(radiance.z)});
  }
  const double slack = largest * (1e-6 * GetParam().height + 0x1p-16);
  for (int i = 0; i < 20000; ++i) {
    const vec3 direction = units.direction();
    const dvec3 expected = shown(GetParam(), angles_of(GetParam(), direction));
    const EnvironmentSight sight = sight_towards(direction);
    for (int channel = 0; channel < 3; ++channel) {
      ASSERT_NEAR(sight.radiance[channel], expected[channel], slack) << direction.y;
    }
  }
}

TEST_P(EnvironmentTest, DirectionsAndTexelsAreInverse) {
  Units units(502);
  for (int i = 0; i < 20000; ++i) {
    const vec3 direction = units.direction();
    const vec2 texel = shared::environment_texel(table_.shape, direction);
    const vec3 back = shared::environment_direction(table_.shape, texel);
    ASSERT_NEAR(length(back), 1.0f, 1e-6f);
    ASSERT_LT(length(back - direction), 3e-6f);
  }
}

// Mean of the channels over the sphere by quadrature, texel by texel.
double integral_over_map(const Sky& sky, const std::function<double(dvec2)>& f) {
  double sum = 0.0;
  const double width = 2.0 * sky.height;
  for (double row = 0.0; row < 2.0 * sky.height; ++row) {  // half texels: it bends at their middles
    for (double column = 0.0; column < 2.0 * width; ++column) {
      const double step = kPi / (2.0 * sky.height);
      sum += statistics::integrate(
          [&](double longitude) {
            return statistics::integrate(
                [&](double polar) {
                  return f({longitude - kPi, polar}) * std::sin(polar);
                },
                row * step, (row + 1.0) * step);
          },
          column * step, (column + 1.0) * step);
    }
  }
  return sum;
}

TEST_P(EnvironmentTest, IrradianceIsTheIntegral) {
  for (int channel = 0; channel < 3; ++channel) {
    const double expected =
        integral_over_map(GetParam(), [&](dvec2 at) { return shown(GetParam(), at)[channel]; });
    const double rounding =
        0x1p-16 * (table_.irradiance.x + table_.irradiance.y + table_.irradiance.z);
    EXPECT_NEAR(table_.irradiance[channel], expected, 1e-9 * expected + rounding);
  }
}

// Drawn directions against the density that is stated for them; that integrates to 1; and it is
// positive wherever anything shines.
TEST_P(EnvironmentTest, DirectionsFollowTheirDensity) {
  const Sky& sky = GetParam();
  const auto density_at = [&](dvec2 angles) {
    const vec2 texel((angles.x / (2.0 * kPi) + 0.5) * 2.0 * sky.height,
                     angles.y / kPi * sky.height);
    return double(sight_at(texel).pdf_solid_angle);
  };
  EXPECT_NEAR(integral_over_map(sky, density_at), 1.0, 1e-5);
  Units units(503);
  const auto sample = [&] {
    const vec3 direction = shared::environment_direction(table_.shape, draw(units));
    dvec2 angles = angles_of(sky, direction);
    return glm::clamp(angles, dvec2(-kPi, 0.0), dvec2(kPi * (1.0 - 1e-12)));
  };
  statistics::Rectangles cells{{-kPi, 0.0}, {kPi, kPi}};
  // The density bends at texels' middles: quadrature is exact where no cell holds one inside.
  cells.columns = static_cast<int>(4 * sky.height);
  cells.rows = static_cast<int>(2 * sky.height);
  statistics::expect_density(
      cells, kSamples, sample, [&](dvec2 at) { return density_at(at) * std::sin(at.y); },
      sky.name + " directions");
  for (int i = 0; i < 20000; ++i) {
    const EnvironmentSight sight = sight_towards(units.direction());
    ASSERT_EQ(sight.pdf_solid_angle > 0.0f, sight.radiance != vec3(0.0f));
  }
}

shared::Light light_of(const EnvironmentTable& table) {
  shared::Light light{};
  light.record.kind = PPM_LIGHT_ENVIRONMENT;
  light.record.emission = table.irradiance;
  light.bounding_centre = vec3(0.1f, 0.2f, -0.1f);
  light.bounding_radius = 1.5f;
  return light;
}

// The mean flux of a photon is the power; each starts on the disc that faces where it comes from.
TEST_P(EnvironmentTest, EmitsItsPower) {
  const shared::Light light = light_of(table_);
  const dvec3 power = shared::light_power(light);
  Units units(504);
  std::array<statistics::Moments, 3> flux;
  double largest = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const vec2 texel = draw(units);
    const vec3 sky = shared::environment_direction(table_.shape, texel);
    const shared::LightEmission photon =
        shared::environment_emit(light, sky, sight_at(texel), units.next2());
    ASSERT_EQ(photon.direction, -sky);
    ASSERT_EQ(photon.normal, vec3(0.0f));
    const dvec3 off = dvec3(photon.position) - dvec3(light.bounding_centre);
    ASSERT_NEAR(glm::dot(off, dvec3(sky)), light.bounding_radius, 2e-6);
    ASSERT_LE(glm::length(off), std::sqrt(2.0) * light.bounding_radius + 2e-6);
    for (int c = 0; c < 3; ++c) flux[static_cast<std::size_t>(c)].add(photon.flux[c]);
    largest = std::max(largest, double(shared::mean_component(photon.flux)));
  }
  for (int c = 0; c < 3; ++c) {
    statistics::expect_mean(flux[static_cast<std::size_t>(c)], power[c], 2e-5 * power[c],
                            GetParam().name);
  }
  // What the sine varies by under a tent is all that fluxes differ by: at the poles threefold.
  EXPECT_LT(largest, 3.1 * (power.x + power.y + power.z) / 3.0);
}

// radiance * cosine / density of connections estimates the irradiance of a plane, for which
// quadrature over the map is the truth; each tells of the same event as a photon that arrives.
TEST_P(EnvironmentTest, ConnectionsEstimateTheIrradiance) {
  const shared::Light light = light_of(table_);
  const dvec3 normal = glm::normalize(dvec3(0.3, 0.8, -0.5));
  Units units(505);
  statistics::Moments estimate;
  for (int i = 0; i < kSamples; ++i) {
    const vec2 texel = draw(units);
    const vec3 sky = shared::environment_direction(table_.shape, texel);
    const EnvironmentSight sight = sight_at(texel);
    const shared::LightConnection seen = shared::environment_connect(light, sky, sight);
    const double cosine = std::max(0.0, glm::dot(normal, dvec3(seen.direction)));
    estimate.add(seen.pdf_solid_angle > 0.0f
                     ? double(shared::mean_component(seen.radiance)) * cosine / seen.pdf_solid_angle
                     : 0.0);
    const shared::LightEmission photon = shared::environment_emit(light, sky, sight, units.next2());
    ASSERT_EQ(seen.pdf_position_area, photon.pdf_position_area);
    ASSERT_EQ(seen.emit_pdf_direction_solid_angle, photon.pdf_direction_solid_angle);
    ASSERT_EQ(seen.light_cosine, 1.0f);
    ASSERT_GT(seen.distance, 1e29f);
  }
  const double turn = GetParam().rotation * kPi / 180.0;
  const double expected = integral_over_map(GetParam(), [&](dvec2 at) {
    const double longitude = at.x - turn;
    const dvec3 direction(std::sin(at.y) * std::cos(longitude), std::cos(at.y),
                          std::sin(at.y) * std::sin(longitude));
    const dvec3 radiance = shown(GetParam(), at);
    return std::max(0.0, glm::dot(direction, normal)) * (radiance.x + radiance.y + radiance.z) /
           3.0;
  });
  // The horizon cuts through panels of the quadrature: 1e-3 of it.
  statistics::expect_mean(estimate, expected, 2e-3 * expected, GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(Skies, EnvironmentTest, ::testing::ValuesIn(skies()),
                         [](const auto& row) { return row.param.name; });

TEST(EnvironmentTable, IsEmptyInTheDark) {
  const EnvironmentTable table = make_environment_table(
      environment_of({"dark", 4, 0.0, [](auto, auto) { return vec3(0.0f); }}));
  EXPECT_TRUE(table.texels.empty());
}

TEST(EnvironmentTable, RadianceIsKept) {
  Units units(506);
  for (int i = 0; i < 20000; ++i) {
    const float scale = std::exp2(float(units.between(-60.0, 60.0)));
    const vec3 radiance = units.next3() * scale;
    const vec3 back = shared::unpack_radiance(shared::pack_radiance(radiance));
    const float largest = std::max({radiance.x, radiance.y, radiance.z});
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(back[c], radiance[c], 0x1p-16f * largest);
  }
  EXPECT_EQ(shared::unpack_radiance(shared::pack_radiance(vec3(0.0f))), vec3(0.0f));
}

// Against the library, over all quadrants and the axes.
TEST(Environment, TurnsAreArcTangents) {
  Units units(507);
  for (int i = 0; i < 50000; ++i) {
    float x = float(units.between(-1.0, 1.0)), y = float(units.between(-1.0, 1.0));
    if (i % 10 == 0) x = 0.0f;
    if (i % 10 == 1) y = 0.0f;
    ASSERT_NEAR(shared::turn_of(x, y), std::atan2(double(y), double(x)) / (2.0 * kPi), 1e-7);
  }
  EXPECT_EQ(shared::turn_of(0.0f, 0.0f), 0.0f);
}

}  // namespace
}  // namespace ppm::render
