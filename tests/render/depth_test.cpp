// --max-depth counts scattering events between light and eye: two facing plates show each of them.
#include <algorithm>
#include <cmath>

#include "plate.hpp"

namespace ppm::test {
namespace {

constexpr float kHalf = 0.8f, kHeight = 0.6f;
constexpr double kLampHeight = 0.5, kIntensity = 2.0, kInner = 0.3, kOuter = 0.6;
const glm::dvec3 kFloor(0.8, 0.6, 0.4), kCeiling(0.5, 0.7, 0.9);

// Irradiance of the floor by the spot lamp that points straight down at its centre.
double lamp(glm::dvec2 p) {
  const double d2 = glm::dot(p, p) + kLampHeight * kLampHeight;
  const double cosine = kLampHeight / std::sqrt(d2);
  const double ramp =
      std::clamp((cosine - std::cos(kOuter)) / (std::cos(kInner) - std::cos(kOuter)), 0.0, 1.0);
  return kIntensity * ramp * ramp * cosine / d2;
}

// Irradiances at the middles of kCells x kCells patches of a plate.
constexpr int kCells = 40;
constexpr double kCell = 2.0 * static_cast<double>(kHalf) / kCells;
using Patches = std::vector<glm::dvec3>;

glm::dvec2 middle(int patch) {
  return {-kHalf + kCell * (patch % kCells + 0.5), -kHalf + kCell * (patch / kCells + 0.5)};
}

// What the facing plate makes of `irradiance`: E = integral of albedo/pi * irradiance cos cos' /
// d^2 dA. Distances are 15 cells and more: the midpoint rule errs by (1/15)^2 / 24 * some 20 = 0.4
// % where the plates are closest, in one bounce, and less on average.
glm::dvec3 bounce(const Patches& irradiance, glm::dvec3 albedo, glm::dvec2 to) {
  glm::dvec3 sum(0.0);
  for (int patch = 0; patch < kCells * kCells; ++patch) {
    const glm::dvec2 across = middle(patch) - to;
    const double d2 = glm::dot(across, across) + static_cast<double>(kHeight) * kHeight;
    sum += irradiance[static_cast<std::size_t>(patch)] * (kHeight * kHeight / (d2 * d2));
  }
  return sum * albedo * (kCell * kCell / std::numbers::pi);
}

Patches bounce(const Patches& irradiance, glm::dvec3 albedo) {
  Patches result;
  for (int patch = 0; patch < kCells * kCells; ++patch)
    result.push_back(bounce(irradiance, albedo, middle(patch)));
  return result;
}

class Depth : public RenderTest {
 protected:
  Depth() {
    const auto floor = writer_.material(lambert(kFloor)),
               ceiling = writer_.material(lambert(kCeiling));
    writer_.mesh(plate(0.0f, kHalf), floor);
    writer_.mesh(plate(kHeight, kHalf, false), ceiling);
    writer_.spot_light({0.0, kLampHeight, 0.0}, {0.0, -1.0, 0.0}, glm::dvec3(1.0), kIntensity,
                       kInner, kOuter);
    view_.half = 0.3;
    view_.radius = 0.02;
    for (int patch = 0; patch < kCells * kCells; ++patch) direct_.emplace_back(lamp(middle(patch)));
  }

  void look_at_floor() {
    view_.eye = {0.05, 0.25, 0.0};
    view_.add_camera(writer_);
  }
  void look_at_ceiling() {
    view_.eye = {0.05, 0.25, 0.0};
    view_.plate_height = static_cast<double>(kHeight);
    view_.add_camera(writer_);
  }

