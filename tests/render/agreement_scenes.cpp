#include "agreement_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "angles.hpp"
#include "pane.hpp"
#include "plate.hpp"
#include "shared/bsdf/clearcoat.h"

namespace ppm::test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kAlbedo(0.8, 0.5, 0.3);

// ---- Furnaces (furnace_test.cpp): radiance e / (1 - rho) everywhere, in any closed room

const glm::dvec3 kGlow(0.5, 1.0, 0.25), kWall(0.3, 0.8, 0.1);

GltfWriter furnace() {
  GltfWriter writer;
  writer.mesh(inside_out(icosphere(2, Shading::flat)),
              writer.material(with_emission(lambert(kWall), kGlow)));
  writer.camera("inside", {0.1, 0.0, 0.4}, {0.1, 0.05, -1.0}, 1.2);
  return writer;
}

json half_covering(json material) {
  material["alphaMode"] = "BLEND";
  material["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 1.0, 1.0, 0.5};
  return material;
}

json coated(json material) {
  material["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1.0}};
  return material;
}

// None of them loses energy, so that none shows: a white ball in a glass cube, a half covering
// mirror, a sheet of glass, a white ball under a clear coat.
GltfWriter furnace_with_guests() {
  GltfWriter writer = furnace();
  const auto white = lambert(glm::dvec3(1.0));
  const auto cube = box(glm::vec3(-1.0f), glm::vec3(1.0f));
  writer.mesh(cube, writer.material(glass(1.5)), placed({-0.25, -0.2, -0.3}, 0.2));
  writer.mesh(icosphere(1, Shading::flat), writer.material(white),
              placed({-0.25, -0.2, -0.3}, 0.15));
  writer.mesh(cube, writer.material(half_covering(metal(glm::dvec3(1.0)))),
              placed({0.35, 0.25, -0.3}, 0.15));
  writer.mesh(quad({-0.4f, 0.1f, 0.0f}, {0.4f, 0, 0}, {0, 0.3f, 0}),
              writer.material(thin_glass(1.5)));
  writer.mesh(icosphere(2, Shading::flat), writer.material(coated(white)),
              placed({0.3, -0.2, -0.2}, 0.2));
  return writer;
}

std::vector<glm::dvec3> everywhere(glm::dvec3 radiance) {
  const std::size_t blocks = kAgreementPixels / kAgreementBlock;
  return std::vector<glm::dvec3>(blocks * blocks, radiance);
}

// ---- A Lambertian plate seen from above

PlateView plate_view() {
  PlateView view;
  view.eye = {0.1, 0.3, -0.05};
  view.pixels = kAgreementPixels;
  view.block = kAgreementBlock;
  return view;
}

GltfWriter lit_plate() {
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(kAlbedo)));
  plate_view().add_camera(writer);
  return writer;
}

/// By 16 x 16 midpoints a block, which errs by less than 1e-3 (plate.cpp).
std::vector<glm::dvec3> plate_blocks(const std::function<glm::dvec3(glm::dvec2)>& radiance) {
  constexpr int kSamples = 16;
  const PlateView view = plate_view();
  std::vector<glm::dvec3> blocks;
  for (std::uint32_t y = 0; y < view.pixels; y += view.block) {
    for (std::uint32_t x = 0; x < view.pixels; x += view.block) {
      glm::dvec3 sum(0.0);
      for (int i = 0; i < kSamples * kSamples; ++i) {
        sum += radiance(view.point(x + view.block * ((i % kSamples + 0.5) / kSamples),
                                   y + view.block * ((i / kSamples + 0.5) / kSamples)));
      }
      blocks.push_back(sum / static_cast<double>(kSamples * kSamples));
    }
  }
  return blocks;
}

std::vector<glm::dvec3> plate_blocks_of(const Irradiance& irradiance) {
  return plate_blocks([&](glm::dvec2 p) { return kAlbedo / kPi * irradiance(p); });
}

glm::dvec3 on_plate(glm::dvec2 p) {
  return {p.x, 0.0, p.y};
}

const glm::dvec3 kLamp(-0.1, 0.5, 0.2), kLampColor(1.0, 0.6, 0.3);

double cosine_over_square(glm::dvec3 light, glm::dvec2 p) {
  const glm::dvec3 to_light = light - on_plate(p);
  const double d2 = glm::dot(to_light, to_light);
  return to_light.y / (d2 * std::sqrt(d2));
}

// A point light of limited range, a spot and a directional one.
constexpr double kRange = 0.7, kInner = 0.3, kOuter = 0.6;
const glm::dvec3 kSpot(0.05, 0.6, 0.0), kSpotColor(0.4, 1.0, 0.7), kSunColor(0.2, 0.3, 0.9);
const glm::dvec3 kSpotAxis = glm::normalize(glm::dvec3(0.15, -1.0, 0.1));
const glm::dvec3 kSunAxis = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));

