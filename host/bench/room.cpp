#include "room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "modeller.hpp"

namespace ppm::bench {
namespace {

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

void add_walls(Modeller& modeller, std::uint32_t cuts) {
  const std::uint32_t white = modeller.diffuse("white", glm::vec3(0.75f));
  const std::uint32_t red = modeller.diffuse("red", {0.7f, 0.2f, 0.15f});
  const std::uint32_t green = modeller.diffuse("green", {0.2f, 0.6f, 0.25f});
  const std::uint32_t blue = modeller.diffuse("blue", {0.3f, 0.4f, 0.7f});
  modeller.box(glm::vec3(0.0f), kRoom, 0.0f, -1.0f, cuts, {red, green, white, white, blue, white});
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

scene::Scene make_unlit_room(std::size_t triangles) {
  scene::Scene scene;
  scene.file = "room";
  Modeller modeller(scene);
  // Shares of the triangles: balls 2/3, ring 1/6, walls 1/12, boxes 1/12.
  const double count = static_cast<double>(triangles);
  const auto cuts = [](double n) {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(n)));
  };
  add_walls(modeller, cuts(std::sqrt(count / 12.0 / 12.0)));
  add_balls(modeller, cuts(std::sqrt(count / 3.0 / 4.0)));
  const double rows = std::sqrt(count / 6.0 / 2.0 / 3.0);
  modeller.ring({-0.05f, -0.62f, 0.35f}, 0.2, 0.07, 3 * cuts(rows), cuts(rows),
                modeller.diffuse("clay", {0.6f, 0.35f, 0.3f}));
  add_heap(modeller, cuts(std::sqrt(count / 12.0 / 60.0 / 12.0)));
  scene.cameras.push_back(camera_in_room());
  modeller.find_bounds();
  return scene;
}

scene::Scene make_room(std::size_t triangles) {
  scene::Scene scene = make_unlit_room(triangles);
  Modeller modeller(scene);
  modeller.panel({-0.2f, kRoom.y - 0.01f, -0.2f}, {0.4f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.4f}, 1,
                 modeller.emitter("lamp", {20.0f, 18.0f, 15.0f}));
  modeller.find_bounds();
  return scene;
}

}  // namespace ppm::bench
