// The summary for programs.
#include <nlohmann/json.hpp>
#include <numbers>

#include "inspect_report.hpp"

namespace ppm::cli {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json camera_json(const scene::Scene& scene, const scene::Camera& camera) {
  Json json = {{"name", camera.name},
               {"position", vector_json(scene.frame.to_world(camera.position))},
               {"forward", vector_json(camera.forward)},
               {"up", vector_json(camera.up)}};
  if (camera.ymag) {
    json["type"] = "orthographic";
    json["ymag"] = *camera.ymag / scene.frame.scale;
  } else {
    json["type"] = "perspective";
    json["yfov_degrees"] = camera.yfov * 180.0 / std::numbers::pi;
  }
  if (camera.aspect) json["aspect"] = *camera.aspect;
  return json;
}

Json lights_json(const InspectReport& report) {
  Json groups = Json::array();
  for (const LightGroup& group : report.lights) {
    Json json = {{"kind", group.kind}, {"count", group.count}, {"watts", group.watts}};
    if (!group.name.empty()) json["material"] = group.name;
    groups.push_back(std::move(json));
  }
  return {{"watts", report.total_watts}, {"groups", std::move(groups)}};
}

Json materials_json(const InspectReport& report) {
  Json list = Json::array();
  for (const MaterialSummary& material : report.materials) {
    list.push_back({{"name", material.name},
                    {"triangles", material.triangles},
                    {"surface", material.surface},
                    {"textures", material.textures}});
  }
  return list;
}

Json textures_json(const scene::Scene& scene) {
  Json list = Json::array();
  for (const scene::Texture& texture : scene.textures) {
    list.push_back({{"name", texture.name},
                    {"width", texture.width},
                    {"height", texture.height},
                    {"bytes", scene::bytes_of(texture)}});
  }
  return list;
}

Json extensions_json(const scene::Scene& scene) {
  Json list = Json::array();
  for (const scene::UsedExtension& extension : scene.findings.extensions) {
    list.push_back({{"name", extension.name},
                    {"treatment", scene::treatment_name(extension.treatment)},
                    {"note", extension.note},
                    {"required", extension.required}});
  }
  return list;
}

Json memory_json(const InspectReport& report) {
  Json parts = Json::array();
  for (const render::MemoryPart& part : report.memory.parts) {
    parts.push_back({{"name", part.name},
                     {"bytes", part.bytes},
                     {"where", part.on_device ? "device" : "host"}});
  }
  const render::Settings& settings = report.settings;
  return {{"width", settings.width},
          {"height", settings.height},
          {"spp", settings.samples_per_pixel},
          {"photons", settings.photons_per_pass},
          {"parts", std::move(parts)},
          {"peak_bytes", report.memory.peak()},
          {"host_peak_bytes", report.memory.host_peak()},
          {"device_peak_bytes", report.memory.device_peak()}};
}

}  // namespace

std::string report_json(const InspectReport& report) {
  const scene::Scene& scene = report.scene;
  Json json;
  json["file"] = scene.file;
  json["file_bytes"] = scene.findings.file_bytes;
  json["bounds"] = {{"min", vector_json(report.bounds_min)},
                    {"max", vector_json(report.bounds_max)}};
  json["triangles"] = scene.triangles.size();
  json["left_out"] = {{"without_area", scene.findings.triangles_without_area},
                      {"too_small", scene.findings.triangles_too_small}};
  json["cameras"] = Json::array();
  for (const scene::Camera& camera : scene.cameras) {
    json["cameras"].push_back(camera_json(scene, camera));
  }
  json["lights"] = lights_json(report);
  json["materials"] = materials_json(report);
  json["textures"] = textures_json(scene);
  json["extensions"] = extensions_json(scene);
  json["warnings"] = report.warnings;
  json["memory"] = memory_json(report);
  // Names come from files: what is no UTF-8 is replaced, not thrown at.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ppm::cli
