// What textures and vertex colours do to a picture: each use multiplies its factor by its channel,
// lookups are where they belong, normal maps tilt surfaces, emissive textures light the scene.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/packing.hpp>

#include "plate.hpp"

namespace ppm::test {
namespace {

using scene::OptionalTextureUse;
using scene::Texture;
using scene::TextureUse;

Texture texture_of(std::uint32_t width, std::uint32_t height, std::vector<glm::u8vec4> rgba,
                   bool srgb = false) {
  Texture texture;
  texture.width = width;
  texture.height = height;
  texture.nearest = true;
  texture.srgb = srgb;
  texture.rgba8 = std::move(rgba);
  return texture;
}

/// Appends the texture and returns its use as it is.
TextureUse add_texture(scene::Scene& scene, Texture texture) {
  scene.textures.push_back(std::move(texture));
  TextureUse use;
  use.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
  return use;
}

/// The name of a row of a table, for a test.
template <typename Row>
std::string name_of(const ::testing::TestParamInfo<Row>& row) {
  std::string name = row.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

// ---- Lookups, which an unlit surface shows to the eye as they are

/// An unlit square [0, 1]^2 that fills the picture, v down.
scene::Scene unlit_square() {
  GltfWriter writer;
  nlohmann::json unlit = {{"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}},
                          {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1.0, 0.25, 1.0}}}}};
  writer.mesh(quad({0.0f, 1.0f, 0.0f}, {0.0f, -1.0f, 0.0f}, {1.0f, 0.0f, 0.0f}),
              writer.material(unlit));
  writer.camera("front", {0.5, 0.5, 10.0}, {0.5, 0.5, 0.0}, 2.0 * std::atan(0.05));
  writer.point_light({0.5, 0.5, 2.0}, glm::dvec3(1.0), 100.0);  // which must not matter
  scene::Scene scene = load(writer);
  // The mesh's u runs with its first edge, which is down here.
  for (scene::Triangle& triangle : scene.triangles) {
    for (scene::Corner& corner : triangle.corners) {
      corner.texcoord = glm::vec2(corner.texcoord.y, corner.texcoord.x);
    }
  }
  return scene;
}

class UnlitPictures : public RenderTest {
 protected:
  /// Pixels (x, y), of 8 x 8, are `expected(u, v)` at their centres within `tolerance`.
  void expect(const scene::Scene& scene, double tolerance,
              const std::function<glm::dvec3(double, double)>& expected) const {
    const auto picture = render_scene(device(), scene, small_settings(scene, 8, 8, 100), 1).picture;
    for (std::uint32_t y = 0; y < 8; ++y) {
      for (std::uint32_t x = 0; x < 8; ++x) {
        const glm::dvec3 error =
            glm::abs(pixel(picture, x, y) - expected((x + 0.5) / 8, (y + 0.5) / 8));
        EXPECT_LT(std::max({error.x, error.y, error.z}), tolerance) << x << ", " << y;
      }
    }
  }
};

const glm::dvec3 kUnlit(0.5, 1.0, 0.25);

// Two texels a side; each quarter of the picture shows one.
const std::vector<glm::u8vec4> kFour{
    {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 0, 255}};
glm::dvec3 four(double u, double v) {
  const auto wrapped = [](double x) { return x - std::floor(x) < 0.5 ? 0 : 1; };
  const glm::u8vec4 texel = kFour[static_cast<std::size_t>(wrapped(u) + 2 * wrapped(v))];
  return kUnlit * glm::dvec3(texel.x, texel.y, texel.z) / 255.0;
}

TEST_F(UnlitPictures, ShowTheirTextureUprightAndUnmirrored) {
  scene::Scene scene = unlit_square();
  scene.materials[0].base_color_texture = add_texture(scene, texture_of(2, 2, kFour));
  expect(scene, 1e-6, four);
}

TEST_F(UnlitPictures, DecodeColoursButNotData) {
  for (const bool srgb : {false, true}) {
    scene::Scene scene = unlit_square();
    scene.materials[0].base_color_texture =
        add_texture(scene, texture_of(1, 1, {{188, 188, 188, 255}}, srgb));
    const double code = 188.0 / 255.0;
    const double value = srgb ? std::pow((code + 0.055) / 1.055, 2.4) : code;
    expect(scene, 2e-6, [&](double, double) { return kUnlit * value; });
  }
}

// A quarter turn, half the size and a shift by an eighth, so that pixels' centres stay off the
// edges between texels; worked out by hand as in the loader's test.
TEST_F(UnlitPictures, FollowTransformsAndSecondCoordinates) {
  scene::Scene scene = unlit_square();
  TextureUse use = add_texture(scene, texture_of(2, 2, kFour));
  use.row_s = {0.0f, 0.5f, 0.125f};
  use.row_t = {-0.5f, 0.0f, 0.25f};
  scene.materials[0].base_color_texture = use;
  expect(scene, 1e-6, [](double u, double v) { return four(0.5 * v + 0.125, -0.5 * u + 0.25); });

  // The same again by the second set alone.
  for (const scene::Triangle& triangle : scene.triangles) {
    scene::TriangleDetail detail;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3 uv1(triangle.corners[i].texcoord, 1.0f);
      detail[i].texcoord1 = {glm::dot(use.row_s, uv1), glm::dot(use.row_t, uv1)};
    }
    scene.details.push_back(detail);
  }
  TextureUse second;
  second.texture = use.texture;
  second.texcoord_set = 1;
  scene.materials[0].base_color_texture = second;
  expect(scene, 1e-6, [](double u, double v) { return four(0.5 * v + 0.125, -0.5 * u + 0.25); });
}

