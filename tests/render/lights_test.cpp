// Every kind of light over a Lambertian plate: radiance is albedo / pi times the irradiance that
// photometry gives in closed form or by quadrature, in double precision.
#include <algorithm>
#include <cmath>

#include "plate.hpp"

namespace ppm::test {
namespace {

const glm::dvec3 kAlbedo(0.8, 0.5, 0.3);
const glm::dvec3 kUp(0.0, 1.0, 0.0);

class Lights : public RenderTest {
 protected:
  Lights() { view_.eye = {0.1, 0.3, -0.05}; }

  /// A plate under the camera; the lights are the test's.
  GltfWriter lit_plate() const {
    GltfWriter writer;
    writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(kAlbedo)));
    view_.add_camera(writer);
    return writer;
  }

  void expect(const GltfWriter& writer, const Irradiance& irradiance, double slack = 0.0) const {
    expect_irradiance(device(), writer, view_, kAlbedo, irradiance, 1, slack);
  }

  PlateView view_;
};

glm::dvec3 on_plate(glm::dvec2 p) {
  return {p.x, 0.0, p.y};
}

// I cos / d^2.
glm::dvec3 from_point(glm::dvec3 light, glm::dvec3 intensity, glm::dvec2 p) {
  const glm::dvec3 to_light = light - on_plate(p);
  const double d2 = glm::dot(to_light, to_light);
  return intensity * (to_light.y / (d2 * std::sqrt(d2)));
}

// The falloff that KHR_lights_punctual recommends, by its own text.
double spot_attenuation(double cosine, double inner, double outer) {
  const double scale = 1.0 / std::max(0.001, std::cos(inner) - std::cos(outer));
  const double offset = -std::cos(outer) * scale;
  const double attenuation = std::clamp(cosine * scale + offset, 0.0, 1.0);
  return attenuation * attenuation;
}

struct Rectangle {
  glm::dvec3 corner, edge_u, edge_v;
};

// Irradiance of a rectangle of constant radiance: midpoint rule over L cos cos' / d^2 dA. Steps of
// 1/80 at distances above 0.45 leave an error of some 1e-4.
glm::dvec3 from_rectangle(const Rectangle& light, glm::dvec3 radiance, glm::dvec2 p) {
  constexpr int kSteps = 40;
  const glm::dvec3 area = glm::cross(light.edge_u, light.edge_v);
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const glm::dvec3 from =
          light.corner + light.edge_u * ((i + 0.5) / kSteps) + light.edge_v * ((j + 0.5) / kSteps);
      const glm::dvec3 to_light = from - on_plate(p);
      const double d2 = glm::dot(to_light, to_light);
      const double at_light = -glm::dot(area, to_light);
      sum += std::max(at_light, 0.0) * std::max(to_light.y, 0.0) / (d2 * d2);
    }
  }
  return radiance * (sum / (kSteps * kSteps));
}

Mesh mesh_of(const Rectangle& rectangle) {
  return quad(rectangle.corner, rectangle.edge_u, rectangle.edge_v);
}

// Front down and towards +z; nothing of it lies below the plate's horizon or near the camera.
const Rectangle kTilted{{-0.35, 0.6, -0.15}, {0.5, 0.0, 0.0}, {0.0, 0.15, 0.26}};
// The same with its front up.
const Rectangle kTurned{{-0.35, 0.6, -0.15}, {0.0, 0.15, 0.26}, {0.5, 0.0, 0.0}};

TEST_F(Lights, Point) {
  const glm::dvec3 position(-0.1, 0.5, 0.2), color(1.0, 0.6, 0.3);
  GltfWriter writer = lit_plate();
  writer.point_light(position, color, 3.0);
  expect(writer, [&](glm::dvec2 p) { return from_point(position, 3.0 * color, p); });
}

// Dark from the range on, which one corner of the plate lies beyond.
TEST_F(Lights, PointOfLimitedRange) {
  const glm::dvec3 position(-0.1, 0.4, 0.2), color(1.0, 0.6, 0.3);
  const double range = 0.7;
  GltfWriter writer = lit_plate();
  writer.point_light(position, color, 3.0);
  writer.document()["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = range;
  expect(writer, [&](glm::dvec2 p) {
    const double ratio = glm::length(position - on_plate(p)) / range;
    return std::clamp(1.0 - std::pow(ratio, 4.0), 0.0, 1.0) * from_point(position, 3.0 * color, p);
  });
}

struct Cone {
  double inner, outer;
};
class Spots : public Lights, public ::testing::WithParamInterface<Cone> {};

TEST_P(Spots, FallOffBetweenTheirCones) {
  const auto [inner, outer] = GetParam();
  const glm::dvec3 position(0.05, 0.6, 0.0), color(0.4, 1.0, 0.7);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.15, -1.0, 0.1));
  GltfWriter writer = lit_plate();
  writer.spot_light(position, axis, color, 2.0, inner, outer);
  expect(writer, [&](glm::dvec2 p) {
    const double cosine = glm::dot(glm::normalize(on_plate(p) - position), axis);
    return spot_attenuation(cosine, inner, outer) * from_point(position, 2.0 * color, p);
  });
}

// A wide ramp, one from the axis on, an edge so sharp that the formula's smallest ramp of 0.001 in
// the cosine counts, and half the sphere.
INSTANTIATE_TEST_SUITE_P(Cones, Spots,
                         ::testing::Values(Cone{0.3, 0.6}, Cone{0.0, 0.5}, Cone{0.4, 0.4005},
                                           Cone{0.2, 1.5707}));

