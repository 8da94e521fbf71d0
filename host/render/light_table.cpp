#include "light_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "emission_mean.hpp"

namespace ppm::render {
namespace {

constexpr double kEvenShare = 0.01;
constexpr float kUnlimited = 1e30f;  // longer than any ray

shared::Light resolve(const shared::LightRecord& record, const scene::Scene& scene,
                      std::span<const std::uint32_t> order, glm::vec3 centre, float radius) {
  shared::Light light{};
  light.record = record;
  light.bounding_centre = centre;
  light.bounding_radius = radius;
  if (record.kind == PPM_LIGHT_TRIANGLE) {
    const scene::Triangle& triangle = scene.triangles[order[record.triangle]];
    light.corner0 = triangle.corners[0].position;
    light.corner1 = triangle.corners[1].position;
    light.corner2 = triangle.corners[2].position;
    light.two_sided = scene.materials[triangle.material].double_sided ? 1.0f : 0.0f;
  }
  return light;
}

shared::LightRecord punctual_record(const scene::PunctualLight& source) {
  shared::LightRecord record{};
  record.position = source.position;
  record.kind = source.kind == scene::PunctualKind::point  ? PPM_LIGHT_POINT
                : source.kind == scene::PunctualKind::spot ? PPM_LIGHT_SPOT
                                                           : PPM_LIGHT_DIRECTIONAL;
  record.emission = source.intensity;
  record.direction = source.direction;
  record.triangle = std::bit_cast<std::uint32_t>(std::min(source.range, kUnlimited));
  record.cos_inner = std::cos(source.inner_cone_angle);
  record.cos_outer = std::cos(source.outer_cone_angle);
  return record;
}

shared::LightRecord triangle_record(const scene::Material& material, std::uint32_t slot) {
  shared::LightRecord record{};
  record.kind = PPM_LIGHT_TRIANGLE;
  record.emission = material.emission;
  record.triangle = slot;
  return record;
}

/// Mean over channels; `share` of the emission by channel.
double mean_power(const shared::Light& light, glm::vec3 share = glm::vec3(1.0f)) {
  const glm::dvec3 power = share * shared::light_power(light);
  return (power.x + power.y + power.z) / 3.0;
}

bool gives_off_light(const scene::Environment& environment) {
  return std::ranges::any_of(environment.texels, [&](const glm::vec3& texel) {
    const glm::uvec2 packed = shared::pack_radiance(texel * environment.strength);
    return shared::unpack_radiance(packed) != glm::vec3(0.0f);
  });
}

}  // namespace

bool gives_off_light(const scene::Scene& scene) {
  if (scene.environment && gives_off_light(*scene.environment)) return true;
  const glm::vec3 centre = 0.5f * (scene.bounds_min + scene.bounds_max);
  const float radius = 0.5f * glm::length(scene.bounds_max - scene.bounds_min);
  const bool has_lamp =
      std::ranges::any_of(scene.punctual_lights, [&](const scene::PunctualLight& source) {
        return mean_power(resolve(punctual_record(source), scene, {}, centre, radius)) > 0.0;
      });
  if (has_lamp) return true;
  const EmissionMean emission_mean(scene);
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const scene::Material& material = scene.materials[scene.triangles[i].material];
    if (material.emission == glm::vec3(0.0f)) continue;
    const std::uint32_t order[] = {i};
    const shared::Light light = resolve(triangle_record(material, 0), scene, order, centre, radius);
    if (mean_power(light, emission_mean.of(i)) > 0.0) return true;
  }
  return false;
}

LightTable make_light_table(const scene::Scene& scene, std::span<const std::uint32_t> order,
                            glm::vec3 bounding_centre, float bounding_radius,
                            const EnvironmentTable& environment) {
  LightTable table;
  std::vector<double>& powers = table.powers;
  const auto add = [&](const shared::LightRecord& record, glm::vec3 share = glm::vec3(1.0f)) {
    const double mean =
        mean_power(resolve(record, scene, order, bounding_centre, bounding_radius), share);
    if (!(mean > 0.0)) return;
    table.records.push_back(record);
    powers.push_back(mean);
    table.total_power += mean;
  };
  const EmissionMean emission_mean(scene);
  for (std::uint32_t slot = 0; slot < order.size(); ++slot) {
    const scene::Material& material = scene.materials[scene.triangles[order[slot]].material];
    if (material.emission == glm::vec3(0.0f)) continue;
    add(triangle_record(material, slot), emission_mean.of(order[slot]));
  }
  for (const scene::PunctualLight& source : scene.punctual_lights) add(punctual_record(source));
  if (!environment.texels.empty()) {
    shared::LightRecord record{};
    record.kind = PPM_LIGHT_ENVIRONMENT;
    record.emission = environment.irradiance;
    add(record);
  }
  if (powers.empty()) return table;

  const double even = kEvenShare * table.total_power / static_cast<double>(powers.size());
  std::vector<double> weights = powers;
  for (double& weight : weights) weight = (1.0 - kEvenShare) * weight + even;
  const AliasTable alias = make_alias_table(weights);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    table.records[i].probability = static_cast<float>(weights[i] / table.total_power);
    table.records[i].alias_threshold = alias.threshold[i];
    table.records[i].alias = alias.alias[i];
  }
  return table;
}

}  // namespace ppm::render
