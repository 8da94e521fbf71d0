#include "inspect_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "light_table.hpp"
#include "shared/bsdf.h"

namespace ppm::cli {
namespace {

const char* kind_of(std::uint32_t kind) {
  switch (kind) {
    case PPM_LIGHT_TRIANGLE:
      return "emissive triangles";
    case PPM_LIGHT_POINT:
      return "point";
    case PPM_LIGHT_SPOT:
      return "spot";
    case PPM_LIGHT_DIRECTIONAL:
      return "directional";
    default:
      return "environment";
  }
}

/// As the kernels know them.
render::LightTable lights_of(const scene::Scene& scene) {
  std::vector<std::uint32_t> order(scene.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  const glm::vec3 centre = 0.5f * (scene.bounds_min + scene.bounds_max);
  const float radius = 0.5f * glm::length(scene.bounds_max - scene.bounds_min);
  return render::make_light_table(scene, order, centre, radius);
}

std::vector<LightGroup> group_lights(const scene::Scene& scene, const render::LightTable& table) {
  constexpr std::uint32_t kNoMaterial = 0xffffffffu;
  const double to_watts = 1.0 / (scene.frame.scale * scene.frame.scale);
  std::map<std::pair<std::uint32_t, std::uint32_t>, LightGroup> groups;
  for (std::size_t i = 0; i < table.records.size(); ++i) {
    const shared::LightRecord& record = table.records[i];
    const bool emissive = record.kind == PPM_LIGHT_TRIANGLE;
    const std::uint32_t material =
        emissive ? scene.triangles[record.triangle].material : kNoMaterial;
    LightGroup& group = groups[{record.kind, material}];
    group.kind = kind_of(record.kind);
    if (emissive) group.name = scene.materials[material].name;
    ++group.count;
    group.watts += table.powers[i] * to_watts;
  }
  std::vector<LightGroup> sorted;
  for (auto& [key, group] : groups) sorted.push_back(std::move(group));
  std::ranges::stable_sort(sorted, std::greater{}, &LightGroup::watts);
  return sorted;
}

bool is_smooth(float roughness) {
  return roughness < PPM_DELTA_ROUGHNESS;
}

/// "0.25 glass": a share that is not all of it.
std::string part(double share, const std::string& what) {
  return share < 1.0 ? fmt::format("{:.3g} {}", share, what) : what;
}

std::string glass_of(const scene::Material& material) {
  std::string text = material.solid ? "solid glass" : "thin glass";
  if (!is_smooth(material.roughness)) text = "rough " + text;
  text += fmt::format(", ior {:.4g}", material.ior);
  if (material.solid && std::isfinite(material.attenuation_distance)) text += ", attenuating";
  if (material.dispersion > 0.0f) {
    text += fmt::format(", Abbe number {:.3g}", 20.0f / material.dispersion);
  }
  return text;
}

/// What light meets, in the order of the model's layers.
std::string surface_of(const scene::Material& material) {
  if (material.unlit) return "unlit";
  std::vector<std::string> parts;
  const double dielectric = 1.0 - material.metallic;
  if (material.clearcoat > 0.0f) {
    parts.push_back(part(material.clearcoat, is_smooth(material.clearcoat_roughness)
                                                 ? "smooth clear coat"
                                                 : "rough clear coat"));
  }
  if (material.metallic > 0.0f) {
    parts.push_back(
        part(material.metallic, is_smooth(material.roughness)
                                    ? "metallic mirror"
                                    : fmt::format("metal, roughness {:.3g}", material.roughness)));
  }
  if (dielectric > 0.0 && material.transmission > 0.0f) {
    parts.push_back(part(dielectric * material.transmission, glass_of(material)));
  }
  const double opaque = dielectric * (1.0 - material.transmission);
  if (opaque > 0.0 && material.specular <= 0.0f) {
    parts.push_back(part(opaque, "diffuse"));
  } else if (opaque > 0.0) {
    parts.push_back(part(
        opaque, is_smooth(material.roughness)
                    ? "diffuse under a mirroring surface"
                    : fmt::format("diffuse under gloss, roughness {:.3g}", material.roughness)));
  }
  if (material.alpha_mode == scene::AlphaMode::mask) {
    parts.push_back(fmt::format("alpha mask at {:.3g}", material.alpha_cutoff));
  }
  if (material.alpha_mode == scene::AlphaMode::blend) parts.push_back("alpha blended");
  if (material.emission != glm::vec3(0.0f)) {
    const glm::vec3& e = material.emission;
    parts.push_back(fmt::format("emits {:.4g} {:.4g} {:.4g} W/(m2 sr){}", e.x, e.y, e.z,
                                material.double_sided ? " from both sides" : ""));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::vector<std::string> textures_of(const scene::Material& material) {
  const std::pair<const char*, const scene::OptionalTextureUse*> uses[] = {
      {"base colour", &material.base_color_texture},
      {"metallic-roughness", &material.metallic_roughness_texture},
      {"normal", &material.normal_texture},
      {"emissive", &material.emissive_texture},
      {"transmission", &material.transmission_texture},
      {"specular", &material.specular_texture},
      {"specular colour", &material.specular_color_texture},
      {"clear coat", &material.clearcoat_texture},
      {"clear coat roughness", &material.clearcoat_roughness_texture},
  };
  std::vector<std::string> names;
  for (const auto& [name, use] : uses) {
    if (*use) names.emplace_back(name);
  }
  return names;
}

}  // namespace

InspectReport inspect(const scene::Scene& scene, const render::Settings& settings,
                      std::vector<std::string> warnings) {
  const render::LightTable table = lights_of(scene);
  InspectReport report{
      scene,
      scene.frame.to_world(scene.bounds_min),
      scene.frame.to_world(scene.bounds_max),
      group_lights(scene, table),
      table.total_power / (scene.frame.scale * scene.frame.scale),
      {},
      settings,
      render::memory_plan(scene::SceneSize::of(scene), settings, render::PassLimits::of_cpu()),
      std::move(warnings)};
  for (const scene::Material& material : scene.materials) {
    report.materials.push_back({material.name, 0, surface_of(material), textures_of(material)});
  }
  for (const scene::Triangle& triangle : scene.triangles) {
    ++report.materials[triangle.material].triangles;
  }
  return report;
}

}  // namespace ppm::cli