TEST_F(Lights, SpotIsDarkOutsideItsCone) {
  const glm::dvec3 position(0.1, 0.6, -0.05);
  const double outer = 0.4;
  GltfWriter writer = lit_plate();
  writer.spot_light(position, -kUp, glm::dvec3(1.0), 2.0, 0.2, outer);
  const scene::Scene scene = load(writer);
  const render::Settings settings = view_.settings(scene, 1);
  const auto picture = render_scene(device(), scene, settings, 1).picture;
  // No point of the pixel, nor of a disc around it, reaches into the lit circle.
  const double diagonal = std::sqrt(2.0) * view_.half / view_.pixels;
  const double dark = position.y * std::tan(outer) + view_.radius + diagonal;
  unsigned pixels = 0;
  for (std::uint32_t y = 0; y < view_.pixels; ++y) {
    for (std::uint32_t x = 0; x < view_.pixels; ++x) {
      const glm::dvec2 p = view_.point(x + 0.5, y + 0.5);
      if (glm::distance(p, glm::dvec2(position.x, position.z)) <= dark) continue;
      EXPECT_EQ(pixel(picture, x, y), glm::dvec3(0.0)) << x << ' ' << y;
      ++pixels;
    }
  }
  EXPECT_GT(pixels, 100u);
  EXPECT_GT(window_mean(picture, {10, 10, 14, 14}).x, 0.0);
}

TEST_F(Lights, Directional) {
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, -1.0, 0.2)), color(0.9, 0.8, 1.0);
  GltfWriter writer = lit_plate();
  writer.directional_light(direction, color, 4.0);
  expect(writer, [&](glm::dvec2) { return 4.0 * color * -direction.y; });
}

// Uniform radiance L from a ball of radius a whose centre is d away: E = pi L (a/d)^2 cos. The
// tessellated ball lies within the true one and contains a smaller one: triangles with edges up to
// 0.078 a (20 * 4^4 of them) stay within (0.078^2 / 3) / 2 = 0.1 % of its surface, E within 0.2 %.
TEST_F(Lights, Sphere) {
  const glm::dvec3 centre(0.2, 0.65, -0.1), radiance(6.0, 5.0, 4.0);
  const double radius = 0.15;
  GltfWriter writer = lit_plate();
  writer.mesh(icosphere(4), writer.material(emitter(radiance)), placed(centre, radius));
  expect(
      writer,
      [&](glm::dvec2 p) {
        return from_point(centre, std::numbers::pi * radius * radius * radiance, p);
      },
      0.002);
}

TEST_F(Lights, Rectangle) {
  const glm::dvec3 radiance(2.0, 3.0, 5.0);
  GltfWriter writer = lit_plate();
  writer.mesh(mesh_of(kTilted), writer.material(emitter(radiance)));
  expect(writer, [&](glm::dvec2 p) { return from_rectangle(kTilted, radiance, p); });
}

TEST_F(Lights, RectangleThatEmitsFromBothSides) {
  const glm::dvec3 radiance(2.0, 3.0, 5.0);
  GltfWriter writer = lit_plate();
  auto material = emitter(radiance);
  material["doubleSided"] = true;
  writer.mesh(mesh_of(kTurned), writer.material(material));
  expect(writer, [&](glm::dvec2 p) { return from_rectangle(kTilted, radiance, p); });
}

TEST_F(Lights, RectangleIsDarkBehind) {
  GltfWriter writer = lit_plate();
  writer.mesh(mesh_of(kTurned), writer.material(emitter(glm::dvec3(2.0))));
  const scene::Scene scene = load(writer);
  const auto rendering = render_scene(device(), scene, view_.settings(scene, 0), 1);
  EXPECT_EQ(window_mean(rendering.picture, {0, 0, view_.pixels, view_.pixels}), glm::dvec3(0.0));
}

// A dim red lamp close to the plate beside a green one of 300 times its power: 1.3 % of the photons
// start at the dim one and both must come out right.
TEST_F(Lights, TwoOfVeryDifferentPower) {
  const glm::dvec3 dim(0.3, 0.25, -0.1), bright(-0.2, 0.6, 0.1);
  GltfWriter writer = lit_plate();
  writer.point_light(dim, {1.0, 0.0, 0.0}, 0.01);
  writer.point_light(bright, {0.0, 1.0, 0.0}, 3.0);
  expect(writer, [&](glm::dvec2 p) {
    return from_point(dim, {0.01, 0.0, 0.0}, p) + from_point(bright, {0.0, 3.0, 0.0}, p);
  });
}

// Seen directly, an emitter shows its radiance without noise: from its front, from behind only if
// it emits from both sides. Whatever depth is allowed.
TEST_F(Lights, EmittersSeenDirectly) {
  const glm::dvec3 radiance(0.25, 2.0, 3.0);
  for (const bool two_sided : {false, true}) {
    for (const bool from_front : {true, false}) {
      GltfWriter writer;
      auto material = emitter(radiance);
      material["doubleSided"] = two_sided;
      writer.mesh(plate(0.0f, 0.8f, from_front), writer.material(material));
      view_.add_camera(writer);
      const scene::Scene scene = load(writer);
      const glm::dvec3 expected = from_front || two_sided ? radiance : glm::dvec3(0.0);
      for (const std::uint32_t max_depth : {1u, 0u}) {
        const auto picture =
            render_scene(device(), scene, view_.settings(scene, max_depth), 1).picture;
        for (const glm::dvec3& mean : block_means(picture, 1))
          for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(mean[channel], expected[channel], 1e-6 * radiance[channel]);
      }
    }
  }
}

}  // namespace
}  // namespace ppm::test
