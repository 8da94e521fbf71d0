#include "room.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

namespace ppm::support {
namespace {

constexpr glm::vec3 kRoom{0.9f, 0.7f, 0.98f};  // half its edges

struct Surface {
  glm::vec3 position, normal;
};

// Adds geometry and materials to a scene.
class Modeller {
 public:
  explicit Modeller(scene::Scene& scene) : scene_(scene) {}

  std::uint32_t material(const scene::Material& material) {
    scene_.materials.push_back(material);
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }
  std::uint32_t diffuse(const char* name, glm::vec3 color) {
    scene::Material result;
    result.name = name;
    result.base_color = color;
    result.metallic = 0.0f;
    result.specular = 0.0f;
    return material(result);
  }

  // A sheet over [0,1]^2, counter-clockwise from its normal's side; triangles without area are left
  // out.
  void sheet(std::uint32_t columns, std::uint32_t rows, std::uint32_t material,
             const std::function<Surface(double u, double v)>& surface) {
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
      return surface(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
    };
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        const Surface a = at(column, row), b = at(column + 1, row);
        const Surface c = at(column + 1, row + 1), d = at(column, row + 1);
        triangle(a, b, c, material);
        triangle(a, c, d, material);
      }
    }
  }

  // A parallelogram; its normal is cross(right, up).
  void panel(glm::vec3 corner, glm::vec3 right, glm::vec3 up, std::uint32_t cuts,
             std::uint32_t material) {
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    sheet(cuts, cuts, material, [=](double u, double v) {
      return Surface{corner + static_cast<float>(u) * right + static_cast<float>(v) * up, normal};
    });
  }

  // A box seen from outside (`side` 1) or from within (-1), turned by `angle` about its vertical
  // axis.
  void box(glm::vec3 centre, glm::vec3 half, float angle, float side, std::uint32_t cuts,
           const std::array<std::uint32_t, 6>& materials) {
    const glm::vec3 x{std::cos(angle), 0.0f, -std::sin(angle)}, y{0.0f, 1.0f, 0.0f};
    const std::array<glm::vec3, 3> axes = {half.x * x, half.y * y, half.z * glm::cross(x, y)};
    for (std::size_t face = 0; face < 6; ++face) {
      const float sign = face % 2 == 0 ? -1.0f : 1.0f;
      const glm::vec3 out = sign * axes[face / 2];
      const glm::vec3 right = axes[(face / 2 + 1) % 3], up = side * sign * axes[(face / 2 + 2) % 3];
      panel(centre + out - right - up, 2.0f * right, 2.0f * up, cuts, materials[face]);
    }
  }

  void ball(glm::vec3 centre, double radius, std::uint32_t rows, std::uint32_t material) {
    sheet(2 * rows, rows, material, [=](double u, double v) {
      const double azimuth = 2.0 * std::numbers::pi * (u < 1.0 ? u : 0.0),
                   height = std::numbers::pi * v;
      const double ring = v > 0.0 && v < 1.0 ? std::sin(height) : 0.0;
      const glm::dvec3 normal(ring * std::sin(azimuth), -std::cos(height),
                              ring * std::cos(azimuth));
      return Surface{glm::vec3(glm::dvec3(centre) + radius * normal), glm::vec3(normal)};
    });
  }

  void ring(glm::vec3 centre, double radius, double thickness, std::uint32_t columns,
            std::uint32_t rows, std::uint32_t material) {
    sheet(columns, rows, material, [=](double u, double v) {
      const double around = 2.0 * std::numbers::pi * (u < 1.0 ? u : 0.0);
      const double across = 2.0 * std::numbers::pi * (v < 1.0 ? v : 0.0);
      const glm::dvec3 out(std::sin(around), 0.0, std::cos(around));
      const glm::dvec3 normal = std::cos(across) * out + glm::dvec3(0.0, std::sin(across), 0.0);
      return Surface{glm::vec3(glm::dvec3(centre) + radius * out + thickness * normal),
                     glm::vec3(normal)};
    });
  }

 private:
  void triangle(const Surface& a, const Surface& b, const Surface& c, std::uint32_t material) {
    if (a.position == b.position || b.position == c.position || c.position == a.position) return;
    scene::Triangle result;
    result.material = material;
    const std::array<const Surface*, 3> corners = {&a, &b, &c};
    for (std::size_t i = 0; i < 3; ++i) {
      result.corners[i].position = corners[i]->position;
      result.corners[i].normal = corners[i]->normal;
    }
    scene_.triangles.push_back(result);
  }

  scene::Scene& scene_;
};

void find_bounds(scene::Scene& scene) {
  scene.bounds_min = glm::vec3(1.0f);
  scene.bounds_max = glm::vec3(-1.0f);
  for (const scene::Triangle& triangle : scene.triangles) {
    for (const scene::Corner& corner : triangle.corners) {
      scene.bounds_min = glm::min(scene.bounds_min, corner.position);
      scene.bounds_max = glm::max(scene.bounds_max, corner.position);
    }
  }
}

scene::Camera camera_in_room() {
  scene::Camera camera;
  camera.name = "door";
  camera.position = {0.0, 0.1, 0.94};
  camera.forward = glm::normalize(glm::dvec3(0.0, -0.22, -1.0));
  camera.right = {1.0, 0.0, 0.0};
  camera.up = glm::cross(camera.right, camera.forward);
  camera.yfov = 1.0;
  return camera;
}