  GltfWriter writer_;
  PlateView view_;
  Patches direct_;
};

TEST_F(Depth, OneIsDirectLightAlone) {
  look_at_ceiling();
  const scene::Scene scene = load(writer_);
  const render::Settings settings = view_.settings(scene, 1);
  const auto picture = render_scene(device(), scene, settings, 1).picture;
  EXPECT_EQ(window_mean(picture, whole(settings)), glm::dvec3(0.0));
}

TEST_F(Depth, TwoAddsOneBounce) {
  look_at_ceiling();
  expect_irradiance(
      device(), writer_, view_, kCeiling, [&](glm::dvec2 p) { return bounce(direct_, kFloor, p); },
      2, 0.004);
}

// Light that was on the floor is back on it at the third event, not at the second.
TEST_F(Depth, ThreeAddsTwo) {
  look_at_floor();
  expect_irradiance(
      device(), writer_, view_, kFloor, [&](glm::dvec2 p) { return glm::dvec3(lamp(p)); }, 2, 0.0);
  const Patches ceiling = bounce(direct_, kFloor);
  expect_irradiance(
      device(), writer_, view_, kFloor,
      [&](glm::dvec2 p) { return lamp(p) + bounce(ceiling, kCeiling, p); }, 3, 0.004);
}

// No limit: the series. Each further pair of bounces brings less than a third of the one before, so
// that ten pairs leave 2e-5.
TEST_F(Depth, NoneIsTheWholeSeries) {
  look_at_ceiling();
  Patches floor = direct_;
  for (int pair = 0; pair < 10; ++pair) {
    const Patches back = bounce(bounce(floor, kFloor), kCeiling);
    for (std::size_t i = 0; i < floor.size(); ++i) floor[i] = direct_[i] + back[i];
  }
  expect_irradiance(
      device(), writer_, view_, kCeiling, [&](glm::dvec2 p) { return bounce(floor, kFloor, p); }, 0,
      0.006);
}

// Exact Fresnel reflectance of a dielectric for unpolarised light, by Snell's law in angles.
double fresnel(double cosine, double ior) {
  const double outside = std::acos(std::min(cosine, 1.0));
  if (outside < 1e-6) return std::pow((ior - 1.0) / (ior + 1.0), 2.0);
  const double inside = std::asin(std::sin(outside) / ior);
  const double s = std::sin(outside - inside) / std::sin(outside + inside);
  const double p = std::tan(outside - inside) / std::tan(outside + inside);
  return 0.5 * (s * s + p * p);
}

// A sheet of glass between eye and plate is an event: black at depth 1; at depth 2 the plate under
// direct light, less what the sheet reflects. The light stands below the sheet.
TEST_F(Depth, GlassCounts) {
  const glm::dvec3 albedo(0.8, 0.6, 0.4), position(0.3, 0.35, 0.1);
  const double ior = 1.5;
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(albedo)));
  writer.mesh(plate(0.4f, 2.0f), writer.material(thin_glass(ior)));
  writer.point_light(position, glm::dvec3(1.0), 2.0);
  view_.eye = {0.0, 0.6, 0.0};
  view_.half = 0.4;
  view_.add_camera(writer);
  const scene::Scene scene = load(writer);
  const render::Settings settings = view_.settings(scene, 1);
  EXPECT_EQ(window_mean(render_scene(device(), scene, settings, 1).picture, whole(settings)),
            glm::dvec3(0.0));

  expect_irradiance(
      device(), writer, view_, albedo,
      [&](glm::dvec2 p) {
        const glm::dvec3 to_eye = glm::normalize(view_.eye - glm::dvec3(p.x, 0.0, p.y));
        const double reflectance = fresnel(to_eye.y, ior);
        const glm::dvec3 to_light = position - glm::dvec3(p.x, 0.0, p.y);
        const double d2 = glm::dot(to_light, to_light);
        return glm::dvec3(2.0 * to_light.y / (d2 * std::sqrt(d2)) * (1.0 - reflectance) /
                          (1.0 + reflectance));
      },
      2, 0.0);
}

// An emitter behind one sheet is one event away, behind two it is two.
TEST_F(Depth, EmittersBehindGlass) {
  const glm::dvec3 radiance(0.5, 1.0, 2.0);
  const double r = fresnel(1.0, 1.5), transmittance = (1.0 - r) / (1.0 + r);
  for (const int sheets : {1, 2}) {
    GltfWriter writer;
    writer.mesh(plate(0.0f, 1.0f), writer.material(emitter(radiance)));
    const auto sheet = writer.material(thin_glass(1.5));
    for (int i = 0; i < sheets; ++i)
      writer.mesh(plate(0.2f + 0.1f * static_cast<float>(i), 1.0f), sheet);
    view_.eye = {0.0, 0.6, 0.0};
    view_.half = 0.01;  // so that all rays are normal to the sheets, to 1e-4 in the cosine
    view_.add_camera(writer);
    const scene::Scene scene = load(writer);
    for (const std::uint32_t max_depth : {1u, 2u}) {
      const render::Settings settings = view_.settings(scene, max_depth);
      const auto mean =
          window_mean(render_scene(device(), scene, settings, 1).picture, whole(settings));
      const double expected =
          max_depth < static_cast<std::uint32_t>(sheets) ? 0.0 : std::pow(transmittance, sheets);
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(mean[channel], expected * radiance[channel], 1e-4 * radiance[channel])
            << sheets << " sheets, depth " << max_depth;
    }
  }
}

}  // namespace
}  // namespace ppm::test
