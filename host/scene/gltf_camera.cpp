#include "gltf_camera.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace ppm::scene::gltf {
namespace {

constexpr double kLargestAspect = 1e4;
constexpr double kSmallestMag = 1e-9, kLargestMag = 1e9;  // what single precision can square

double checked_aspect(const Place& place, double aspect) {
  if (!(aspect >= 1.0 / kLargestAspect && aspect <= kLargestAspect)) {
    place.fail("is not the aspect of any picture", "write width / height");
  }
  return aspect;
}

/// Surfaces are not cut off there, but who writes such planes means something else. `zfar` is 0
/// where there is none.
void check_planes(const Place& camera, double znear, double zfar) {
  if (zfar != 0.0 && !(zfar > znear)) {
    camera.member("zfar").fail("is not beyond znear", "write the larger one as zfar");
  }
}

void read_perspective(const Element<tinygltf::Camera>& element, Camera& camera) {
  const Place place = element.member("perspective");
  camera.yfov = element->perspective.yfov;
  if (!(camera.yfov > 0.0 && camera.yfov < std::numbers::pi)) {
    place.member("yfov").fail("is not between 0 and pi", "write the full angle in radians");
  }
  check_planes(place, element->perspective.znear, element->perspective.zfar);
  const double aspect = element->perspective.aspectRatio;
  if (aspect != 0.0) {  // tinygltf's sign of absence
    camera.aspect = checked_aspect(place.member("aspectRatio"), aspect);
  }
}

void read_orthographic(const Element<tinygltf::Camera>& element, double scale, Camera& camera) {
  const Place place = element.member("orthographic");
  const double xmag = std::abs(element->orthographic.xmag);
  const double ymag = std::abs(element->orthographic.ymag);
  if (xmag != element->orthographic.xmag || ymag != element->orthographic.ymag) {
    place.warn("negative magnifications", "negative magnifications are taken as positive");
  }
  for (const auto& [name, mag] : {std::pair("xmag", xmag), std::pair("ymag", ymag)}) {
    if (mag * scale >= kSmallestMag && mag * scale <= kLargestMag) continue;
    place.member(name).fail("is out of all proportion to the scene",
                            "write half the width and height seen");
  }
  check_planes(place, element->orthographic.znear, element->orthographic.zfar);
  camera.ymag = ymag * scale;
  camera.aspect = checked_aspect(place.member("xmag"), xmag / ymag);
}

}  // namespace

std::optional<Camera> read_camera(const Placement& placement, const Frame& frame) {
  const Element<tinygltf::Node>& node = placement.node;
  if (node->camera == -1) return std::nullopt;
  const auto element = follow(node.member("camera"), node->camera, node.model().cameras, "cameras");
  Camera camera;
  camera.name = node->name.empty() ? element.name() : node.name();
  if (element->type == "orthographic") {
    read_orthographic(element, frame.scale, camera);
  } else {
    read_perspective(element, camera);
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