void add_balls(Modeller& modeller, std::uint32_t rows) {
  scene::Material glass;
  glass.name = "glass";
  glass.metallic = 0.0f;
  glass.roughness = 0.0f;
  glass.transmission = 1.0f;
  glass.solid = true;
  modeller.ball({0.36f, -0.44f, 0.1f}, 0.25, rows, modeller.material(glass));
  scene::Material mirror;
  mirror.name = "mirror";
  mirror.base_color = glm::vec3(0.95f);
  mirror.roughness = 0.0f;
  modeller.ball({-0.38f, -0.38f, -0.3f}, 0.31, rows, modeller.material(mirror));
}

void add_heap(Modeller& modeller, std::uint32_t cuts) {
  const std::uint32_t wood = modeller.diffuse("wood", {0.55f, 0.4f, 0.25f});
  std::array<std::uint32_t, 6> materials;
  materials.fill(wood);
  std::mt19937 random(1);
  const auto uniform = [&random](float lower, float upper) {
    return lower + (upper - lower) * static_cast<float>(random() >> 8) * 0x1p-24f;
  };
  for (int i = 0; i < 60; ++i) {
    const float size = uniform(0.02f, 0.06f), x = uniform(0.25f, 0.8f), z = uniform(-0.9f, -0.45f);
    const float y = -kRoom.y + size + uniform(0.0f, 0.3f) * static_cast<float>(i) / 60.0f;
    modeller.box({x, y, z}, {size, 0.7f * size, 1.3f * size}, uniform(0.0f, 3.0f), 1.0f, cuts,
                 materials);
  }
}

}  // namespace

scene::Scene make_room(std::size_t triangles) {
  scene::Scene scene;
  scene.file = "room";
  Modeller modeller(scene);
  // Shares of the triangles: balls 2/3, ring 1/6, walls 1/12, boxes 1/12.
  const double count = static_cast<double>(triangles);
  const auto cuts = [](double n) {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(n)));
  };

  const std::uint32_t white = modeller.diffuse("white", glm::vec3(0.75f));
  const std::uint32_t red = modeller.diffuse("red", {0.7f, 0.2f, 0.15f});
  const std::uint32_t green = modeller.diffuse("green", {0.2f, 0.6f, 0.25f});
  const std::uint32_t blue = modeller.diffuse("blue", {0.3f, 0.4f, 0.7f});
  modeller.box(glm::vec3(0.0f), kRoom, 0.0f, -1.0f, cuts(std::sqrt(count / 12.0 / 12.0)),
               {red, green, white, white, blue, white});
  scene::Material lamp;
  lamp.name = "lamp";
  lamp.base_color = glm::vec3(0.0f);
  lamp.metallic = 0.0f;
  lamp.specular = 0.0f;
  lamp.emission = glm::vec3(20.0f, 18.0f, 15.0f);
  modeller.panel({-0.2f, kRoom.y - 0.01f, -0.2f}, {0.4f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.4f}, 1,
                 modeller.material(lamp));
  add_balls(modeller, cuts(std::sqrt(count / 3.0 / 4.0)));
  const double rows = std::sqrt(count / 6.0 / 2.0 / 3.0);
  modeller.ring({-0.05f, -0.62f, 0.35f}, 0.2, 0.07, 3 * cuts(rows), cuts(rows),
                modeller.diffuse("clay", {0.6f, 0.35f, 0.3f}));
  add_heap(modeller, cuts(std::sqrt(count / 12.0 / 60.0 / 12.0)));
  scene.cameras.push_back(camera_in_room());
  find_bounds(scene);
  return scene;
}

scene::Scene make_terrain(std::size_t triangles) {
  scene::Scene scene;
  scene.file = "terrain";
  Modeller modeller(scene);
  const auto cuts =
      static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 2.0)));
  const auto height = [](double x, double z) {
    double sum = 0.0, amplitude = 0.12, frequency = 3.0;
    for (int octave = 0; octave < 7; ++octave, amplitude *= 0.45, frequency *= 2.1)
      sum += amplitude * std::sin(frequency * x + octave) * std::cos(frequency * z + 1.3 * octave);
    return sum;
  };
  modeller.sheet(cuts, cuts, modeller.diffuse("earth", glm::vec3(0.5f)), [&](double u, double v) {
    const double x = 1.98 * u - 0.99, z = 0.99 - 1.98 * v, step = 1e-5;
    const glm::dvec3 normal((height(x - step, z) - height(x + step, z)) / (2.0 * step), 1.0,
                            (height(x, z - step) - height(x, z + step)) / (2.0 * step));
    return Surface{glm::vec3(x, height(x, z), z), glm::vec3(glm::normalize(normal))};
  });
  scene::Camera camera;
  camera.name = "aloft";
  camera.position = {0.0, 0.6, 0.9};
  camera.forward = glm::normalize(glm::dvec3(0.0, -0.6, -1.0));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.yfov = 1.0;
  scene.cameras.push_back(camera);
  find_bounds(scene);
  return scene;
}

}  // namespace ppm::support
