// shared/camera.h: the pinhole camera, the film's strata, the order of pixels.
#include "shared/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "chi_squared.hpp"
#include "grid_counts.hpp"
#include "quadrature.hpp"
#include "shared/geometry.h"

namespace ppm::shared {
namespace {

using glm::dvec2;
using glm::dvec3;
using statistics::Units;

// Rounding may carry a film position up to the pixel's far edge.
constexpr double kEdge = 1.0 + 1e-6;

struct View {
  uint width, height;
  float tan_half_x, tan_half_y;
};

// From a telephoto lens to a wide angle, with square pixels and without.
const std::vector<View> kViews{
    {64, 48, 0.4f, 0.3f}, {640, 480, 0.01f, 0.0075f}, {33, 100, 2.0f, 3.0f}, {1, 1, 1.0f, 1.0f}};

SceneConstants looking(const View& view, vec3 forward, vec3 up) {
  SceneConstants scene{};
  scene.width = view.width;
  scene.height = view.height;
  scene.camera_tan_half_x = view.tan_half_x;
  scene.camera_tan_half_y = view.tan_half_y;
  scene.camera_forward = normalize(forward);
  scene.camera_right = normalize(cross(scene.camera_forward, up));
  scene.camera_up = cross(scene.camera_right, scene.camera_forward);
  return scene;
}

SceneConstants oblique(const View& view) {
  return looking(view, vec3(0.3f, -0.8f, 0.5f), vec3(0.1f, 0.2f, 1.0f));
}

TEST(Camera, LooksThroughTheFilmsCorners) {
  const View view{8, 6, 0.5f, 0.25f};
  const SceneConstants scene = looking(view, vec3(0, 0, -1), vec3(0, 1, 0));
  const auto expected = [](float x, float y) { return normalize(vec3(x, y, -1.0f)); };
  EXPECT_LT(length(camera_direction(scene, vec2(0, 0)) - expected(-0.5f, 0.25f)), 1e-6f);
  EXPECT_LT(length(camera_direction(scene, vec2(8, 0)) - expected(0.5f, 0.25f)), 1e-6f);
  EXPECT_LT(length(camera_direction(scene, vec2(0, 6)) - expected(-0.5f, -0.25f)), 1e-6f);
  EXPECT_LT(length(camera_direction(scene, vec2(4, 3)) - expected(0.0f, 0.0f)), 1e-6f);
}

// The film coordinate is recovered from products of unit vectors, each rounded to about 2e-7, so
// that it errs by 2e-7 of the direction's tangent, counted in pixels.
TEST(Camera, ImportanceInvertsDirectionAndHasItsDensity) {
  Units units(31);
  for (const View& view : kViews) {
    const SceneConstants scene = oblique(view);
    const double tangent = std::min(view.tan_half_x, view.tan_half_y);
    const double size = std::max(view.width, view.height);
    const double cosine2 =
        1.0 / (1.0 + view.tan_half_x * view.tan_half_x + view.tan_half_y * view.tan_half_y);
    const double tolerance = 4e-7 * size / tangent / cosine2 + 4e-7 * size;
    for (int i = 0; i < 10000; ++i) {
      const vec2 film = (units.next2() * 0.9998f + 0.0001f) * vec2(view.width, view.height);
      const vec3 direction = camera_direction(scene, film);
      const CameraImportance result = camera_importance(scene, direction);
      const double cosine = dot(direction, scene.camera_forward);
      ASSERT_NEAR(result.pdf_solid_angle * pixel_solid_angle(scene, direction), 1.0, 3e-7);
      ASSERT_NEAR(result.importance * cosine / result.pdf_solid_angle, 1.0, 3e-7);
      ASSERT_NEAR(result.film.x, film.x, tolerance);
      ASSERT_NEAR(result.film.y, film.y, tolerance);
    }
  }
}

TEST(Camera, ImportanceVanishesOffTheFilm) {
  const View view{8, 6, 0.5f, 0.25f};
  const SceneConstants scene = looking(view, vec3(0, 0, -1), vec3(0, 1, 0));
  for (const vec3& w : {vec3(0, 0, 1), vec3(1, 0, 0), vec3(0.51f, 0, -1), vec3(-0.51f, 0, -1),
                        vec3(0, 0.26f, -1), vec3(0, -0.26f, -1), vec3(0.1f, 0.1f, 1)}) {
    const CameraImportance result = camera_importance(scene, normalize(w));
    EXPECT_EQ(result.importance, 0.0f);
    EXPECT_EQ(result.pdf_solid_angle, 0.0f);
  }
  EXPECT_GT(camera_importance(scene, normalize(vec3(0.49f, -0.24f, -1))).importance, 0.0f);
}

// Solid angle of the rectangle [0, x] x [0, y] on the plane at distance 1.
double corner_solid_angle(double x, double y) {
  return std::atan(x * y / std::sqrt(1.0 + x * x + y * y));
}

// One eye path through a pixel takes directions with density 1 / (solid angle per film area), so
// that 1 / density, integrated over a pixel or the film, is the closed form of its solid angle.
TEST(Camera, DensityIntegratesToSolidAngles) {
  for (const View& view : kViews) {
    const SceneConstants scene = oblique(view);
    // Not through camera_importance: on the film's very edge rounding may put a direction off it.
    const auto inverse_density = [&](double x, double y) {
      return double(pixel_solid_angle(scene, camera_direction(scene, vec2(x, y))));
    };
    const auto over = [&](dvec2 low, dvec2 high) {
      return statistics::integrate(
          [&](double y) {
            return statistics::integrate([&](double x) { return inverse_density(x, y); }, low.x,
                                         high.x, 4);
          },
          low.y, high.y, 4);
    };
    const dvec2 size(view.width, view.height);
    const double film = 4.0 * corner_solid_angle(view.tan_half_x, view.tan_half_y);
    EXPECT_NEAR(over(dvec2(0.0), size) / film, 1.0, 1e-5) << view.width;
    // The top left pixel: difference of rectangles from the film's centre.
    const double x1 = view.tan_half_x, y1 = view.tan_half_y;
    const double x0 = x1 * (1.0 - 2.0 / size.x), y0 = y1 * (1.0 - 2.0 / size.y);
    const double pixel = corner_solid_angle(x1, y1) - corner_solid_angle(x0, y1) -
                         corner_solid_angle(x1, y0) + corner_solid_angle(x0, y0);
    EXPECT_NEAR(over(dvec2(0.0), dvec2(1.0)) / pixel, 1.0, 1e-5) << view.width;
  }
}

// Parallel paths from a rectangle of the size asked for.
TEST(OrthographicCamera, LooksAlongParallels) {
  SceneConstants scene = looking({8, 6, 4.0f, 3.0f}, vec3(0, 0, -1), vec3(0, 1, 0));
  scene.camera_kind = PPM_CAMERA_ORTHOGRAPHIC;
  scene.camera_position = vec3(1, 2, 3);
  for (const auto& [film, origin] : {std::pair(vec2(0, 0), vec3(-3, 5, 3)),
                                     {vec2(8, 6), vec3(5, -1, 3)},
                                     {vec2(4, 3), vec3(1, 2, 3)},
                                     {vec2(5, 1), vec3(2, 4, 3)}}) {
    EXPECT_LT(length(camera_origin(scene, film) - origin), 1e-6f);
    EXPECT_EQ(camera_direction(scene, film), vec3(0, 0, -1));
  }
  EXPECT_EQ(camera_importance(scene, vec3(0, 0, -1)).importance, 0.0f);
}

// Its pixels cover the same area at any distance; a pinhole's grow with its square. Paths in the
// scene are a few units long, so that PPM_CAMERA_FAR_AWAY lets them grow by a few parts in 10^4.
TEST(OrthographicCamera, FootprintsDoNotGrow) {
  SceneConstants scene = looking({64, 48, 0.4f, 0.3f}, vec3(0, 0, -1), vec3(0, 1, 0));
  const double area = 0.8 / 64 * 0.6 / 48;
  const auto footprint = [&](float distance) {
    const vec3 direction = camera_direction(scene, vec2(32, 24));
    const double radius = footprint_radius(pixel_solid_angle(scene, direction),
                                           camera_distance(scene) + distance, 1.0f);
    return std::numbers::pi * radius * radius;
  };
  EXPECT_NEAR(footprint(1.0f) / area, 1.0, 1e-5);
  EXPECT_NEAR(footprint(3.0f) / area, 9.0, 1e-4);
  scene.camera_kind = PPM_CAMERA_ORTHOGRAPHIC;
  for (const float distance : {0.0f, 0.01f, 1.0f, 3.0f}) {
    EXPECT_NEAR(footprint(distance) / area, 1.0, 1e-3) << distance;
  }
}

TEST(RadicalInverse, MirrorsTheBits) {
  for (uint index : {0u, 1u, 2u, 3u, 6u, 255u, 256u, 12345u, 0xffffffu}) {
    double expected = 0.0;
    for (int bit = 0; bit < 24; ++bit) expected += ((index >> bit) & 1u) * std::exp2(-1.0 - bit);
    EXPECT_EQ(radical_inverse(index), expected) << index;
  }
}

// The box filter at pixel (0, 0) hands the strata through: a (0, k, 2)-net in base 2 has one point
// in every box of 2^-i x 2^-(k - i).
TEST(FilmSample, PowersOfTwoFillEveryElementaryInterval) {
  Units units(32);
  for (uint log = 0; log <= 8; ++log) {
    const uint samples = 1u << log;
    std::vector<dvec2> points;
    const float shift = units.next();
    for (uint i = 0; i < samples; ++i) {
      points.push_back(film_sample(PPM_FILTER_BOX, 0, 0, i, samples, {units.next2(), shift}));
    }
    for (uint split = 0; split <= log; ++split) {
      const double columns = 1u << split, rows = 1u << (log - split);
      std::vector<int> hits(samples, 0);
      for (const dvec2& p : points) {
        // Jitter of almost 1 may round up to the edge: see the comment in film_sample.
        const double column = std::min(std::floor(p.x * columns), columns - 1.0);
        const double row = std::min(std::floor(p.y * rows), rows - 1.0);
        ++hits[static_cast<std::size_t>(row * columns + column)];
      }
      EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), samples) << samples << " by " << columns;
    }
  }
}