// Colours linear in the place are the place; a pixel is an eighth wide.
TEST_F(UnlitPictures, ShowVertexColours) {
  scene::Scene scene = unlit_square();
  for (scene::Triangle& triangle : scene.triangles) {
    for (scene::Corner& corner : triangle.corners) {
      corner.color = {corner.texcoord.x, corner.texcoord.y, 1.0f, 1.0f};
    }
  }
  expect(scene, 1.0 / 16.0 + 1e-4,
         [](double u, double v) { return kUnlit * glm::dvec3(u, v, 1.0); });
}

// ---- Every use

struct Use {
  const char* name;
  OptionalTextureUse scene::Material::*slot;
  glm::u8vec4 own;                               // a texel of its own channels
  std::function<void(scene::Material&)> vanish;  // what a texel of 0 in them does
};

std::vector<Use> uses() {
  using M = scene::Material;
  return {
      {"base colour",
       &M::base_color_texture,
       {255, 255, 255, 0},
       [](M& m) { m.base_color = glm::vec3(0.0f); }},
      {"roughness",
       &M::metallic_roughness_texture,
       {0, 255, 0, 0},
       [](M& m) { m.roughness = 0.0f; }},
      {"metallic", &M::metallic_roughness_texture, {0, 0, 255, 0}, [](M& m) { m.metallic = 0.0f; }},
      {"emissive",
       &M::emissive_texture,
       {255, 255, 255, 0},
       [](M& m) { m.emission = glm::vec3(0.0f); }},
      {"transmission",
       &M::transmission_texture,
       {255, 0, 0, 0},
       [](M& m) { m.transmission = 0.0f; }},
      {"specular", &M::specular_texture, {0, 0, 0, 255}, [](M& m) { m.specular = 0.0f; }},
      {"specular colour",
       &M::specular_color_texture,
       {255, 255, 255, 0},
       [](M& m) { m.specular_color = glm::vec3(0.0f); }},
  };
}

// A plate on which every factor counts, and a lamp. The lamp sits beside the eye, so that its
// highlight does not.
scene::Scene plate_of_everything() {
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(glm::dvec3(0.5))));
  writer.point_light({0.1, 0.5, 0.2}, glm::dvec3(1.0), 3.0);
  PlateView view;
  view.eye = {0.0, 0.5, 0.0};
  view.add_camera(writer);
  scene::Scene scene = load(writer);
  scene::Material& material = scene.materials[0];
  material.base_color = {0.8f, 0.6f, 0.4f};
  material.metallic = 0.3f;
  material.roughness = 0.5f;
  material.specular = 0.7f;
  material.specular_color = {0.5f, 0.9f, 1.3f};
  material.transmission = 0.4f;
  material.emission = {0.2f, 0.1f, 0.05f};
  // So that all scenes run the same kernels.
  material.base_color_texture = add_texture(scene, texture_of(1, 1, {{255, 255, 255, 255}}));
  return scene;
}

