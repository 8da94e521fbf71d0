#include "report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace ppm::render {
namespace {

const char* filter_name(Filter filter) {
  switch (filter) {
    case Filter::box:
      return "box";
    case Filter::tent:
      return "tent";
    case Filter::gaussian:
      return "gaussian";
  }
  return "";
}

std::string vector_text(const glm::dvec3& v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

}  // namespace

std::string radius_text(const Settings& settings) {
  switch (settings.radius_mode) {
    case RadiusMode::automatic:
      return "auto";
    case RadiusMode::footprint:
      return "footprint";
    case RadiusMode::fixed:
      return fmt::format("{}", settings.radius);
  }
  return "";
}

std::vector<image::Attribute> picture_attributes(const Settings& settings,
                                                 const Circumstances& circumstances,
                                                 const Statistics& statistics) {
  const scene::Camera& camera = settings.camera;
  const auto number = [](auto value) { return static_cast<double>(value); };
  const Method method = method_named(settings.integrator);
  std::vector<image::Attribute> attributes = {
      {"ppm-vk:program", circumstances.program},
      {"ppm-vk:device", circumstances.device},
      {"ppm-vk:driver", circumstances.driver},
      {"ppm-vk:scene", circumstances.scene.filename().string()},
      {"ppm-vk:integrator", settings.integrator},
      {"ppm-vk:passes", number(statistics.passes)},
      {"ppm-vk:samples", number(statistics.samples)},
      {"ppm-vk:mutations", number(statistics.mutations)},
      {"ppm-vk:photons_emitted", number(statistics.photons_emitted)},
      {"ppm-vk:filter", std::string(filter_name(settings.filter))},
      {"ppm-vk:seed", number(settings.seed)},
      {"ppm-vk:max_depth", number(settings.max_depth)},
      {"ppm-vk:camera", camera.name},
      {"ppm-vk:camera_position", vector_text(circumstances.frame.to_world(camera.position))},
      {"ppm-vk:camera_forward", vector_text(camera.forward)},
      {"ppm-vk:camera_up", vector_text(camera.up)},
      camera.ymag ? image::Attribute{"ppm-vk:camera_ymag", *camera.ymag / circumstances.frame.scale}
                  : image::Attribute{"ppm-vk:camera_fov", camera.yfov * 180.0 / std::numbers::pi},
  };
  const auto add = [&](const char* option, image::Attribute attribute) {
    if (method.has_option(option)) attributes.push_back(std::move(attribute));
  };
  add("--photons", {"ppm-vk:photons", number(settings.photons_per_pass)});
  add("--alpha", {"ppm-vk:alpha", settings.alpha});
  add("--map-photons", {"ppm-vk:map_photons", number(settings.map_photons)});
  add("--map-photons", {"ppm-vk:photons_stored", number(statistics.map_photons)});
  add("--nearest", {"ppm-vk:nearest", number(settings.nearest)});
  add("--radius", {"ppm-vk:radius", radius_text(settings)});
  if (method.unit == PassUnit::photons) {
    attributes.push_back({"ppm-vk:spp", number(settings.samples_per_pixel)});
  }
  attributes.insert(attributes.end(), circumstances.load_attributes.begin(),
                    circumstances.load_attributes.end());
  return attributes;
}

std::string statistics_json(const Settings& settings, const Circumstances& circumstances,
                            const Statistics& statistics,
                            const std::map<std::string, double>& seconds,
                            const std::vector<std::string>& warnings) {
  nlohmann::ordered_json json;
  json["program"] = circumstances.program;
  json["scene"] = circumstances.scene.string();
  json["integrator"] = settings.integrator;
  json["device"] = circumstances.device;
  json["driver"] = circumstances.driver;
  json["width"] = settings.width;
  json["height"] = settings.height;
  json["triangles"] = statistics.triangles;
  json["lights"] = statistics.lights;
  json["hit_points"] = statistics.hit_points;
  json["tiles"] = statistics.tiles;
  json["passes"] = statistics.passes;
  json["photons_emitted"] = statistics.photons_emitted;
  json["photons_stored"] = statistics.photons_stored;
  json["samples"] = statistics.samples;
  json["mutations"] = statistics.mutations;
  json["alpha"] = settings.alpha;
  json["seed"] = settings.seed;
  json["initial_radius"] = {{"min", statistics.initial_radius_min},
                            {"median", statistics.initial_radius_median},
                            {"max", statistics.initial_radius_max}};
  if (method_named(settings.integrator).has_option("--nearest")) {
    json["photon_map"] = {{"photons", statistics.map_photons},
                          {"most_photons", settings.map_photons},
                          {"nearest", settings.nearest},
                          {"radius",
                           {{"min", statistics.nearest_radius_min},
                            {"median", statistics.nearest_radius_median},
                            {"max", statistics.nearest_radius_max}}}};
  }
  for (const char* stage : {"load", "bvh", "upload", "pipelines", "pilot", "eye", "photons", "grid",
                            "update", "resolve", "write", "total"}) {
    json["seconds"][stage] = 0.0;
  }
  for (const auto& [stage, time] : statistics.seconds) json["seconds"][stage] = time;
  for (const auto& [stage, time] : seconds) json["seconds"][stage] = time;
  json["pass_seconds"] = statistics.pass_seconds;
  json["kernel_seconds"] = statistics.kernel_seconds;
  json["device_memory_bytes"] = circumstances.device_memory_bytes();
  json["paths_cut"] = statistics.paths_cut;
  json["rejected"] = {{"non_finite", 0}, {"clamped", 0}, {"overflow", 0}};
  for (const auto& [reason, count] : statistics.rejected) json["rejected"][reason] = count;
  json["warnings"] = warnings;
  // Names come from files and drivers: what is no UTF-8 is replaced, not thrown at.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace ppm::render
