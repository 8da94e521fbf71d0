// Weights of multiple importance sampling: all ways in which one path may come about, enumerated.
//
// Beside the recursion of shared/bidirectional.h, in single precision, stand products of densities
// in double, way by way: p of the light's vertices from the light on, times p of the camera's from
// the camera on. A way's weight is its product over the sum of all. Of the path nothing is known
// but densities, cosines and distances, so that any numbers will do; a specular vertex is the limit
// of lobes narrower and narrower, whose densities are those of the direction times a large number.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "shared/bidirectional.h"

namespace ppm::test {
namespace {

using shared::PathMis;

constexpr double kNarrow = 1e9;  // what a specular lobe's density is greater by

enum class Source { area, point, sky, sun };

struct Vertex {
  double to_light, to_camera;  // cosines with the geometric normal
  double forward, reverse;     // densities of going on to the camera, and to the light
  bool specular;
  double jacobian;  // of the way to the light, over that to the camera
};

// x_0 on the light, vertices[i] = x_{i+1}, then the camera.
struct Path {
  Source source;
  std::vector<Vertex> vertices;
  std::vector<double> distances;  // distances[i] between x_i and x_{i+1}
  double probability, position_pdf, direction_pdf, light_cosine;
  double camera_pdf;  // per solid angle
  double light_paths;
};

bool infinite(const Path& path) {
  return path.source == Source::sky || path.source == Source::sun;
}
bool hittable(const Path& path) {
  return path.source == Source::area || path.source == Source::sky;
}
double narrowed(double density, const Vertex& vertex) {
  return vertex.specular ? density * kNarrow : density;
}

Path random_path(std::mt19937& random, Source source, std::size_t length, double specular_share) {
  const auto between = [&](double low, double high) {
    return std::exp(std::uniform_real_distribution(std::log(low), std::log(high))(random));
  };
  Path path{source,
            {},
            {},
            between(0.01, 1.0),
            between(0.1, 100.0),
            between(0.05, 5.0),
            between(0.1, 1.0),
            between(10.0, 1e5),
            between(100.0, 1e6)};
  if (source != Source::area) path.light_cosine = 1.0;
  if (source == Source::point) path.position_pdf = 1.0;
  if (source == Source::sun) path.direction_pdf = 1.0;
  for (std::size_t i = 0; i < length; ++i) {
    path.vertices.push_back({between(0.1, 1.0), between(0.1, 1.0), between(0.05, 3.0),
                             between(0.05, 3.0), between(1e-3, 1.0) < specular_share * 0.03,
                             between(0.4, 2.5)});
    path.distances.push_back(between(0.05, 2.0));
  }
  path.distances.push_back(between(0.05, 2.0));
  return path;
}

/// Of each way, by the number s of light vertices, x_0 among them: nothing where there is none.
std::vector<std::optional<double>> densities(const Path& path, unsigned ways) {
  const std::size_t n = path.vertices.size();
  // light[s]: x_0 .. x_{s-1} from the light; camera[k]: x_k .. x_n from the camera.
  std::vector<double> light(n + 2), camera(n + 2, 1.0);
  const auto per_area = [&](double density, std::size_t to, bool from_light) {
    const Vertex& vertex = path.vertices[to - 1];
    const double distance = path.distances[from_light ? to - 1 : to];
    return density * (from_light ? vertex.to_light : vertex.to_camera) / (distance * distance);
  };
  light[1] = path.probability * path.position_pdf * path.direction_pdf;
  for (std::size_t s = 2; s <= n + 1; ++s) {
    const std::size_t to = s - 1;
    if (s == 2) {
      light[s] = infinite(path)
                     ? light[1] * path.vertices[0].to_light
                     : path.probability * path.position_pdf * per_area(path.direction_pdf, 1, true);
    } else {
      const Vertex& from = path.vertices[to - 2];
      light[s] = light[s - 1] * per_area(narrowed(from.forward, from), to, true);
    }
  }
  for (std::size_t k = n; k >= 1; --k) {
    const Vertex* from = k == n ? nullptr : &path.vertices[k];
    const double density =
        from ? narrowed(from->reverse, *from) * (from->specular ? from->jacobian : 1.0)
             : path.camera_pdf;
    camera[k] = camera[k + 1] * per_area(density, k, false);
  }
  std::vector<std::optional<double>> result(n + 2);
  const auto specular = [&](std::size_t k) { return path.vertices[k - 1].specular; };
  const Vertex& last = path.vertices[0];
  if (hittable(path) && (ways & PPM_BDPT_EMITTERS) != 0) {
    const double density = narrowed(last.reverse, last) * (last.specular ? last.jacobian : 1.0);
    const double d = path.distances[0];
    result[0] = camera[1] * density * (infinite(path) ? 1.0 : path.light_cosine / (d * d));
  }
  if (!specular(1) && (ways & PPM_BDPT_NEXT_EVENT) != 0) {
    const double choice = infinite(path) ? path.direction_pdf : path.position_pdf;
    result[1] = camera[1] * path.probability * choice;
  }
  for (std::size_t s = 2; s <= n; ++s) {
    if (!specular(s - 1) && !specular(s) && (ways & PPM_BDPT_CONNECTIONS) != 0) {
      result[s] = light[s] * camera[s];
    }
  }
  if (!specular(n) && (ways & PPM_BDPT_LENS) != 0) result[n + 1] = path.light_paths * light[n + 1];
  return result;
}

/// The weight of the way with s light vertices, as the kernels find it.
double weight(const Path& path, std::size_t s, unsigned ways) {
  const auto flag = [&](unsigned way) { return (ways & way) != 0 ? 1.0f : 0.0f; };
  const auto f = [](double value) { return static_cast<float>(value); };
  const float connections = flag(PPM_BDPT_CONNECTIONS);
  const std::size_t n = path.vertices.size();
  // The light path as it arrives at x_k, k <= s - 1; the camera path as it arrives at x_k, k >= s.
  PathMis light = shared::mis_light_start(f(path.probability), f(path.position_pdf),
                                          f(path.direction_pdf), f(path.light_cosine),
                                          infinite(path) ? 1u : 0u, hittable(path) ? 1u : 0u);
  light.d_vcm *= flag(PPM_BDPT_NEXT_EVENT);
  light.d_vc *= flag(PPM_BDPT_EMITTERS);
  for (std::size_t k = 1; k + 1 <= s; ++k) {
    const Vertex& vertex = path.vertices[k - 1];
    const bool far_away = k == 1 && infinite(path);
    light =
        shared::mis_arrive(light, far_away ? 1.0f : f(path.distances[k - 1]), f(vertex.to_light));
    if (k + 1 == s) break;
    if (vertex.specular) {
      light = shared::mis_specular(light, f(vertex.to_camera), f(vertex.forward), f(vertex.reverse),
                                   f(vertex.jacobian));
    } else {
      light = shared::mis_scatter(light, f(vertex.to_camera), f(vertex.forward), f(vertex.reverse),
                                  1.0f);
      light.d_vcm *= connections;
    }
  }
  PathMis camera =
      shared::mis_camera_start(f(path.light_paths) * flag(PPM_BDPT_LENS), f(1.0 / path.camera_pdf));
  const auto connects = [&](std::size_t k) { return k == n ? 1.0f : connections; };
  const std::size_t end = s == 0 ? 1 : s;
  for (std::size_t k = n; k >= end; --k) {
    const Vertex& vertex = path.vertices[k - 1];
    camera = shared::mis_arrive(camera, f(path.distances[k]), f(vertex.to_camera));
    if (k == end && s > 0) break;
    if (vertex.specular) {
      camera = shared::mis_specular(camera, f(vertex.to_light), f(vertex.reverse),
                                    f(vertex.forward), f(1.0 / vertex.jacobian));
    } else {
      camera = shared::mis_scatter(camera, f(vertex.to_light), f(vertex.reverse), f(vertex.forward),
                                   connects(k));
    }
  }
  const double d0 = path.distances[0];
  if (s == 0) {
    const double choice =
        path.probability * (infinite(path) ? path.direction_pdf : path.position_pdf);
    const double emit = path.probability * path.position_pdf * path.direction_pdf;
    if (!infinite(path)) {
      camera = shared::mis_arrive(camera, f(d0), f(path.light_cosine));
    }
    return shared::mis_emitter(camera, f(choice), f(emit), flag(PPM_BDPT_NEXT_EVENT));
  }
  if (s == 1) {
    const Vertex& vertex = path.vertices[0];
    const double choice = path.source == Source::area
                              ? path.position_pdf * d0 * d0 / path.light_cosine
                              : path.direction_pdf;
    const double emitter = hittable(path) && (ways & PPM_BDPT_EMITTERS) != 0
                               ? vertex.reverse / (path.probability * choice)
                               : 0.0;
    const double pdf_area = infinite(path) ? path.position_pdf * vertex.to_light
                                           : path.direction_pdf * vertex.to_light / (d0 * d0);
    return 1.0 / (1.0 + emitter +
                  shared::mis_others(camera, f(pdf_area), f(vertex.forward), connects(1)));
  }
  const Vertex& of_light = path.vertices[s - 2];
  if (s == n + 1) {
    const double d = path.distances[n];
    const double pdf_area = path.camera_pdf * of_light.to_camera / (d * d * path.light_paths);
    return 1.0 / (1.0 + shared::mis_others(light, f(pdf_area), f(of_light.reverse), 1.0f));
  }
  const Vertex& of_camera = path.vertices[s - 1];
  const double d2 = path.distances[s - 1] * path.distances[s - 1];
  return 1.0 / (1.0 +
                shared::mis_others(light, f(of_camera.reverse * of_light.to_camera / d2),
                                   f(of_light.reverse), 1.0f) +
                shared::mis_others(camera, f(of_light.forward * of_camera.to_light / d2),
                                   f(of_camera.forward), connects(s)));
}

class BidirectionalWeights : public ::testing::TestWithParam<Source> {};

TEST_P(BidirectionalWeights, AreDensitiesOverTheirSum) {
  std::mt19937 random(7);
  std::size_t ways_seen = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto length = static_cast<std::size_t>(1 + i % 6);
    const Path path = random_path(random, GetParam(), length, i % 2 == 0 ? 0.0 : 0.7);
    const unsigned ways = i % 5 == 0 ? 1 + static_cast<unsigned>(i / 5) % 15 : PPM_BDPT_ALL;
    const auto density = densities(path, ways);
    double sum = 0.0, weights = 0.0;
    for (const auto& d : density) sum += d.value_or(0.0);
    for (std::size_t s = 0; s < density.size(); ++s) {
      if (!density[s]) continue;
      ++ways_seen;
      // A way that must sample a specular direction by chance would have no part in the sum; the
      // camera's last vertex before an emitter may be specular.
      const double w = weight(path, s, ways);
      ASSERT_NEAR(w, *density[s] / sum, 2e-4)
          << "path " << i << " of " << length << ", s = " << s << ", ways " << ways;
      weights += w;
    }
    if (sum > 0.0) {
      ASSERT_NEAR(weights, 1.0, 2e-4) << "path " << i << " of " << length;
    }
  }
  EXPECT_GT(ways_seen, 6000u);
}

std::string name_of(const ::testing::TestParamInfo<Source>& info) {
  constexpr const char* kNames[] = {"Area", "Point", "Sky", "Sun"};
  return kNames[static_cast<int>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Lights, BidirectionalWeights,
                         ::testing::Values(Source::area, Source::point, Source::sky, Source::sun),
                         name_of);

}  // namespace
}  // namespace ppm::test