class TextureUses : public RenderTest, public ::testing::WithParamInterface<Use> {};

TEST_P(TextureUses, MultiplyTheirFactorByTheirChannel) {
  const Use& use = GetParam();
  const auto picture_of = [&](const scene::Scene& scene) {
    return render_scene(device(), scene, small_settings(scene, 12, 12, 3000), 2).picture;
  };
  const bool has_partner = use.slot == &scene::Material::metallic_roughness_texture;
  const scene::Scene plain = plate_of_everything();
  scene::Scene with_all = plain, with_none = plain, without = plain;
  // All of its own channel and nothing of others; the other way round; and no texture. Those that
  // share a texture leave each other alone.
  const glm::u8vec4 partner = has_partner ? glm::u8vec4(0, 255, 255, 0) - use.own : glm::u8vec4(0);
  with_all.materials[0].*use.slot = add_texture(with_all, texture_of(1, 1, {use.own + partner}));
  with_none.materials[0].*use.slot =
      add_texture(with_none, texture_of(1, 1, {glm::u8vec4(255) - use.own}));
  use.vanish(without.materials[0]);
  const render::Picture full = picture_of(plain), none = picture_of(without);
  const auto expect_equal = [](const render::Picture& a, const render::Picture& b) {
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
      ASSERT_NEAR(a.rgb[i], b.rgb[i], 1e-5f * std::abs(b.rgb[i])) << i;
    }
  };
  expect_equal(picture_of(with_all), full);
  expect_equal(picture_of(with_none), none);
  EXPECT_NE(full.rgb, none.rgb) << "this scene does not tell";
}

INSTANTIATE_TEST_SUITE_P(All, TextureUses, ::testing::ValuesIn(uses()), name_of<Use>);

// ---- Normal maps

struct Tilt {
  const char* name;
  glm::vec2 map;  // x and y of the map's normal, before its scale
  float scale;
  glm::vec4 tangent;
  glm::dvec3 normal;  // what is shaded with, worked out by hand
  bool from_behind;
};

class NormalMaps : public RenderTest, public ::testing::WithParamInterface<Tilt> {};

// A sun over a Lambertian plate: albedo / pi times its irradiance across the beam times the cosine
// with the shading normal, which a map of one texel tilts.
TEST_P(NormalMaps, AreTheSurfacesTheyStandFor) {
  const Tilt& tilt = GetParam();
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));
  PlateView view;
  view.eye = {0.0, 0.5, 0.0};
  view.pixels = 8;
  view.seeds = 4;
  view.photons = 30000;
  const glm::dvec3 albedo(0.8, 0.5, 0.3);
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.6f, !tilt.from_behind), writer.material(lambert(albedo)));
  writer.directional_light(sun, glm::dvec3(1.0), 2.0);
  view.add_camera(writer);
  scene::Scene scene = load(writer);
  const auto code = [](float x) { return glm::packHalf1x16(0.5f * x + 0.5f); };
  Texture map;
  map.width = map.height = 1;
  const float z = std::sqrt(1.0f - glm::dot(tilt.map, tilt.map));
  map.halves.emplace_back(code(tilt.map.x), code(tilt.map.y), code(z), code(1.0f));
  scene.materials[0].normal_texture = add_texture(scene, map);
  scene.materials[0].normal_scale = tilt.scale;
  scene::TriangleDetail detail;
  for (scene::CornerDetail& corner : detail) corner.tangent = tilt.tangent;
  scene.details.assign(scene.triangles.size(), detail);
  const double cosine = glm::dot(glm::normalize(tilt.normal), -sun);
  // Half floats of the map err by 2^-11 of it, which the slope of the cosine makes 1e-3.
  expect_irradiance(
      device(), scene, view, albedo, [&](glm::dvec2) { return glm::dvec3(2.0 * cosine); }, 1, 1e-3);
}

