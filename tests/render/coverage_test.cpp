// Coverage: surfaces of alphaMode MASK and BLEND let through what they do not cover, for eye rays
// and for photons alike.
#include <cmath>
#include <functional>

#include "plate.hpp"

namespace ppm::test {
namespace {

/// A black material that stores no hit points.
nlohmann::json veil(const char* mode, double alpha) {
  nlohmann::json material = lambert(glm::dvec3(0.0));
  material["alphaMode"] = mode;
  material["pbrMetallicRoughness"]["baseColorFactor"] = {0.0, 0.0, 0.0, alpha};
  return material;
}

class Coverage : public RenderTest {};

// A luminous panel seen through N veils: each lets 1 - a of the eye rays pass. The samples of a
// pixel are strata for one veil, so that its mean errs by less than one sample a pixel.
TEST_F(Coverage, EyeRaysPassVeilsInProportion) {
  for (const int veils : {1, 2, 5}) {
    GltfWriter writer;
    writer.mesh(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), writer.material(emitter({1.0, 2.0, 4.0})));
    const std::size_t material = writer.material(veil("BLEND", 0.3));
    for (int i = 0; i < veils; ++i) {
      // The last two coincide, one seen from behind.
      const float z = 0.1f * static_cast<float>(std::min(i + 1, veils - 1) + 1);
      Mesh mesh = quad({-1, -1, z}, {2, 0, 0}, {0, 2, 0});
      writer.mesh(i + 1 == veils ? inside_out(mesh) : mesh, material);
    }
    writer.camera("front", {0, 0, 3}, {0, 0, 0}, 0.4);
    const scene::Scene scene = load(writer);
    render::Settings settings = small_settings(scene, 24, 24, 100);
    settings.samples_per_pixel = 8;
    const auto picture = render_scene(device(), scene, settings, 1).picture;
    const double expected = std::pow(0.7, veils);
    // As if the 4608 samples were independent; strata do better.
    const double sigma = std::sqrt(expected * (1.0 - expected) / 4608.0);
    const glm::dvec3 mean = window_mean(picture, whole(settings));
    EXPECT_NEAR(mean.x, expected, (veils == 1 ? 1.0 : 5.0) * sigma) << veils;
    EXPECT_NEAR(mean.z, 4.0 * mean.x, 1e-5) << veils;
    if (veils > 1) continue;
    double most = 0.0, least = 1.0;
    for (std::uint32_t i = 0; i < 24 * 24; ++i) {
      if (i % 24 == i / 24 || i % 24 + i / 24 == 23) continue;  // both triangles share a pixel
      most = std::max(most, pixel(picture, i % 24, i / 24).x);
      least = std::min(least, pixel(picture, i % 24, i / 24).x);
    }
    EXPECT_LE(most, 6.0 / 8.0 + 1e-6);  // 0.7 * 8 = 5.6 samples: 5 or 6
    EXPECT_GE(least, 5.0 / 8.0 - 1e-6);
  }
}

// The plate under a lamp behind N veils has (1 - a)^N of the irradiance.
TEST_F(Coverage, PhotonsPassVeilsInProportion) {
  const glm::dvec3 position(-0.1, 0.9, 0.2), albedo(0.8, 0.5, 0.3);
  for (const int veils : {1, 3}) {
    PlateView view;
    view.eye = {0.1, 0.3, -0.05};
    view.seeds = 6;
    GltfWriter writer;
    writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(albedo)));
    const std::size_t material = writer.material(veil("BLEND", 0.4));
    for (int i = 0; i < veils; ++i) {
      writer.mesh(plate(0.5f + 0.1f * static_cast<float>(i / 2), 2.0f, i % 2 == 0), material);
    }
    writer.point_light(position, glm::dvec3(1.0), 3.0);
    view.add_camera(writer);
    expect_irradiance(
        device(), load(writer), view, albedo,
        [&](glm::dvec2 p) {
          const glm::dvec3 to_light = position - glm::dvec3(p.x, 0.0, p.y);
          const double d2 = glm::dot(to_light, to_light);
          return glm::dvec3(std::pow(0.6, veils) * 3.0 * to_light.y / (d2 * std::sqrt(d2)));
        },
        1, 0.0);
  }
}

