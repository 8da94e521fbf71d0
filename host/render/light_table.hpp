// The scene's lights as the kernels read them, each chosen in proportion to its power.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene.hpp"
#include "shared/light.h"

namespace ppm::render {

struct LightTable {
  std::vector<shared::LightRecord>
      records;                 ///< with alias bins filled in; empty: no light gives off anything
  std::vector<double> powers;  ///< of each record, mean over channels, W * frame.scale^2
  double total_power = 0.0;    ///< sum of all lights' power, mean over channels, W * frame.scale^2
};

/// Vose's alias method (1991) over `weights` (all >= 0, their sum > 0): bin i keeps i while a
/// random 32-bit word is below threshold[i], else takes alias[i]. The chance of each index is
/// weights[i] / sum up to 2^-32.
struct AliasTable {
  std::vector<std::uint32_t> threshold, alias;
};
AliasTable make_alias_table(std::span<const double> weights);

/// All emissive triangles (`order`: leaf slot -> triangle) and punctual lights with any power.
/// Probabilities are proportional to power but for a hundredth that all share alike, so that a lamp
/// beside the sun is not starved.
LightTable make_light_table(const scene::Scene& scene, std::span<const std::uint32_t> order,
                            glm::vec3 bounding_centre, float bounding_radius);

}  // namespace ppm::render
