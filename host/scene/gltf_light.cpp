#include "gltf_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

namespace ppm::scene::gltf {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2.0;

/// The light that `node` refers to.
std::optional<Element<tinygltf::Light>> light_of(const Element<tinygltf::Node>& node) {
  const auto extension = Extension::find(node, node->extensions, "KHR_lights_punctual");
  if (!extension) return std::nullopt;
  const Place reference = extension->member("light");
  const double index = extension->number("light").value_or(-1.0);
  if (index != std::floor(index)) reference.fail("is not a whole number", "write an index");
  return follow(reference, static_cast<int>(std::clamp(index, -1.0, 2147483647.0)),
                node.model().lights, "extensions.KHR_lights_punctual.lights");
}

PunctualKind kind_of(const Element<tinygltf::Light>& light) {
  if (light->type == "point") return PunctualKind::point;
  if (light->type == "spot") return PunctualKind::spot;
  if (light->type == "directional") return PunctualKind::directional;
  light.member("type").fail("is not a kind of light", "use point, spot or directional");
}

void read_cone(const Element<tinygltf::Light>& element, PunctualLight& light) {
  const double given_inner = element->spot.innerConeAngle;
  const double given_outer = element->spot.outerConeAngle;
  constexpr double kNarrowest =
      2e-3;  // 1 - cos is 2e-6 then, which single precision still resolves
  const double outer = std::clamp(given_outer, kNarrowest, kHalfPi);
  const double inner = std::clamp(given_inner, 0.0, outer * (1.0 - 1e-4));
  if (inner != given_inner || outer != given_outer) {
    element.warn("cone angles",
                 "its cone angles are not 0 <= inner < outer <= pi/2 and were clamped");
  }
  light.inner_cone_angle = static_cast<float>(inner);
  light.outer_cone_angle = std::min(static_cast<float>(outer), std::numbers::pi_v<float> / 2.0f);
}

bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unlike directions, neither range nor intensity changes with the scale of the node.
void read_range(const Element<tinygltf::Light>& element, const Frame& frame, PunctualLight& light) {
  if (element->range == 0.0 || light.kind == PunctualKind::directional) return;  // 0: absent
  const auto range = static_cast<float>(element->range * frame.scale);
  if (range > 0.0f) {
    light.range = range;
  } else {
    element.member("range").warn("light range", "is not positive and is ignored");
  }
}

/// Leaves room for the light's power and for sums over many lights in single precision.
constexpr double kLargestIntensity = 1e30;

void read_intensity(const Element<tinygltf::Light>& element, const Frame& frame,
                    double luminous_efficacy, PunctualLight& light) {
  glm::vec3 color(1.0f);
  if (!element->color.empty()) {
    element.member("color").clamped(element->color, {glm::value_ptr(color), 3}, 0.0, 1.0);
  }
  const double intensity = element->intensity;
  if (intensity < 0.0) element.warn("light intensity", "a negative intensity is taken as 0");
  const double scale = light.kind == PunctualKind::directional ? 1.0 : frame.scale * frame.scale;
  const double scaled = std::max(intensity, 0.0) / luminous_efficacy * scale;
  if (!(scaled <= kLargestIntensity)) {
    element.fail("its intensity overflows", "use a smaller intensity");
  }
  light.intensity = glm::vec3(glm::dvec3(color) * scaled);
}

}  // namespace

std::optional<PunctualLight> read_light(const Placement& placement, const Frame& frame,
                                        double luminous_efficacy) {
  const auto element = light_of(placement.node);
  if (!element) return std::nullopt;
  PunctualLight light;
  light.name = placement.node->name.empty() ? element->name() : placement.node.name();
  light.kind = kind_of(*element);
  read_intensity(*element, frame, luminous_efficacy, light);
  if (light.intensity == glm::vec3(0.0f)) return std::nullopt;

  light.position = glm::vec3(frame.to_working(glm::dvec3(placement.to_world[3])));
  if (!is_finite(light.position))
    placement.node.fail("its light is too far away", "move it closer");
  read_range(*element, frame, light);
  if (light.kind == PunctualKind::point) return light;

  const std::optional<glm::dvec3> direction = unit(-glm::dvec3(placement.to_world[2]));
  if (!direction) {
    placement.node.warn("light direction", "a light whose node has no extent along z is ignored");
    return std::nullopt;
  }
  light.direction = glm::vec3(*direction);
  if (light.kind == PunctualKind::spot) read_cone(*element, light);
  return light;
}

}  // namespace ppm::scene::gltf
