// The scene that most of these tests render.
#pragma once

#include "gltf_writer.hpp"

namespace ppm::test {

/// A lamp of this intensity over a floor, seen by a camera called "above", twice as wide as high.
inline GltfWriter lit_floor(double grey = 0.5, double intensity = 10.0) {
  GltfWriter writer;
  writer.mesh(quad({-1.0f, 0.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}),
              writer.material(lambert(glm::dvec3(grey))));
  writer.point_light({0.0, 1.0, 0.0}, glm::dvec3(1.0), intensity);
  writer.camera("above", {0.0, 2.0, 0.5}, {0.0, 0.0, 0.0}, 0.8, 2.0);
  return writer;
}

}  // namespace ppm::test