GltfWriter punctual_lights() {
  GltfWriter writer = lit_plate();
  writer.point_light(kLamp, kLampColor, 3.0);
  writer.document()["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = kRange;
  writer.spot_light(kSpot, kSpotAxis, kSpotColor, 2.0, kInner, kOuter);
  writer.directional_light(kSunAxis, kSunColor, 2.0);
  return writer;
}

glm::dvec3 from_punctual_lights(glm::dvec2 p) {
  const double ratio = glm::length(kLamp - on_plate(p)) / kRange;
  const double window = std::clamp(1.0 - std::pow(ratio, 4.0), 0.0, 1.0);
  const double cosine = glm::dot(glm::normalize(on_plate(p) - kSpot), kSpotAxis);
  const double ramp =
      std::clamp((cosine - std::cos(kOuter)) / (std::cos(kInner) - std::cos(kOuter)), 0.0, 1.0);
  return window * 3.0 * kLampColor * cosine_over_square(kLamp, p) +
         ramp * ramp * 2.0 * kSpotColor * cosine_over_square(kSpot, p) -
         2.0 * kSunColor * kSunAxis.y;
}

// Front down and towards +z.
const glm::dvec3 kCorner(-0.35, 0.6, -0.15), kEdgeU(0.5, 0.0, 0.0), kEdgeV(0.0, 0.15, 0.26);
const glm::dvec3 kRadiance(2.0, 3.0, 5.0);

GltfWriter rectangle(json material) {
  GltfWriter writer = lit_plate();
  writer.mesh(quad(kCorner, kEdgeU, kEdgeV), writer.material(std::move(material)));
  return writer;
}

// Form factor by midpoints, to 1e-4; `share` of what leaves at a cosine.
glm::dvec3 from_rectangle(glm::dvec2 p, const std::function<double(double)>& share) {
  constexpr int kSteps = 40;
  const glm::dvec3 area = glm::cross(kEdgeU, kEdgeV);
  double sum = 0.0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const glm::dvec3 to_light = kCorner + kEdgeU * ((i % kSteps + 0.5) / kSteps) +
                                kEdgeV * ((i / kSteps + 0.5) / kSteps) - on_plate(p);
    const double d2 = glm::dot(to_light, to_light);
    const double at_light = std::max(-glm::dot(area, to_light), 0.0);
    const double cosine = at_light / (std::sqrt(d2) * glm::length(area));
    sum += share(cosine) * at_light * to_light.y / (d2 * d2);
  }
  return kRadiance * (sum / (kSteps * kSteps));
}

// ---- The sky

// Bright around one row and column, so that choosing directions well matters.
glm::dvec3 sky_texel(std::uint32_t column, std::uint32_t row) {
  return glm::dvec3(1.0, 1.5, 2.0) + (column == 5 && row == 1 ? 40.0 : 0.0);
}
constexpr std::uint32_t kSkyHeight = 8;

// Under a lamp of twice its power, too, lest the sky be chosen always.
scene::Scene plate_under_sky() {
  GltfWriter writer = lit_plate();
  writer.point_light(kLamp, kLampColor, 20.0);
  scene::Scene scene = load(writer);
  scene::Environment sky;
  sky.name = "test";
  sky.width = 2 * kSkyHeight;
  sky.height = kSkyHeight;
  for (std::uint32_t row = 0; row < kSkyHeight; ++row)
    for (std::uint32_t column = 0; column < 2 * kSkyHeight; ++column)
      sky.texels.push_back(sky_texel(column, row));
  scene.environment = sky;
  return scene;
}

// pi L of the constant part, and the tent of the bright texel by midpoints.
glm::dvec3 from_sky() {
  constexpr int kSteps = 200;
  const double step = kPi / kSkyHeight;  // of a texel, in latitude and longitude alike
  double sum = 0.0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const double down = (i / kSteps + 0.5) / kSteps * 2.0 - 1.0;
    const double aside = (i % kSteps + 0.5) / kSteps * 2.0 - 1.0;
    const double polar = (1.5 + down) * step;
    sum += (1.0 - std::abs(down)) * (1.0 - std::abs(aside)) * std::cos(polar) * std::sin(polar);
  }
  return kPi * sky_texel(0, 0) + 40.0 * sum * 4.0 * step * step / (kSteps * kSteps);
}

// ---- What lies between

constexpr double kMirrorColor = 0.9, kCeilingHeight = 0.7;

// The camera looks down into a mirror, which shows a ceiling above the camera under its lamp.
GltfWriter mirrored_ceiling() {
  GltfWriter writer;
  writer.mesh(plate(0.0f, 2.0f), writer.material(metal(glm::dvec3(kMirrorColor))));
  writer.mesh(plate(static_cast<float>(kCeilingHeight), 3.0f, false),
              writer.material(lambert(kAlbedo)));
  writer.point_light({-0.1, kCeilingHeight - 0.5, 0.2}, kLampColor, 3.0);
  plate_view().add_camera(writer);
  return writer;
}

