// Opaque materials in light that comes alike from everywhere, and shading normals.
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "facets.hpp"
#include "render_harness.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;
constexpr double kSigmas = 5.0;  // of 8 seeds: Student's t with 7 degrees, 0.16 %
constexpr unsigned kPasses = 4, kSeeds = 8;

// ---- Directional albedo

/// What a GGX surface with Schlick's Fresnel term reflects of all light from one direction.
glm::dvec3 glossy_albedo(double alpha, glm::dvec3 f0, double cosine) {
  return {coat_share(alpha, f0.x, 1.0, cosine), coat_share(alpha, f0.y, 1.0, cosine),
          coat_share(alpha, f0.z, 1.0, cosine)};
}

struct Finish {
  const char* name;
  double roughness, cosine;  // of the view
  bool metal;
};
void PrintTo(const Finish& finish, std::ostream* stream) {
  *stream << finish.name;
}

class Glossy : public RenderTest, public ::testing::WithParamInterface<Finish> {};

// A black shell that emits e lights a small sheet alike from all sides, and nothing comes back: the
// sheet shows e times its directional albedo. A metal's is the glossy lobe's. A dielectric adds its
// base b under a coat of Schlick's F with f0 = 0.04: f = b/pi (1-F(o)) (1-F(i)) / (1-F_avg), the
// integral of which is b (1-F(o)). Irradiance is constant, and the pixels' discs end well within
// the sheet: no bias but 16-bit parameters and directions, 1e-4 of them each, which the lobe's
// slope magnifies by less than 2 / alpha^2 < 10 at alpha = 0.49 and less than 40 at alpha = 0.25
// off its peak; allowed are 0.2 %. The picture is small: all of it sees the sheet within 0.02 of
// the angle.
TEST_P(Glossy, ShowsItsDirectionalAlbedo) {
  const auto& [name, roughness, cosine, is_metal] = GetParam();
  const glm::dvec3 emission(1.0, 2.0, 0.5), color(0.9, 0.5, 0.2);
  json material = metal(color, roughness);
  if (!is_metal) material["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
  GltfWriter writer;
  writer.mesh(inside_out(icosphere(2, Shading::flat)), writer.material(emitter(emission)));
  writer.mesh(quad({-0.3, 0, -0.3}, {0, 0, 0.6}, {0.6, 0, 0}), writer.material(material));
  const double sine = std::sqrt(1.0 - cosine * cosine);
  writer.camera("oblique", {0.6 * sine, 0.6 * cosine, 0.0}, {0, 0, 0}, 0.1);
  const scene::Scene scene = load(writer);
  render::Settings settings = small_settings(scene, 8, 8, 40000);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.1;
  const Estimate estimate = replicate(device(), scene, settings, kPasses, kSeeds, whole(settings));
  const double alpha = roughness * roughness, f0 = 0.04;
  const double coat = f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0);
  const glm::dvec3 albedo =
      is_metal ? glossy_albedo(alpha, color, cosine)
               : glossy_albedo(alpha, glm::dvec3(f0), cosine) + color * (1.0 - coat);
  EXPECT_TRUE(agrees(estimate, emission * albedo, kSigmas, 0.002 * emission * albedo));
}

