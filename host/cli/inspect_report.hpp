// A scene as a person wants to know it: what `ppm-vk inspect` prints as text or as JSON.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "memory_plan.hpp"
#include "scene.hpp"

namespace ppm::cli {

/// Lights of one kind, or the emissive triangles of one material.
struct LightGroup {
  std::string kind;  ///< "emissive triangles", "point", "spot", "directional", "environment"
  std::string name;  ///< the material's; empty for the others
  std::uint64_t count = 0;
  double watts = 0.0;  ///< mean over channels, of all together
};

struct MaterialSummary {
  std::string name;
  std::uint64_t triangles = 0;
  std::string surface;                ///< "rough metal", "glass, ior 1.5": as it is rendered
  std::vector<std::string> textures;  ///< what for: "base colour", ...
};

struct InspectReport {
  const scene::Scene& scene;
  glm::dvec3 bounds_min, bounds_max;  ///< of the file's units
  std::vector<LightGroup> lights;     ///< those with power, the strongest first
  double total_watts = 0.0;
  std::vector<MaterialSummary> materials;
  render::Settings settings;  ///< that the plan is for
  render::MemoryPlan memory;
  std::vector<std::string> warnings;
};

/// `settings` are those of a rendering by default, with the scene's first camera.
InspectReport inspect(const scene::Scene& scene, const render::Settings& settings,
                      std::vector<std::string> warnings);

/// "perspective, 45 degrees high" or "orthographic, 2 units high": of a camera of the scene.
std::string lens_text(const scene::Scene& scene, const scene::Camera& camera);

std::string report_text(const InspectReport& report);
/// See README, "inspect".
std::string report_json(const InspectReport& report);

}  // namespace ppm::cli