glm::dvec3 in_mirror(glm::dvec2 p) {
  const glm::dvec3 eye = plate_view().eye;
  const glm::dvec2 aside = p - glm::dvec2(eye.x, eye.z);
  const glm::dvec2 seen = p + aside * (kCeilingHeight / eye.y);
  const double cosine = eye.y / std::sqrt(eye.y * eye.y + glm::dot(aside, aside));
  const double schlick = kMirrorColor + (1.0 - kMirrorColor) * std::pow(1.0 - cosine, 5.0);
  return schlick * kAlbedo / kPi * 3.0 * kLampColor * cosine_over_square(kLamp, seen);
}

// A panel seen through a pane that absorbs and disperses (glass_test.cpp, dispersion_test.cpp).
constexpr double kDispersion = 8.0;
const Pane kPane{.name = "coloured",
                 .ior = 1.6,
                 .attenuation = {0.9, 0.4, 0.1},
                 .distance = 1.0,
                 .thickness = 0.5};

scene::Scene panel_behind_pane() {
  GltfWriter writer;
  kPane.add_to(writer, 30.0);
  writer.mesh(quad({-30, -1, -30}, {0, 0, 60}, {60, 0, 0}), writer.material(emitter(kRadiance)));
  writer.camera("down", {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, 2.0, 1.0, {0.0, 0.0, -1.0});
  scene::Scene scene = load(writer);
  scene.materials.at(0).dispersion = static_cast<float>(kDispersion);
  return scene;
}

glm::dvec3 through_pane(double cosine) {
  glm::dvec3 radiance;
  for (int channel = 0; channel < 3; ++channel) {
    Pane pane = kPane;
    pane.ior += (channel - 1) * 0.025 * (kPane.ior - 1.0) * kDispersion;
    radiance[channel] = kRadiance[channel] * shares(pane, cosine).transmitted[channel];
  }
  return radiance;
}

// The panel halfway down in the glass: radiance that leaves it is divided by the squared index, and
// what the face reflects back falls on black (glass_test.cpp).
GltfWriter panel_in_pane() {
  GltfWriter writer;
  kPane.add_to(writer, 30.0);
  const auto y = static_cast<float>(kPane.thickness / 2.0);
  writer.mesh(quad({-29, y, -29}, {0, 0, 58}, {58, 0, 0}), writer.material(emitter(kRadiance)));
  writer.camera("down", {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, 2.0, 1.0, {0.0, 0.0, -1.0});
  return writer;
}

glm::dvec3 out_of_pane(double cosine) {
  const double length = kPane.thickness / 2.0 / refracted_cosine(cosine, kPane.ior);
  return kRadiance * glm::pow(kPane.attenuation, glm::dvec3(length / kPane.distance)) *
         ((1.0 - interface_reflectance(cosine, kPane.ior)) / (kPane.ior * kPane.ior));
}

// All within an absorbing solid; another that it outranks lies between lamp and plate.
const glm::dvec3 kClarity(0.5, 0.2, 0.7);  // left after a length of 1

GltfWriter plate_in_glass() {
  GltfWriter writer = lit_plate();
  const auto solid = [&](glm::vec3 low, glm::vec3 high, json material, int priority) {
    material["extras"]["priority"] = priority;
    writer.mesh(box(low, high), writer.material(material));
  };
  solid({-1.0f, -0.3f, -1.0f}, {1.0f, 1.0f, 1.0f}, glass(1.5, kClarity, 1.0), 2);
  solid({-0.9f, 0.1f, -0.9f}, {0.9f, 0.2f, 0.9f}, glass(1.2, {0.1, 0.1, 0.1}, 0.1), 1);
  writer.point_light(kLamp, kLampColor, 3.0);
  return writer;
}

glm::dvec3 in_glass(glm::dvec2 p) {
  const double length =
      glm::length(kLamp - on_plate(p)) + glm::length(plate_view().eye - on_plate(p));
  return kAlbedo / kPi * 3.0 * kLampColor * cosine_over_square(kLamp, p) *
         glm::pow(kClarity, glm::dvec3(length));
}

// Between plate and lamp, and camera: each path passes it twice. Beside them what glows only in the
// eye (KHR_materials_unlit).
GltfWriter plate_under_veil() {
  GltfWriter writer = lit_plate();
  json poster = lambert(glm::dvec3(1.0));
  poster["extensions"]["KHR_materials_unlit"] = json::object();
  writer.mesh(quad({-0.8f, 0.0f, -0.75f}, {1.6f, 0, 0}, {0, 0.35f, 0}), writer.material(poster));
  json veil = lambert(glm::dvec3(0.0));
  veil["alphaMode"] = "BLEND";
  veil["pbrMetallicRoughness"]["baseColorFactor"] = {0.0, 0.0, 0.0, 0.3};
  writer.mesh(plate(0.15f, 0.8f), writer.material(veil));
  writer.point_light(kLamp, kLampColor, 3.0);
  return writer;
}

double all(double /*cosine*/) {
  return 1.0;
}
double half(double /*cosine*/) {
  return 0.5;
}
double through_coat(double cosine) {
  return shared::clearcoat_transmittance({1.0f, 0.0f}, static_cast<float>(cosine));
}

}  // namespace

std::vector<AgreementScene> agreement_scenes() {
  using Settings = const render::Settings&;
  const auto plates = [](glm::dvec3 (*irradiance)(glm::dvec2)) {
    return [irradiance](Settings) { return plate_blocks_of(irradiance); };
  };
  const auto rectangles = [](double (*share)(double)) {
    return [share](Settings) {
      return plate_blocks_of([share](glm::dvec2 p) { return from_rectangle(p, share); });
    };
  };
  return {
      {"furnace", 0, 1e-4, 8, [] { return load(furnace()); },
       [](Settings) { return everywhere(kGlow / (1.0 - kWall)); }},
      {"furnace_of_two_events", 2, 1e-4, 8, [] { return load(furnace()); },
       [](Settings) { return everywhere(kGlow * (1.0 + kWall + kWall * kWall)); }},
      {"furnace_with_guests", 0, 1e-4, 8, [] { return load(furnace_with_guests()); },
       [](Settings) { return everywhere(kGlow / (1.0 - kWall)); }},
      {"punctual_lights", 0, 1e-3, 32, [] { return load(punctual_lights()); },
       plates(from_punctual_lights)},
      {"rectangle", 0, 1e-3, 32, [] { return load(rectangle(emitter(kRadiance))); },
       rectangles(all)},
      {"half_covering_rectangle", 0, 1e-3, 32,
       [] { return load(rectangle(half_covering(emitter(kRadiance)))); }, rectangles(half)},
      {"coated_rectangle", 1, 1e-3, 32, [] { return load(rectangle(coated(emitter(kRadiance)))); },
       rectangles(through_coat)},
      {"sky", 0, 1e-3, 32, plate_under_sky,
       [](Settings) {
         return plate_blocks_of([sky = from_sky()](glm::dvec2 p) {
           return sky + 20.0 * kLampColor * cosine_over_square(kLamp, p);
         });
       }},
      {"mirror", 2, 1e-3, 32, [] { return load(mirrored_ceiling()); },
       [](Settings) { return plate_blocks(in_mirror); }},
      {"pane", 0, 1e-3, 32, panel_behind_pane,
       [](Settings settings) { return expected_blocks(settings, kAgreementBlock, through_pane); }},
      {"panel_in_pane", 0, 1e-3, 8, [] { return load(panel_in_pane()); },
       [](Settings settings) { return expected_blocks(settings, kAgreementBlock, out_of_pane); }},
      {"glass_all_around", 1, 1e-3, 32, [] { return load(plate_in_glass()); },
       [](Settings) { return plate_blocks(in_glass); }},
      {"veil", 0, 1e-3, 32, [] { return load(plate_under_veil()); }, plates([](glm::dvec2 p) {
         return 0.7 * 0.7 * 3.0 * kLampColor * cosine_over_square(kLamp, p);
       })},
  };
}

GltfWriter glossy_room() {
  GltfWriter writer;
  const auto white = writer.material(lambert(glm::dvec3(0.7)));
  writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))), white);
  writer.mesh(quad({-0.35f, 0.9f, -0.35f}, {0.7f, 0, 0}, {0, 0, 0.7f}),
              writer.material(coated(emitter({8.0, 7.0, 6.0}))));
  writer.mesh(icosphere(2), writer.material(metal({0.9, 0.7, 0.4}, 0.5)),
              placed({0.45, -0.55, -0.3}, 0.4));
  json frosted = glass(1.5, {0.6, 0.9, 0.7}, 0.5);
  frosted["pbrMetallicRoughness"]["roughnessFactor"] = 0.6;
  writer.mesh(icosphere(2), writer.material(frosted), placed({-0.4, -0.55, -0.2}, 0.35));
  writer.mesh(quad({-0.5f, 0.2f, -0.6f}, {1.0f, 0, 0}, {0, 0.5f, 0}),
              writer.material(half_covering(lambert({0.2, 0.4, 0.8}))));
  writer.point_light({0.6, 0.3, 0.5}, {0.3, 0.4, 1.0}, 0.4);
  writer.camera("door", {0.0, 0.125, 0.95}, {0.0, -0.2, -1.0}, 1.0);
  return writer;
}

}  // namespace ppm::test