INSTANTIATE_TEST_SUITE_P(Finishes, Glossy,
                         ::testing::Values(Finish{"rough_metal", 1.0, 0.8, true},
                                           Finish{"satin_metal", 0.7, 0.5, true},
                                           Finish{"shiny_metal", 0.5, 0.9, true},
                                           Finish{"rough_dielectric", 1.0, 0.5, false},
                                           Finish{"satin_dielectric", 0.6, 0.35, false}),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- Shading normals

// A sheet in the plane y = 0, its normals tilted towards +x by `tilt`.
Mesh tilted_sheet(float half, double tilt) {
  Mesh sheet = quad({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0});
  sheet.normals.assign(sheet.positions.size(), glm::vec3(std::sin(tilt), std::cos(tilt), 0.0f));
  return sheet;
}

class ShadingNormals : public RenderTest {
 protected:
  static constexpr double kTilt = 0.5;
  const glm::dvec3 albedo_{0.8, 0.5, 0.3}, irradiance_{3.0, 2.0, 1.0};
};

// Light of irradiance E across its way, from straight above, on a Lambertian sheet: the shading
// normal's cosine counts, L = rho E cos(tilt) / pi, where photons arrive by the geometric one's.
TEST_F(ShadingNormals, DecideHowMuchArrives) {
  GltfWriter writer;
  writer.mesh(tilted_sheet(0.5f, kTilt), writer.material(lambert(albedo_)));
  writer.directional_light({0, -1, 0}, irradiance_ / 3.0, 3.0);
  writer.camera("above", {0.2, 1.0, 0.1}, {0, 0, 0}, 0.3);
  const scene::Scene scene = load(writer);
  render::Settings settings = small_settings(scene, 8, 8, 20000);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.1;
  const Estimate estimate = replicate(device(), scene, settings, kPasses, kSeeds, whole(settings));
  const glm::dvec3 expected = albedo_ * irradiance_ * std::cos(kTilt) / kPi;
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, 2e-4 * expected));  // 16-bit directions
}

// What such a sheet sends on. It shines with L = rho E cos(tilt) / pi to where both normals see,
// and that is what lights a wall beside it, parallel to the light: E(p) = int L cos cos / r^2 dA
// over the sheet, by the geometric cosines. Two scattering events are all that is let through, so
// that the wall's light does not come back. The wall's irradiance varies across a disc; a radius of
// 0.03 at 0.35 from the sheet errs by about (R / 0.35)^2 / 8 = 0.1 % times the field's relative
// curvature, allowed is 1 %.
TEST_F(ShadingNormals, LeaveRadianceAsTheEyeWouldSeeIt) {
  constexpr float kHalf = 0.15f, kDistance = 0.5f;
  const glm::dvec3 wall_albedo(0.5);
  GltfWriter writer;
  writer.mesh(tilted_sheet(kHalf, kTilt), writer.material(lambert(albedo_)));
  writer.mesh(quad({kDistance, 0, -0.4f}, {0, 0, 0.8f}, {0, 0.8f, 0}),
              writer.material(lambert(wall_albedo)));
  writer.directional_light({0, -1, 0}, irradiance_ / 3.0, 3.0);
  writer.camera("beside", {-0.5, 0.4, 0.0}, {kDistance, 0.4, 0.0}, 0.2);
  const scene::Scene scene = load(writer);
  render::Settings settings = small_settings(scene, 8, 8, 60000);
  settings.max_depth = 2;
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.03;
  const Estimate estimate = replicate(device(), scene, settings, kPasses, kSeeds, whole(settings));

  const glm::dvec3 sheet_radiance = albedo_ * irradiance_ * std::cos(kTilt) / kPi;
  const glm::dvec3 normal(std::sin(kTilt), std::cos(kTilt), 0.0);
  constexpr int kSteps = 60, kPixels = 8;
  double geometry = 0.0;
  for (int pixel = 0; pixel < kPixels * kPixels; ++pixel) {
    const double size = 2.0 * std::tan(0.1) / kPixels;
    const glm::dvec3 p(kDistance, 0.4 + (pixel / kPixels + 0.5 - kPixels / 2) * size,
                       (pixel % kPixels + 0.5 - kPixels / 2) * size);
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const double step = 2.0 * kHalf / kSteps;
      const glm::dvec3 q(-kHalf + (i / kSteps + 0.5) * step, 0.0,
                         -kHalf + (i % kSteps + 0.5) * step);
      const glm::dvec3 way = p - q;
      ASSERT_GT(glm::dot(way, normal), 0.0);
      geometry += way.y * way.x / std::pow(glm::dot(way, way), 2.0) * step * step;
    }
  }
  const glm::dvec3 expected = wall_albedo / kPi * sheet_radiance * geometry / 64.0;
  EXPECT_TRUE(agrees(estimate, expected, kSigmas, 0.01 * expected));
}

}  // namespace
}  // namespace ppm::test
