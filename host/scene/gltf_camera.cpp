#include "gltf_camera.hpp"

#include <cmath>
#include <numbers>

namespace ppm::scene::gltf {
namespace {

constexpr double kLargestAspect = 1e4;

}  // namespace

std::optional<Camera> read_camera(const Placement& placement, const Frame& frame) {
  const Element& node = placement.node;
  if (!node.find("camera")) return std::nullopt;
  const Element element = node.follow("camera", "cameras");
  if (element.require("type").text() != "perspective") {
    element.warn("camera type", "only perspective cameras are read");
    return std::nullopt;
  }
  const Element perspective = element.require("perspective");
  Camera camera;
  camera.name = node.name().empty() ? element.name() : node.name();
  camera.yfov = perspective.require("yfov").number();
  if (!(camera.yfov > 0.0 && camera.yfov < std::numbers::pi)) {
    perspective.require("yfov").fail("is not between 0 and pi", "write the full angle in radians");
  }
  if (const auto aspect = perspective.find("aspectRatio")) {
    if (!(aspect->number() >= 1.0 / kLargestAspect && aspect->number() <= kLargestAspect)) {
      aspect->fail("is not the aspect of any picture", "write width / height");
    }
    camera.aspect = aspect->number();
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