// A plate that covers half of its area scatters half of the light, not a quarter.
TEST_F(Coverage, IsLitAsIfItWereWhole) {
  const glm::dvec3 position(-0.1, 0.9, 0.2), albedo(0.8, 0.5, 0.3);
  PlateView view;
  view.eye = {0.1, 0.3, -0.05};
  view.seeds = 6;
  view.samples_per_pixel = 2;  // one stops
  GltfWriter writer;
  nlohmann::json material = lambert(albedo);
  material["alphaMode"] = "BLEND";
  material["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.5;
  writer.mesh(plate(0.0f, 0.8f), writer.material(material));
  writer.point_light(position, glm::dvec3(1.0), 3.0);
  view.add_camera(writer);
  expect_irradiance(
      device(), load(writer), view, 0.5 * albedo,
      [&](glm::dvec2 p) {
        const glm::dvec3 to_light = position - glm::dvec3(p.x, 0.0, p.y);
        const double d2 = glm::dot(to_light, to_light);
        return glm::dvec3(3.0 * to_light.y / (d2 * std::sqrt(d2)));
      },
      1, 0.0);
}

struct Masked {
  scene::AlphaMode mode;
  float factor, cutoff, vertex;
  std::array<double, 4> covered;  // of texels with alpha 0, 100, 200, 255
};

// Four texels of different alpha before a luminous panel: each quarter of the picture shows how
// much of it is covered.
TEST_F(Coverage, IsFactorTimesTextureTimesVertexAlpha) {
  using enum scene::AlphaMode;
  const std::array cases{Masked{mask, 1.0f, 0.5f, 1.0f, {0, 0, 1, 1}},
                         Masked{mask, 0.5f, 0.45f, 1.0f, {0, 0, 0, 1}},
                         Masked{mask, 1.0f, 0.3f, 0.5f, {0, 0, 1, 1}},
                         Masked{mask, 1.0f, 0.0f, 1.0f, {1, 1, 1, 1}},
                         Masked{blend, 1.0f, 0.5f, 1.0f, {0, 100 / 255.0, 200 / 255.0, 1}},
                         Masked{blend, 0.5f, 0.5f, 0.8f, {0, 40 / 255.0, 80 / 255.0, 0.4}},
                         Masked{opaque, 0.5f, 0.5f, 0.5f, {1, 1, 1, 1}}};
  for (const Masked& masked : cases) {
    GltfWriter writer;
    writer.mesh(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), writer.material(emitter({1.0, 1.0, 1.0})));
    writer.mesh(quad({-0.5f, 0.5f, 0.01f}, {1, 0, 0}, {0, -1, 0}),
                writer.material(lambert(glm::dvec3(0.0))));
    writer.camera("front", {0, 0, 10.01}, {0, 0, 0}, 2.0 * std::atan(0.05));
    scene::Scene scene = load(writer);
    scene::Texture texture;
    texture.width = texture.height = 2;
    texture.nearest = texture.srgb = true;
    texture.rgba8 = {{9, 9, 9, 0}, {9, 9, 9, 100}, {9, 9, 9, 200}, {9, 9, 9, 255}};
    scene.textures.push_back(texture);
    scene::Material& material = scene.materials[1];
    material.base_color_texture.emplace();
    material.alpha_mode = masked.mode;
    material.alpha = masked.factor;
    material.alpha_cutoff = masked.cutoff;
    for (scene::Triangle& triangle : scene.triangles) {
      if (triangle.material != 1) continue;
      for (scene::Corner& corner : triangle.corners) corner.color.w = masked.vertex;
    }
    render::Settings settings = small_settings(scene, 32, 32, 100);
    settings.samples_per_pixel = 4;
    const auto means = block_means(render_scene(device(), scene, settings, 1).picture, 16);
    for (std::size_t i = 0; i < 4; ++i) {
      const double open = 1.0 - masked.covered[i];
      // 1024 samples, as if they were independent; vertex alpha has 16 bits.
      const double sigma = std::sqrt(open * (1.0 - open) / 1024.0);
      EXPECT_NEAR(means[i].x, open, 5.0 * sigma + 1e-4)
          << "texel " << i << ", mode " << static_cast<int>(masked.mode) << ", factor "
          << masked.factor;
    }
  }
}

}  // namespace
}  // namespace ppm::test
