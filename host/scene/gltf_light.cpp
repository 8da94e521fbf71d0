#include "gltf_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

namespace ppm::scene::gltf {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2.0;

/// The light that `node` refers to.
std::optional<Element> light_of(const Element& node) {
  const auto reference = node.extension("KHR_lights_punctual");
  if (!reference) return std::nullopt;
  const Element root(node.origin(), *node.origin().root, "");
  const auto extension = root.extension("KHR_lights_punctual");
  const Element index = reference->require("light");
  const std::uint64_t position = index.whole();
  if (!extension || position >= extension->require("lights").size()) {
    index.fail("refers to a light that the file does not have", "use an index of a light");
  }
  return extension->require("lights")[position];
}

PunctualKind kind_of(const Element& light) {
  const Element type = light.require("type");
  if (type.text() == "point") return PunctualKind::point;
  if (type.text() == "spot") return PunctualKind::spot;
  if (type.text() == "directional") return PunctualKind::directional;
  type.fail("is not a kind of light", "use point, spot or directional");
}

void read_cone(const Element& element, PunctualLight& light) {
  double inner = 0.0, outer = std::numbers::pi / 4.0;
  if (const auto spot = element.find("spot")) {
    inner = spot->number_or("innerConeAngle", inner);
    outer = spot->number_or("outerConeAngle", outer);
  }
  const double given_inner = inner, given_outer = outer;
  constexpr double kNarrowest =
      2e-3;  // 1 - cos is 2e-6 then, which single precision still resolves
  outer = std::clamp(outer, kNarrowest, kHalfPi);
  inner = std::clamp(inner, 0.0, outer * (1.0 - 1e-4));
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

/// Leaves room for the light's power and for sums over many lights in single precision.
constexpr double kLargestIntensity = 1e30;

void read_intensity(const Element& element, const Frame& frame, PunctualLight& light) {
  glm::vec3 color(1.0f);
  element.factors("color", {glm::value_ptr(color), 3}, 0.0, 1.0);
  const double intensity = element.number_or("intensity", 1.0);
  if (intensity < 0.0) element.warn("light intensity", "a negative intensity is taken as 0");
  const double scale = light.kind == PunctualKind::directional ? 1.0 : frame.scale * frame.scale;
  const double scaled = std::max(intensity, 0.0) * scale;
  if (!(scaled <= kLargestIntensity)) {
    element.fail("its intensity overflows", "use a smaller intensity");
  }
  light.intensity = glm::vec3(glm::dvec3(color) * scaled);
}

}  // namespace

std::optional<PunctualLight> read_light(const Placement& placement, const Frame& frame) {
  const std::optional<Element> element = light_of(placement.node);
  if (!element) return std::nullopt;
  PunctualLight light;
  light.name = placement.node.name().empty() ? element->name() : placement.node.name();
  light.kind = kind_of(*element);
  read_intensity(*element, frame, light);
  if (element->find("range")) element->warn("light range", "the range of lights is ignored");
  if (light.intensity == glm::vec3(0.0f)) return std::nullopt;

  light.position = glm::vec3(frame.to_working(glm::dvec3(placement.to_world[3])));
  if (!is_finite(light.position))
    placement.node.fail("its light is too far away", "move it closer");
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
