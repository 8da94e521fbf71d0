// Panes of glass against the exact sum over their inner reflections: what they show of a luminous
// panel, and light that reaches a surface, and the eye from there, through them.
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "angles.hpp"
#include "pane.hpp"
#include "render_harness.hpp"

namespace ppm::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSigmas = 6.0;  // of 8 seeds, for some hundred means: Student's t, 5e-4 each
constexpr unsigned kSeeds = 8;

constexpr std::size_t kSolidPanes = 4;  // these come first
const std::array kPanes = {
    Pane{.name = "clear"},
    Pane{.name = "dense", .ior = 2.2},
    Pane{.name = "coloured", .attenuation = {0.9, 0.4, 0.1}, .distance = 0.1},
    Pane{.name = "tinted", .ior = 1.33, .tint = {0.9, 0.5, 0.3}},
    Pane{.name = "thin", .thin = true},
    Pane{.name = "thin_tinted", .ior = 1.9, .thin = true, .tint = {0.9, 0.5, 0.3}},
};

class PaneTest : public RenderTest, public ::testing::WithParamInterface<Pane> {
 protected:
  // Compares pictures of a camera that looks straight down with what is expected at each angle.
  // `bias` is relative.
  static void compare(const GltfWriter& writer, std::uint32_t edge, std::uint32_t block,
                      std::uint64_t photons, unsigned passes, double bias,
                      const std::function<glm::dvec3(double)>& radiance) {
    const scene::Scene scene = load(writer);
    render::Settings settings = small_settings(scene, edge, edge, photons);
    settings.radius_mode = render::RadiusMode::fixed;
    settings.radius = 0.08;
    const auto blocks =
        replicate(device(), scene, settings, passes, kSeeds,
                  [block](const render::Picture& picture) { return block_means(picture, block); });
    const auto expected = expected_blocks(settings, block, radiance);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      EXPECT_TRUE(agrees(blocks[i], expected[i], kSigmas, bias * expected[i])) << "block " << i;
  }

  static void look_down(GltfWriter& writer, double height, double yfov) {
    writer.camera("down", {0.0, height, 0.0}, {0.0, 0.0, 0.0}, yfov, 1.0, {0.0, 0.0, -1.0});
  }
};

class SolidPaneTest : public PaneTest {};

// The pane as thick as eye paths can measure well, see kEyeBias.
Pane thick(Pane pane) {
  pane.thickness *= 10.0;
  pane.distance *= 10.0;
  return pane;
}

// Panel and pane reach 30 times as far as the camera is high: no order of reflection that weighs
// anything misses them. Eye paths alone decide these pictures; their only noise is where in a pixel
// they start, and roulette among faint branches. 4 x 4 midpoints a pixel err by less than 1e-4 of
// the mean. A path inside the glass is short by the offset at its start and the rounding of its
// end, 2 * 2^-20 of the working frame's unit, here 32: by 6e-5, which is 1.2e-4 of the thickness,
// times the coloured pane's optical depth of at most ln(10) / 2 / 0.77: 1.9e-4 a crossing.
constexpr double kEyeBias = 4e-4;
const glm::dvec3 kPanelRadiance(2.0, 1.0, 0.5);

TEST_P(PaneTest, ShowsAPanelBehindIt) {
  const Pane pane = thick(GetParam());
  GltfWriter writer;
  pane.add_to(writer, 30.0);
  writer.mesh(quad({-30, -1, -30}, {0, 0, 60}, {60, 0, 0}),
              writer.material(emitter(kPanelRadiance)));
  look_down(writer, 1.0, 2.4);
  compare(writer, 48, 8, 1, 1, kEyeBias,
          [&pane](double cosine) { return kPanelRadiance * shares(pane, cosine).transmitted; });
}

TEST_P(PaneTest, MirrorsAPanelAboveIt) {
  const Pane pane = thick(GetParam());
  GltfWriter writer;
  pane.add_to(writer, 30.0);
  writer.mesh(quad({-30, 2, -30}, {60, 0, 0}, {0, 0, 60}),
              writer.material(emitter(kPanelRadiance)));
  look_down(writer, 1.0, 2.4);
  compare(writer, 48, 8, 1, 1, kEyeBias,
          [&pane](double cosine) { return kPanelRadiance * shares(pane, cosine).reflected; });
}

// A black panel inside the glass, halfway down: radiance that leaves an index n into air is divided
// by n^2, and what the face reflects back falls on black.
TEST_P(SolidPaneTest, ShowsAPanelInsideIt) {
  const Pane pane = thick(GetParam());
  GltfWriter writer;
  pane.add_to(writer, 30.0);
  const auto y = static_cast<float>(pane.thickness / 2.0);
  writer.mesh(quad({-29, y, -29}, {0, 0, 58}, {58, 0, 0}),
              writer.material(emitter(kPanelRadiance)));
  look_down(writer, 1.0, 2.4);
  compare(writer, 48, 8, 1, 1, kEyeBias, [&pane](double cosine) {
    const double length = pane.thickness / 2.0 / refracted_cosine(cosine, pane.ior);
    return kPanelRadiance * pane.tint *
           glm::pow(pane.attenuation, glm::dvec3(length / pane.distance)) *
           ((1.0 - interface_reflectance(cosine, pane.ior)) / (pane.ior * pane.ior));
  });
}

// A diffuse floor under the pane, lit through it by a directional light and seen through it: a path
// specular - diffuse - specular. With T of the pane, rho of the floor and the pane's reflectance Rd
// of the floor's light, back and forth between the two,
//   L = T(view) rho E cos(light) T(light) / (pi (1 - rho Rd)).
// Bias: the floor [-1, 1]^2 is no infinite one. What is seen of it lies within 0.45 of the centre,
// at least 0.55 from its edges. Light that left the floor comes back to it 0.55 or more away only
// at tan(angle) > (0.55 - 2 d / sqrt(n^2 - 1)) / 2 g, with the gap g = 0.02 and the thickness d =
// 0.05: below 0.9 % of cos^2-weighted light for all n here, of which the pane reflects 1 at most
// and the floor rho <= 0.6. Photons are missing nowhere near: discs have radius 0.08, and light
// that enters by the pane's sides stays in the glass. The floor's irradiance is constant: no other
// bias.
TEST_P(PaneTest, LightsAFloorThroughItself) {
  const Pane& pane = GetParam();
  const glm::dvec3 albedo(0.6, 0.4, 0.2), irradiance(3.0, 2.0, 5.0);
  const double tilt = 0.6;  // of the light, from the vertical
  GltfWriter writer;
  writer.mesh(quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}), writer.material(lambert(albedo)));
  pane.add_to(writer, 1.0, 0.02);
  writer.directional_light({std::sin(tilt), -std::cos(tilt), 0.0}, irradiance / 5.0, 5.0);
  look_down(writer, 1.5, 0.55);
  const glm::dvec3 radiosity = albedo * irradiance * std::cos(tilt) *
                               shares(pane, std::cos(tilt)).transmitted /
                               (1.0 - albedo * diffuse_reflectance(pane));
  const double bias = 0.6 * 0.009 + kEyeBias;
  compare(writer, 16, 8, 30000, 4, bias,
          [&](double cosine) { return shares(pane, cosine).transmitted * radiosity / kPi; });
}

INSTANTIATE_TEST_SUITE_P(Panes, SolidPaneTest,
                         ::testing::ValuesIn(kPanes.begin(), kPanes.begin() + kSolidPanes),
                         [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(Panes, PaneTest, ::testing::ValuesIn(kPanes),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace ppm::test
