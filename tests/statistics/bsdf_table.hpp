// The table of surfaces that every BSDF test runs through. A new material needs one row here.
#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "direction_chart.hpp"
#include "shared/bsdf.h"

namespace ppm::statistics {

struct BsdfRow {
  std::string name;
  shared::Bsdf bsdf;
  bool lossless = false;  ///< reflects and transmits all light, whatever the direction

  /// The same surface met from the other side, along the same path.
  shared::Bsdf other_side() const { return shared::other_side(bsdf); }
};

const std::vector<BsdfRow>& bsdf_table();

/// What gtest prints of a row and calls its tests.
inline void PrintTo(const BsdfRow& row, std::ostream* out) {
  *out << row.name;
}
inline std::string row_name(const ::testing::TestParamInfo<BsdfRow>& info) {
  return info.param.name;
}

/// Directions from straight above to grazing, at assorted azimuths.
std::vector<glm::vec3> outgoing_directions();

/// The same direction on the other side of the surface.
inline glm::dvec3 below(glm::dvec3 w) {
  return {w.x, w.y, -w.z};
}

/// Cells that gather around the mirror direction as closely as the lobe does.
DirectionChart chart_for(const shared::Bsdf& bsdf, glm::vec3 wo);
/// Cells of the directions below the surface, mirrored up, around the refracted one.
DirectionChart chart_below(const shared::Bsdf& bsdf, glm::vec3 wo);

/// Share of light from wo that leaves the surface: quadrature of f cos, and the specular lobes.
glm::dvec3 directional_albedo(const shared::Bsdf& bsdf, glm::vec3 wo);

/// Quadrature of f cos over the hemisphere, or over the sphere where glass is rough, for flux.
glm::dvec3 non_specular_albedo(const shared::Bsdf& bsdf, glm::vec3 wo);

/// bsdf_eval in double precision, from the literature's other forms: Walter et al.'s distribution
/// by tangents, the height-correlated masking in its product form, coats averaged by quadrature,
/// rough glass as Walter et al. have it (radiance).
glm::dvec3 reference_eval(const shared::Bsdf& bsdf, glm::dvec3 wo, glm::dvec3 wi);

}  // namespace ppm::statistics
