// Light from all around: what it does to a plate, and how eye paths see it, directly and by way of
// mirrors and glass, against the map's definition.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pane.hpp"
#include "plate.hpp"

namespace ppm::test {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kAlbedo(0.8, 0.5, 0.3);

using Texels = std::function<glm::dvec3(std::uint32_t column, std::uint32_t row)>;

scene::Environment sky_of(std::uint32_t height, double degrees, const Texels& texel) {
  scene::Environment sky;
  sky.name = "test";
  sky.width = 2 * height;
  sky.height = height;
  sky.strength = 0.5f;
  sky.rotation = degrees * kPi / 180.0;
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < 2 * height; ++column)
      sky.texels.push_back(texel(column, row));
  return sky;
}

/// What the sky shows in a direction: bilinear in longitude and latitude.
glm::dvec3 shown(const scene::Environment& sky, glm::dvec3 direction) {
  const double longitude = std::atan2(direction.z, direction.x) + sky.rotation;
  const double width = sky.width, height = sky.height;
  const double x = (std::remainder(longitude, 2.0 * kPi) / (2.0 * kPi) + 0.5) * width - 0.5;
  const double y = std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi * height - 0.5;
  glm::dvec3 sum(0.0);
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const auto column =
          static_cast<std::size_t>(std::fmod(std::floor(x) + dx + 2.0 * width, width));
      const auto row = static_cast<std::size_t>(std::clamp(std::floor(y) + dy, 0.0, height - 1.0));
      sum += (1.0 - std::abs(x - std::floor(x) - dx)) * (1.0 - std::abs(y - std::floor(y) - dy)) *
             glm::dvec3(sky.texels[row * sky.width + column]);
    }
  }
  return double{sky.strength} * sum;
}

/// Irradiance of a plane that faces up: midpoint rule over the upper hemisphere.
glm::dvec3 irradiance_of(const scene::Environment& sky) {
  constexpr int kSteps = 1000;  // to the pole; four times as many around
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double polar = (i + 0.5) / kSteps * 0.5 * kPi;
    for (int j = 0; j < 4 * kSteps; ++j) {
      const double around = (j + 0.5) / (4 * kSteps) * 2.0 * kPi;
      const glm::dvec3 direction(std::sin(polar) * std::cos(around), std::cos(polar),
                                 std::sin(polar) * std::sin(around));
      sum += shown(sky, direction) * direction.y * std::sin(polar);
    }
  }
  return sum * (0.5 * kPi / kSteps) * (2.0 * kPi / (4 * kSteps));
}

const Texels kGradient = [](std::uint32_t column, std::uint32_t row) {
  return glm::dvec3(1.0 + row, 0.2 * column, 1.0 + (column + row) % 3);
};

class Environments : public RenderTest {
 protected:
  Environments() {
    view_.eye = {0.1, 0.3, -0.05};
    // Photons that miss the plate are many: it covers a third of the disc that they start on.
    view_.photons = 100000;
  }

  void expect(const scene::Environment& sky, glm::dvec3 irradiance, double slack) const {
    GltfWriter writer;
    writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(kAlbedo)));
    view_.add_camera(writer);
    scene::Scene scene = load(writer);
    scene.environment = sky;
    expect_irradiance(
        device(), scene, view_, kAlbedo, [&](glm::dvec2) { return irradiance; }, 1, slack);
  }

  PlateView view_;
};

// pi L. Texels are kept to 2^-17.
TEST_F(Environments, ConstantSkyLightsAPlateWithPiL) {
  const glm::dvec3 radiance(1.0, 2.0, 3.0);
  const auto sky = sky_of(8, 0.0, [&](auto, auto) { return 2.0 * radiance; });
  expect(sky, kPi * radiance, 1e-5);
}

// Midpoints err by less than 1e-5 where the map bends.
TEST_F(Environments, GradientLightsAPlateAsQuadratureSays) {
  const auto sky = sky_of(6, 40.0, kGradient);
  expect(sky, irradiance_of(sky), 1e-4);
}

// A sun of one texel, whose tent is 1.4 degrees wide, is as good as parallel light: the cosine
// varies by 1.2 % across it, in proportion to the distance from its middle, so that its mean is
// that of the middle to 1e-4.
TEST_F(Environments, SunOfOneTexelIsADirectionalLight) {
  constexpr std::uint32_t kHeight = 256;
  const std::uint32_t row = 60, column = 333;
  const auto sky = sky_of(kHeight, -20.0, [&](auto x, auto y) {
    return x == column && y == row ? glm::dvec3(9000.0, 7000.0, 5000.0) : glm::dvec3(0.0);
  });
  const double polar = (row + 0.5) * kPi / kHeight;
  const double solid_angle = std::pow(kPi / kHeight, 2.0) * std::sin(polar);
  expect(sky, 0.5 * glm::dvec3(9000.0, 7000.0, 5000.0) * solid_angle * std::cos(polar), 3e-4);
}

