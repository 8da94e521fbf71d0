#include "uneven_room.hpp"

#include <cmath>
#include <numbers>

#include "modeller.hpp"

namespace ppm::bench {
namespace {

/// A spot of unit power that lights a disc of `radius` about `target`, from `distance` away along
/// `normal`, evenly but for its rim.
void add_spot(scene::Scene& scene, glm::vec3 target, glm::vec3 normal, float distance,
              float radius) {
  scene::PunctualLight light;
  light.name = "spot";
  light.kind = scene::PunctualKind::spot;
  light.position = target + distance * normal;
  light.direction = -normal;
  light.outer_cone_angle = std::atan(radius / distance);
  light.inner_cone_angle = 0.9f * light.outer_cone_angle;
  const float solid_angle =
      2.0f * std::numbers::pi_v<float> * (1.0f - std::cos(light.outer_cone_angle));
  light.intensity = glm::vec3(1.0f / solid_angle);
  scene.punctual_lights.push_back(light);
}

/// A square card that faces the camera from `distance` away, `x` and `y` off its axis (tangents of
/// angles), with a spot on it.
void add_card(scene::Scene& scene, Modeller& modeller, std::uint32_t material, glm::vec3 at,
              float spot_radius) {
  const scene::Camera& camera = scene.cameras.front();
  const glm::vec3 eye(camera.position), right(camera.right), up(camera.up), forward(camera.forward);
  const glm::vec3 centre = eye + at.z * (forward + at.x * right + at.y * up);
  const float half = 1.5f * spot_radius;
  modeller.panel(centre - half * right - half * up, 2.0f * half * right, 2.0f * half * up, 4,
                 material);
  // From the side of the view: the light itself has no extent and hides nothing.
  add_spot(scene, centre, -forward, 3.0f * spot_radius, spot_radius);
}

}  // namespace

scene::Scene make_uneven_room(std::size_t triangles) {
  scene::Scene scene = make_unlit_room(triangles);
  scene.file = "uneven";
  Modeller modeller(scene);
  const std::uint32_t slate = modeller.diffuse("slate", glm::vec3(0.1f));
  add_card(scene, modeller, slate, {-0.45f, -0.3f, 0.15f}, 0.01f);
  add_card(scene, modeller, slate, {-0.45f, 0.25f, 0.3f}, 0.03f);
  add_spot(scene, {0.6f, -kRoom.y, 0.0f}, {0.0f, 1.0f, 0.0f}, 0.5f, 0.09f);
  add_spot(scene, {0.2f, 0.2f, -kRoom.z}, {0.0f, 0.0f, 1.0f}, 0.8f, 0.27f);
  modeller.find_bounds();
  return scene;
}

}  // namespace ppm::bench