// However many there will be: each aligned 2^k of the sequence do so, and so does each one.
TEST(FilmSample, SequencesFillEveryElementaryIntervalAgainAndAgain) {
  Units units(35);
  for (uint log = 0; log <= 8; ++log) {
    const uint samples = 1u << log;
    for (const uint first : {0u, samples, 7 * samples, 0xffffff00u & ~(samples - 1)}) {
      const uvec2 shift(static_cast<uint>(units.next() * 4e9f),
                        static_cast<uint>(units.next() * 4e9f));
      std::vector<dvec2> points;
      for (uint i = 0; i < samples; ++i) {
        points.push_back(film_sample_in_sequence(PPM_FILTER_BOX, 0, 0, first + i, shift));
      }
      for (uint split = 0; split <= log; ++split) {
        const double columns = 1u << split, rows = 1u << (log - split);
        std::vector<int> hits(samples, 0);
        for (const dvec2& p : points) {
          const double column = std::min(std::floor(p.x * columns), columns - 1.0);
          const double row = std::min(std::floor(p.y * rows), rows - 1.0);
          ++hits[static_cast<std::size_t>(row * columns + column)];
        }
        EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), samples) << first << " by " << columns;
      }
    }
  }
}

TEST(FilmSample, SamplesOfASequenceAreUniformOverThePixel) {
  std::mt19937 words(36);
  for (const uint index : {0u, 1u, 5u, 1000u}) {
    const auto draw = [&]() -> dvec2 {
      const uint first = static_cast<uint>(words());
      return film_sample_in_sequence(PPM_FILTER_BOX, 0, 0, index,
                                     uvec2(first, static_cast<uint>(words())));
    };
    statistics::expect_density(
        statistics::Rectangles{{0.0, 0.0}, {kEdge, kEdge}}, 100000, draw,
        [](dvec2) { return 1.0 / (kEdge * kEdge); }, "number " + std::to_string(index));
  }
}

