// Boxes of index 1 that nest and overlap: light goes straight on, and what is left of it tells in
// which medium every stretch of its way lay.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "media_materials.hpp"
#include "pane.hpp"
#include "render_harness.hpp"

namespace ppm::test {
namespace {

/// A box of index 1: light goes straight on and is only absorbed.
struct Haze {
  glm::dvec3 low, high;
  glm::dvec3 attenuation;  // left after a metre
  int priority;
  bool inside_out = false;  // hollow: its front faces its inside
};

/// Where a line is within a box: distances, the second below the first where it is not.
glm::dvec2 span_of(const Haze& haze, glm::dvec3 origin, glm::dvec3 direction) {
  glm::dvec2 span(0.0, 1e9);
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (haze.low[axis] - origin[axis]) / direction[axis];
    const double b = (haze.high[axis] - origin[axis]) / direction[axis];
    span = {std::max(span.x, std::min(a, b)), std::min(span.y, std::max(a, b))};
  }
  return span;
}

/// Transmittance up to `end`, each stretch attenuated by the box of the highest priority that it
/// lies in. Hollow boxes take one layer of their material away.
glm::dvec3 transmittance(const std::vector<Haze>& boxes, glm::dvec3 origin, glm::dvec3 direction,
                         double end) {
  std::vector<double> cuts{0.0, end};
  for (const Haze& haze : boxes) {
    const glm::dvec2 span = span_of(haze, origin, direction);
    if (span.x < span.y) {
      cuts.push_back(std::min(span.x, end));
      cuts.push_back(std::min(span.y, end));
    }
  }
  std::sort(cuts.begin(), cuts.end());
  glm::dvec3 left(1.0);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
    const Haze* best = nullptr;
    for (const Haze& haze : boxes) {
      if (haze.inside_out) continue;
      int layers = 0;  // of this material
      for (const Haze& other : boxes) {
        const glm::dvec2 span = span_of(other, origin, direction);
        const bool within = span.x < middle && middle < span.y;
        if (within && other.priority == haze.priority) layers += other.inside_out ? -1 : 1;
      }
      if (layers > 0 && (best == nullptr || haze.priority > best->priority)) best = &haze;
    }
    if (best != nullptr) left *= glm::pow(best->attenuation, glm::dvec3(cuts[i + 1] - cuts[i]));
  }
  return left;
}

// Overlapping, nested, corner in corner, two of one material, a hollow in a solid; no more than
// four at any place. Prime-ish numbers keep faces apart.
const std::vector<Haze> kBoxes{
    {{-0.91, -0.71, -0.83}, {0.37, 0.41, 0.29}, {0.5, 0.7, 0.9}, 1},
    {{-0.13, -0.47, -0.31}, {0.89, 0.67, 0.73}, {0.9, 0.4, 0.6}, 2},
    {{-0.67, -0.53, -0.61}, {-0.19, 0.11, 0.07}, {0.3, 0.8, 0.5}, 3},
    {{0.23, -0.59, 0.17}, {0.79, -0.03, 0.97}, {0.9, 0.4, 0.6}, 2},
    {{0.31, 0.05, -0.11}, {0.61, 0.43, 0.37}, {0.9, 0.4, 0.6}, 2, true},
    {{-0.43, 0.13, -0.37}, {0.17, 0.83, 0.19}, {0.6, 0.6, 0.2}, 0},
};

struct HazeCamera {
  const char* name;
  glm::dvec3 eye;
};
void PrintTo(const HazeCamera& camera, std::ostream* stream) {
  *stream << camera.name;
}
using HazeView = RenderTest;
class HazeTest : public RenderTest, public ::testing::WithParamInterface<HazeCamera> {};

