// shared/geometry.h: frames, packed directions, the circle.
#include "shared/geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "chi_squared.hpp"

namespace ppm::shared {
namespace {

using glm::dvec3;
using statistics::Units;
constexpr int kDirections = 1000000;

double angle_between(dvec3 a, dvec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(UnitCircle, EqualsSineAndCosine) {
  Units units(11);
  double worst = 0.0;
  for (int i = 0; i < (1 << 20); ++i) {
    const float u = i < (1 << 19) ? static_cast<float>(i) * 0x1p-19f : units.next();
    const vec2 circle = unit_circle(u);
    const double angle = 2.0 * std::numbers::pi * u;
    worst = std::max(
        {worst, std::abs(circle.x - std::cos(angle)), std::abs(circle.y - std::sin(angle))});
  }
  EXPECT_LT(worst, 4e-7);  // its promise
  EXPECT_EQ(unit_circle(0.0f), vec2(1.0f, 0.0f));
  EXPECT_EQ(unit_circle(0.25f), vec2(0.0f, 1.0f));
  EXPECT_EQ(unit_circle(0.5f), vec2(-1.0f, 0.0f));
  EXPECT_EQ(unit_circle(0.75f), vec2(0.0f, -1.0f));
  EXPECT_NEAR(unit_circle(1.0f - 0x1p-24f).x, 1.0f, 1e-7f);
}

// Half a step of the octahedron's coordinates is 1 / 65534. A step (h, h, -2h) at a face's centre,
// which lies 1 / sqrt 3 from the origin, turns the direction by sqrt 6 * sqrt 3 * h = 4.24 h: that
// is the worst place and makes 6.5e-5; rounding in float adds some 1e-7 * 4.
TEST(PackDirection, ErrsByLessThanItsStep) {
  Units units(12);
  double worst = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    vec3 direction = units.direction();
    if (i % 4 == 1) {  // near a face's centre, the worst place
      const vec3 signs(sign_not_zero(direction.x), sign_not_zero(direction.y),
                       sign_not_zero(direction.z));
      direction = normalize(signs + direction * 0.01f);
    }
    if (i % 4 == 2) direction = normalize(vec3(direction.x, direction.y, direction.z * 1e-4f));
    const vec3 unpacked = unpack_direction(pack_direction(direction));
    worst = std::max(worst, angle_between(direction, unpacked));
    ASSERT_NEAR(length(unpacked), 1.0f, 2e-7f);
  }
  EXPECT_LT(worst, 6.6e-5);
  EXPECT_GT(worst, 5e-5) << "the worst place was not met";
}

TEST(PackDirection, IsExactOnTheAxes) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0f, -1.0f}) {
      vec3 direction(0.0f);
      direction[axis] = sign;
      EXPECT_EQ(unpack_direction(pack_direction(direction)), direction);
      EXPECT_EQ(unpack_direction(pack_direction(direction * 0.5f)), direction);
    }
  }
}

// Signs of what vanishes must not matter, and folded edges must not flip.
TEST(PackDirection, CopesWithSignedZeros) {
  EXPECT_EQ(unpack_direction(pack_direction(vec3(-0.0f, -0.0f, 1.0f))), vec3(0, 0, 1));
  EXPECT_EQ(unpack_direction(pack_direction(vec3(-0.0f, 0.0f, -1.0f))), vec3(0, 0, -1));
  EXPECT_EQ(unpack_direction(pack_direction(vec3(1.0f, -0.0f, -0.0f))), vec3(1, 0, 0));
}

std::vector<vec3> awkward_normals() {
  std::vector<vec3> normals{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1.0f, 0.0f, -0.0f}};
  Units units(13);
  for (const float off : {1e-7f, 1e-5f, 4e-4f, 1e-2f}) {
    normals.push_back(normalize(vec3(off, -off, -1.0f)));
    normals.push_back(normalize(vec3(off, off, 1.0f)));
    normals.push_back(normalize(vec3(0.6f, 0.8f, -off)));
  }
  for (int i = 0; i < 10000; ++i) normals.push_back(units.direction());
  return normals;
}

// Each entry is a short sum of products of numbers up to 1 with a quotient between 1/2 and 1: a few
// roundings of 6e-8. Near n.z = 0 the quotient stays within [-1, 1], so nothing grows.
TEST(TangentFrame, IsOrthonormalAndRightHanded) {
  for (const vec3& n : awkward_normals()) {
    vec3 t, b;
    tangent_frame(n, t, b);
    ASSERT_NEAR(length(t), 1.0f, 5e-7f) << n.z;
    ASSERT_NEAR(length(b), 1.0f, 5e-7f) << n.z;
    ASSERT_NEAR(dot(t, b), 0.0f, 5e-7f) << n.z;
    ASSERT_NEAR(dot(t, n), 0.0f, 5e-7f) << n.z;
    ASSERT_NEAR(dot(b, n), 0.0f, 5e-7f) << n.z;
    ASSERT_NEAR(dot(cross(t, b), n), 1.0f, 1e-6f) << n.z;
  }
}

TEST(TangentFrame, LocalAndWorldAreInverse) {
  Units units(14);
  for (const vec3& n : awkward_normals()) {
    const vec3 w = units.direction();
    ASSERT_LT(length(to_world(to_local(w, n), n) - w), 1e-6f);
    ASSERT_NEAR(to_local(w, n).z, dot(w, n), 1e-7f);
    ASSERT_LT(length(to_world(vec3(0, 0, 1), n) - n), 1e-7f);
  }
}

TEST(IsFinite, SeesNanAndInfinity) {
  using Limits = std::numeric_limits<float>;
  for (const float x : {0.0f, -0.0f, 1.0f, Limits::max(), Limits::lowest(), Limits::denorm_min()}) {
    EXPECT_TRUE(is_finite(x));
  }
  for (const float x : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
    EXPECT_FALSE(is_finite(x));
    EXPECT_FALSE(is_finite3(vec3(0.0f, 0.0f, x)));
    EXPECT_FALSE(is_finite3(vec3(x, 0.0f, 0.0f)));
    EXPECT_FALSE(is_finite3(vec3(0.0f, x, 0.0f)));
  }
}

// Rounding positions of up to 1 to floats may take 2^-25 off the offset of 2^-20.
TEST(OffsetOrigin, ClearsThePositionOnItsSide) {
  Units units(15);
  for (int i = 0; i < 1000; ++i) {
    const vec3 position = units.next3() * 2.0f - vec3(1.0f);
    const vec3 side = units.direction();
    const double moved =
        glm::dot(dvec3(offset_origin(position, side)) - dvec3(position), dvec3(side));
    ASSERT_NEAR(moved, 0x1p-20, 3 * 0x1p-25);
  }
}

// pi r^2 cos = solid angle * distance^2: the circle seen at this slant fills the pixel.
TEST(FootprintRadius, FillsThePixel) {
  for (const float cosine : {1.0f, -0.5f, 0.2f}) {
    const double r = footprint_radius(1e-5f, 3.0f, cosine);
    EXPECT_NEAR(std::numbers::pi * r * r * std::abs(cosine) / 9e-5, 1.0, 1e-6);
  }
  EXPECT_EQ(footprint_radius(1e-5f, 3.0f, 0.0f), footprint_radius(1e-5f, 3.0f, 0.1f));
}

}  // namespace
}  // namespace ppm::shared
