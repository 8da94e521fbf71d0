#include "gltf_camera.hpp"

#include <cmath>
#include <numbers>

namespace ppm::scene::gltf {
namespace {

constexpr double kLargestAspect = 1e4;

}  // namespace

std::optional<Camera> read_camera(const Placement& placement, const Frame& frame) {
  const Element<tinygltf::Node>& node = placement.node;
  if (node->camera == -1) return std::nullopt;
  const auto element = follow(node.member("camera"), node->camera, node.model().cameras, "cameras");
  if (element->type != "perspective") {
    element.warn("camera type", "only perspective cameras are read");
    return std::nullopt;
  }
  const Place perspective = element.member("perspective");
  Camera camera;
  camera.name = node->name.empty() ? element.name() : node.name();
  camera.yfov = element->perspective.yfov;
  if (!(camera.yfov > 0.0 && camera.yfov < std::numbers::pi)) {
    perspective.member("yfov").fail("is not between 0 and pi", "write the full angle in radians");
  }
  const double aspect = element->perspective.aspectRatio;
  if (aspect != 0.0) {  // tinygltf's sign of absence
    if (!(aspect >= 1.0 / kLargestAspect && aspect <= kLargestAspect)) {
      perspective.member("aspectRatio")
          .fail("is not the aspect of any picture", "write width / height");
    }
    camera.aspect = aspect;
  }
  const auto forward = unit(-glm::dvec3(placement.to_world[2]));
  const auto up = unit(glm::dvec3(placement.to_world[1]));
  const auto right = forward && up ? unit(glm::cross(*forward, *up)) : std::nullopt;
  if (!right) {
    node.warn("camera transform", "a camera whose node flattens space is ignored");
    return std::nullopt;
  }
  camera.position = frame.to_working(glm::dvec3(placement.to_world[3]));
  if (!std::isfinite(glm::dot(camera.position, camera.position))) {
    node.fail("its camera is too far away", "move it closer");
  }
  camera.forward = *forward;
  camera.right = *right;
  camera.up = glm::cross(camera.right, camera.forward);
  return camera;
}

}  // namespace ppm::scene::gltf