// Every pixel on its own, one eye path through it: what a path starts from is not known to the
// test, so that a pixel is compared with the range of what its corners and centre see. Pixels are
// narrow enough for that range to be a few hundredths wide where a box's edge cuts through, and
// 1e-3 elsewhere. The floor is the only light.
TEST_P(HazeTest, AttenuatesByTheBestRankAtEveryPlace) {
  const glm::dvec3 eye = GetParam().eye;
  GltfWriter writer;
  for (const Haze& haze : kBoxes) {
    Mesh mesh = box(haze.low, haze.high);
    if (haze.inside_out) mesh = inside_out(mesh);
    writer.mesh(mesh,
                writer.material(with_priority(glass(1.0, haze.attenuation, 1.0), haze.priority)));
  }
  writer.mesh(quad({-20, -1.5, -20}, {0, 0, 40}, {40, 0, 0}), writer.material(emitter({1, 1, 1})));
  const double yfov = 1.1;
  writer.camera("down", eye, {eye.x, eye.y - 1.0, eye.z}, yfov, 1.0, {0.0, 0.0, -1.0});
  const scene::Scene scene = load(writer);
  render::Settings settings = small_settings(scene, 48, 48, 1);
  const render::Picture picture = render_scene(device(), scene, settings, 1).picture;
  const double half = std::tan(yfov / 2.0);
  unsigned narrow = 0;
  for (std::uint32_t y = 0; y < 48; ++y) {
    for (std::uint32_t x = 0; x < 48; ++x) {
      glm::dvec3 least(1e9), most(0.0);
      for (const double dx : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        for (const double dy : {0.0, 0.25, 0.5, 0.75, 1.0}) {
          const glm::dvec3 to((2.0 * (x + dx) / 48.0 - 1.0) * half, -1.0,
                              (2.0 * (y + dy) / 48.0 - 1.0) * half);
          const double length = glm::length(to);
          const glm::dvec3 sees = transmittance(kBoxes, eye, to / length, (eye.y + 1.5) * length);
          least = glm::min(least, sees);
          most = glm::max(most, sees);
        }
      }
      narrow += most.x - least.x < 0.02 ? 1 : 0;
      // Origins are offset by 2^-20 of the working frame's 32 units at up to 16 surfaces, of
      // absorption up to 1.6 a metre.
      const glm::dvec3 slack = 0.25 * (most - least) + 2e-3;
      for (int channel = 0; channel < 3; ++channel) {
        ASSERT_GE(pixel(picture, x, y)[channel], least[channel] - slack[channel]) << x << ' ' << y;
        ASSERT_LE(pixel(picture, x, y)[channel], most[channel] + slack[channel]) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(narrow, 1500u);
}

// Outside of all, in one, in the overlap of several, in the hollow.
INSTANTIATE_TEST_SUITE_P(Cameras, HazeTest,
                         ::testing::Values(HazeCamera{"outside", {0.0, 2.1, 0.0}},
                                           HazeCamera{"in_one", {0.7, 0.3, 0.6}},
                                           HazeCamera{"in_three", {0.05, 0.35, 0.1}},
                                           HazeCamera{"in_the_hollow", {0.45, 0.2, 0.13}}),
                         [](const auto& test) { return std::string(test.param.name); });

// A box that glows, in one that outranks it: light does not notice its faces, but the eye sees
// them. Straight down through a narrow camera: ways are longer by at most 1.3e-3 of themselves, of
// absorption up to 1.4 in all.
TEST_F(HazeView, FacesThatGlowAreSeenWhereLightGoesStraightOn) {
  const glm::dvec3 glow(0.5, 2.0, 1.0), floor(1.0, 1.0, 3.0), left(0.5, 0.7, 0.9);
  GltfWriter writer;
  writer.mesh(box({-1, -1, -1}, {1, 1, 1}),
              writer.material(with_priority(glass(1.0, left, 1.0), 1)));
  writer.mesh(box({-0.5, -0.5, -0.5}, {0.5, 0.25, 0.5}),
              writer.material(with_emission(glass(1.0, glm::dvec3(0.1), 1.0), glow)));
  writer.mesh(quad({-2, -1.5, -2}, {0, 0, 4}, {4, 0, 0}), writer.material(emitter(floor)));
  writer.camera("down", {0.0, 2.0, 0.0}, {0.0, 0.0, 0.0}, 0.1, 1.0, {0.0, 0.0, -1.0});
  const scene::Scene scene = load(writer);
  const glm::dvec3 expected =
      glow * glm::pow(left, glm::dvec3(0.75)) + floor * glm::pow(left, glm::dvec3(2.0));
  for (const char* method : {"ppm", "pt"}) {  // paths end by roulette in the second
    render::Settings settings = small_settings(scene, 8, 8, 1);
    settings.integrator = method;
    const Estimate estimate = replicate(device(), scene, settings, 8, 4, whole(settings));
    EXPECT_TRUE(agrees(estimate, expected, 9.0, 3e-3 * expected)) << method;
  }
}

}  // namespace
}  // namespace ppm::test