// Eye rays that miss, directly, by way of a mirror, and through a sheet and a solid of glass, see
// the sky: each pixel lies between the least and the most of what its parts see.
class SkyView : public RenderTest {
 protected:
  using Radiance = std::function<glm::dvec3(glm::dvec3 direction)>;

  void expect_view(const GltfWriter& writer, const scene::Environment& sky,
                   const Radiance& radiance) const {
    scene::Scene scene = load(writer);
    scene.environment = sky;
    const render::Settings settings = small_settings(scene, 24, 24, 1);
    const render::Picture picture = render_scene(device(), scene, settings, 1).picture;
    const scene::Camera& camera = settings.camera;
    const double half = std::tan(camera.yfov / 2.0);
    for (std::uint32_t y = 0; y < 24; ++y) {
      for (std::uint32_t x = 0; x < 24; ++x) {
        glm::dvec3 least(1e30), most(0.0);
        for (int part = 0; part < 25; ++part) {
          const double u = 2.0 * (x + (part % 5) / 4.0) / 24.0 - 1.0;
          const double v = 1.0 - 2.0 * (y + (part / 5) / 4.0) / 24.0;
          const glm::dvec3 sees =
              radiance(glm::normalize(camera.forward + half * (u * camera.right + v * camera.up)));
          least = glm::min(least, sees);
          most = glm::max(most, sees);
        }
        const glm::dvec3 slack = 0.1 * (most - least) + 1e-4 * most;
        for (int channel = 0; channel < 3; ++channel) {
          ASSERT_GE(pixel(picture, x, y)[channel], least[channel] - slack[channel])
              << x << ' ' << y;
          ASSERT_LE(pixel(picture, x, y)[channel], most[channel] + slack[channel]) << x << ' ' << y;
        }
      }
    }
  }

  const scene::Environment sky_ = sky_of(12, 70.0, kGradient);
};

TEST_F(SkyView, Directly) {
  GltfWriter writer;
  writer.mesh(plate(-5.0f, 0.1f), writer.material(lambert(kAlbedo)));
  writer.camera("out", {0.0, 0.0, 0.0}, {1.0, 0.6, -0.4}, 1.4, 1.0);
  expect_view(writer, sky_, [&](glm::dvec3 direction) { return shown(sky_, direction); });
}

TEST_F(SkyView, ByWayOfAMirror) {
  GltfWriter writer;
  writer.mesh(plate(-1.0f, 9.0f), writer.material(metal(glm::dvec3(1.0))));
  writer.camera("down", {0.0, 0.0, 0.0}, {0.3, -1.0, 0.5}, 0.9, 1.0, {1.0, 0.0, 0.0});
  expect_view(writer, sky_, [&](glm::dvec3 direction) {
    return shown(sky_, {direction.x, -direction.y, direction.z});
  });
}

TEST_F(SkyView, ThroughASheetOfGlass) {
  const Pane pane{.name = "thin", .ior = 1.5, .thin = true};
  GltfWriter writer;
  pane.add_to(writer, 9.0, 1.0);
  writer.camera("up", {0.0, 0.0, 0.0}, {0.2, 1.0, 0.1}, 0.9, 1.0, {1.0, 0.0, 0.0});
  expect_view(writer, sky_, [&](glm::dvec3 direction) {
    const Shares parts = shares(pane, direction.y);
    return parts.transmitted * shown(sky_, direction) +
           parts.reflected * shown(sky_, {direction.x, -direction.y, direction.z});
  });
}

// Lossless glass in a sky that is the same everywhere cannot be seen; nor can a white ball, whose
// photons come from there.
TEST_F(Environments, LosslessThingsAreInvisibleInAConstantSky) {
  const auto sky = sky_of(4, 0.0, [](auto, auto) { return glm::dvec3(2.0); });
  GltfWriter writer;
  writer.mesh(icosphere(3), writer.material(glass(1.5)), placed({-0.45, 0.0, 0.0}, 0.4));
  writer.mesh(icosphere(4), writer.material(lambert(glm::dvec3(1.0))),
              placed({0.45, 0.0, 0.0}, 0.4));
  writer.camera("front", {0.0, 0.0, 2.0}, {0.0, 0.0, 0.0}, 0.8, 1.0);
  scene::Scene scene = load(writer);
  scene.environment = sky;
  render::Settings settings = small_settings(scene, 32, 32, 100000);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.06;
  const auto blocks =
      replicate(device(), scene, settings, 3, 8,
                [](const render::Picture& picture) { return block_means(picture, 8); });
  // Facets within 0.4 % of the sphere, photons from below the horizon of the disc R^2 / 4 r^2; the
  // ball casts its light on the glass, which changes nothing. Silhouettes of the ball: discs there
  // reach over the edge of what the eye sees, but not of the ball.
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_TRUE(agrees(blocks[i], glm::dvec3(1.0), 6.0, 0.01)) << "block " << i;
}

}  // namespace
}  // namespace ppm::test
