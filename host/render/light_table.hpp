// The scene's lights as the kernels read them, each chosen in proportion to its power.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "alias_table.hpp"
#include "environment_table.hpp"
#include "scene.hpp"
#include "shared/light.h"

namespace ppm::render {

struct LightTable {
  std::vector<shared::LightRecord>
      records;                 ///< with alias bins filled in; empty: no light gives off anything
  std::vector<double> powers;  ///< of each record, mean over channels, W * frame.scale^2
  double total_power = 0.0;    ///< sum of all lights' power, mean over channels, W * frame.scale^2
};

/// Whether a light table of the scene would hold any light. Throws nothing and builds nothing, so
/// that darkness is found before the work for it begins.
bool gives_off_light(const scene::Scene& scene);

/// All emissive triangles (`order`: leaf slot -> triangle), punctual lights and the environment, if
/// they have any power.
/// Probabilities are proportional to power but for a hundredth that all share alike, so that a lamp
/// beside the sun is not starved.
LightTable make_light_table(const scene::Scene& scene, std::span<const std::uint32_t> order,
                            glm::vec3 bounding_centre, float bounding_radius,
                            const EnvironmentTable& environment = {});

}  // namespace ppm::render
