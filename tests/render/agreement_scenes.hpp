// Scenes whose pictures are known, for every method: what each pixel block must show.
#pragma once

#include <functional>
#include <vector>

#include "render_harness.hpp"

namespace ppm::test {

constexpr std::uint32_t kAgreementPixels = 16, kAgreementBlock = 8;

struct AgreementScene {
  const char* name;
  std::uint32_t max_depth;
  double slack;     ///< relative error of what is expected
  unsigned effort;  ///< samples of a pixel, a seed, that show an error of some hundredths
  scene::Scene (*make)();
  /// Means of all blocks, row by row.
  std::function<std::vector<glm::dvec3>(const render::Settings&)> expected;
};
inline void PrintTo(const AgreementScene& scene, std::ostream* stream) {
  *stream << scene.name;
}

/// Furnaces, punctual lights, areas, skies, mirrors, panes, media and veils.
std::vector<AgreementScene> agreement_scenes();

/// A closed room of diffuse, glossy, rough glass and half covering things under a coated lamp and a
/// point light: no light comes to diffuse things by way of delta lobes only.
GltfWriter glossy_room();

}  // namespace ppm::test