const double kZ = std::sqrt(1.0 - 0.16 - 0.04);  // of the map (0.4, 0.2)
INSTANTIATE_TEST_SUITE_P(
    All, NormalMaps,
    ::testing::Values(
        Tilt{"flat", {0.0f, 0.0f}, 1.0f, {1, 0, 0, 1}, {0, 1, 0}, false},
        // The bitangent is cross(normal, tangent) = cross(y, x) = -z.
        Tilt{"tilted", {0.4f, 0.2f}, 1.0f, {1, 0, 0, 1}, {0.4, kZ, -0.2}, false},
        Tilt{"mirrored", {0.4f, 0.2f}, 1.0f, {1, 0, 0, -1}, {0.4, kZ, 0.2}, false},
        Tilt{"along_z", {0.4f, 0.2f}, 1.0f, {0, 0, 1, 1}, {0.2, kZ, 0.4}, false},
        Tilt{"scaled", {0.4f, 0.2f}, 0.5f, {1, 0, 0, 1}, {0.2, kZ, -0.1}, false},
        // The front's normal is -y: bitangent cross(-y, x) = z; then all is turned round.
        Tilt{"behind", {0.4f, 0.2f}, 1.0f, {1, 0, 0, 1}, {-0.4, kZ, -0.2}, true},
        // A tangent that is not square to the normal is laid into the surface.
        Tilt{"askew", {0.4f, 0.2f}, 1.0f, {0.8f, 0.6f, 0, 1}, {0.4, kZ, -0.2}, false}),
    name_of<Tilt>);

// ---- Emissive textures

// A ceiling lamp whose texture has four texels, one of them dark, over a Lambertian plate:
// irradiance by quadrature, and what the eye sees of the lamp.
TEST_F(UnlitPictures, EmissiveTexturesLightTheScene) {
  PlateView view;
  view.eye = {0.0, 0.35, 0.0};
  const glm::dvec3 albedo(0.8, 0.5, 0.3), radiance(4.0, 3.0, 2.0);
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.6f), writer.material(lambert(albedo)));
  const Mesh lamp = quad({-0.4f, 0.5f, -0.4f}, {0.8f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.8f});
  writer.mesh(lamp, writer.material(emitter(radiance)));
  view.add_camera(writer);
  scene::Scene scene = load(writer);
  const std::vector<glm::u8vec4> texels{
      {255, 255, 255, 255}, {0, 0, 0, 255}, {51, 102, 255, 255}, {0, 255, 0, 255}};
  scene.materials[1].emissive_texture = add_texture(scene, texture_of(2, 2, texels));
  const auto seen = [&](double u, double v) {
    const glm::u8vec4 texel = texels[(u < 0.5 ? 0u : 1u) + (v < 0.5 ? 0u : 2u)];
    return radiance * glm::dvec3(texel.x, texel.y, texel.z) / 255.0;
  };
  // Midpoints a twentieth of the lamp apart, half a unit away: 2e-3 at most by the rule's error.
  const auto irradiance = [&](glm::dvec2 p) {
    constexpr int kSteps = 40;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const double u = (i % kSteps + 0.5) / kSteps, v = (i / kSteps + 0.5) / kSteps;
      const glm::dvec3 to_light(0.8 * u - 0.4 - p.x, 0.5, 0.8 * v - 0.4 - p.y);
      const double d2 = glm::dot(to_light, to_light);
      sum += seen(u, v) * (0.25 / (d2 * d2) * 0.64 / (kSteps * kSteps));
    }
    return sum;
  };
  expect_irradiance(device(), scene, view, albedo, irradiance, 1, 2e-3);

  // Half covered, by chance or by half of the texels' alpha, it gives half of the light.
  scene::Scene veiled = scene;
  veiled.materials[1].alpha_mode = scene::AlphaMode::blend;
  veiled.materials[1].alpha = 0.5f;
  view.seeds = 4;
  expect_irradiance(
      device(), veiled, view, albedo, [&](glm::dvec2 p) { return 0.5 * irradiance(p); }, 1, 2e-3);
}

}  // namespace
}  // namespace ppm::test
