// The summary for people.
#include <fmt/format.h>

#include <numbers>

#include "inspect_report.hpp"

namespace ppm::cli {
namespace {

std::string point(const glm::dvec3& p) {
  return fmt::format("{:.5g} {:.5g} {:.5g}", p.x, p.y, p.z);
}

std::string quoted(const std::string& name) {
  return name.empty() ? "unnamed" : "\"" + name + "\"";
}

std::string head(const InspectReport& report) {
  const scene::Scene& scene = report.scene;
  const glm::dvec3 size = report.bounds_max - report.bounds_min;
  std::string text =
      fmt::format("{}: {}\n", scene.file, render::size_text(scene.findings.file_bytes));
  text += fmt::format("bounds: {} to {}, {:.5g} x {:.5g} x {:.5g} units (metres in glTF)\n",
                      point(report.bounds_min), point(report.bounds_max), size.x, size.y, size.z);
  text += fmt::format("triangles: {}", scene.triangles.size());
  const scene::Findings& found = scene.findings;
  if (found.triangles_without_area > 0) {
    text += fmt::format("; {} without area were left out", found.triangles_without_area);
  }
  if (found.triangles_too_small > 0) {
    text +=
        fmt::format("; {} too small for single precision were left out", found.triangles_too_small);
  }
  return text + "\n";
}

std::string cameras(const scene::Scene& scene) {
  if (scene.cameras.empty()) return "cameras: none; the scene is framed automatically\n";
  std::string text = "cameras:\n";
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const scene::Camera& camera = scene.cameras[i];
    text += fmt::format("  {} {}: {}, at {}, looks along {}\n", i, quoted(camera.name),
                        lens_text(scene, camera), point(scene.frame.to_world(camera.position)),
                        point(camera.forward));
  }
  return text;
}

std::string lights(const InspectReport& report) {
  if (report.lights.empty()) return "lights: none; the picture would be black\n";
  std::string text =
      fmt::format("lights: {:.5g} W in all (mean over channels)\n", report.total_watts);
  for (const LightGroup& group : report.lights) {
    text += fmt::format("  {:.5g} W from {} {}", group.watts, group.count, group.kind);
    if (!group.name.empty()) text += " of " + quoted(group.name);
    text += "\n";
  }
  return text;
}

std::string materials(const InspectReport& report) {
  std::string text = "materials:\n";
  for (const MaterialSummary& material : report.materials) {
    text += fmt::format("  {}: {}; {} triangles", quoted(material.name), material.surface,
                        material.triangles);
    if (!material.textures.empty()) {
      text += fmt::format("; textures: {}", fmt::join(material.textures, ", "));
    }
    text += "\n";
  }
  return text;
}

std::string textures(const scene::Scene& scene) {
  if (scene.textures.empty()) return "";
  std::string text = "textures:\n";
  for (const scene::Texture& texture : scene.textures) {
    text += fmt::format("  {}: {} x {}, {}\n", quoted(texture.name), texture.width, texture.height,
                        render::size_text(scene::bytes_of(texture)));
  }
  return text;
}

std::string extensions(const scene::Scene& scene) {
  if (scene.findings.extensions.empty()) return "";
  std::string text = "extensions:\n";
  for (const scene::UsedExtension& extension : scene.findings.extensions) {
    text +=
        fmt::format("  {}: {}{}{}{}\n", extension.name, scene::treatment_name(extension.treatment),
                    extension.note.empty() ? "" : ", ", extension.note,
                    extension.required ? " (required)" : "");
  }
  return text;
}

std::string memory(const InspectReport& report) {
  const render::Settings& settings = report.settings;
  const std::string method =
      render::method_named(settings.integrator).unit == render::PassUnit::photons
          ? fmt::format("{} eye paths a pixel, {} photons a pass", settings.samples_per_pixel,
                        settings.photons_per_pass)
          : "by " + settings.integrator;
  std::string text =
      fmt::format("memory of a rendering at {} x {}, {}: {} at its peak\n", settings.width,
                  settings.height, method, render::size_text(report.memory.peak()));
  for (const render::MemoryPart& part : report.memory.parts) {
    if (part.bytes > 0) {
      text += fmt::format("  {}: {}\n", part.name, render::size_text(part.bytes));
    }
  }
  return text;
}

}  // namespace

std::string lens_text(const scene::Scene& scene, const scene::Camera& camera) {
  if (camera.ymag) {
    return fmt::format("orthographic, {:.5g} units high", 2.0 * *camera.ymag / scene.frame.scale);
  }
  return fmt::format("perspective, {:.4g} degrees high", camera.yfov * 180.0 / std::numbers::pi);
}

std::string report_text(const InspectReport& report) {
  std::string text = head(report) + cameras(report.scene) + lights(report) + materials(report) +
                     textures(report.scene) + extensions(report.scene);
  if (!report.warnings.empty()) text += "warnings:\n";
  for (const std::string& warning : report.warnings) text += "  " + warning + "\n";
  return text + memory(report);
}

}  // namespace ppm::cli