// Any number: one sample drawn at random from the set is uniform over the pixel, and its columns
// are still strata. The shift (u.z) is the pixel's, the jitter each sample's own.
TEST(FilmSample, EverySampleIsUniformOverThePixel) {
  Units units(33);
  for (const uint samples : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 12u, 16u, 100u}) {
    const auto draw = [&]() -> dvec2 {
      const uint index = static_cast<uint>(units.next() * static_cast<float>(samples));
      const dvec2 p = film_sample(PPM_FILTER_BOX, 0, 0, index, samples, units.next3());
      EXPECT_NEAR(p.x * samples - index, 0.5, 0.5 + 1e-5 * samples);
      return p;
    };
    statistics::expect_density(
        statistics::Rectangles{{0.0, 0.0}, {kEdge, kEdge}}, 200000, draw,
        [](dvec2) { return 1.0 / (kEdge * kEdge); }, std::to_string(samples) + " samples");
  }
}

// Non-uniform filters: the whole set of samples follows the filter about the pixel's centre.
TEST(FilmSample, DrawsFromTheFilterAboutThePixel) {
  Units units(34);
  const auto draw = [&]() -> dvec2 {
    const uint index = static_cast<uint>(units.next() * 6.0f);
    return film_sample(PPM_FILTER_TENT, 5, 9, index, 6, units.next3());
  };
  const auto tent = [](double x) { return std::max(0.0, 1.0 - std::abs(x)); };
  statistics::expect_density(
      statistics::Rectangles{{4.5, 8.5}, {6.5 + 1e-5, 10.5 + 1e-5}}, 200000, draw,
      [&](dvec2 p) { return tent(p.x - 5.5) * tent(p.y - 9.5); }, "tent");
}

TEST(PixelPosition, IsABijectionInBlocks) {
  for (const uvec2 size : {uvec2(1, 1), uvec2(7, 13), uvec2(8, 8), uvec2(640, 480), uvec2(17, 5),
                           uvec2(5, 17), uvec2(1, 100), uvec2(100, 1), uvec2(16, 9)}) {
    std::vector<int> hits(size.x * size.y, 0);
    for (uint number = 0; number < size.x * size.y; ++number) {
      const uvec2 at = pixel_position(number, size.x, size.y);
      ASSERT_LT(at.x, size.x);
      ASSERT_LT(at.y, size.y);
      ++hits[at.y * size.x + at.x];
    }
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), size.x * size.y);
  }
  for (uint number = 64; number < 128; ++number) {
    const uvec2 at = pixel_position(number, 640, 480);
    EXPECT_TRUE(at.x / 8u == 1u && at.y / 8u == 0u) << number;
  }
}

}  // namespace
}  // namespace ppm::shared
