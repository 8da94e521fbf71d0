// How much there is of a scene, known before any of it is allocated.
#pragma once

#include <cstdint>

#include "scene.hpp"

namespace ppm::scene {

/// What decides how much memory a scene takes. A loader knows it from headers and counts, and says
/// so before it allocates (LoadOptions::admit); `of` says it of a scene that is there.
struct SceneSize {
  std::uint64_t file_bytes = 0;     ///< of all files that are read
  std::uint64_t decoded_bytes = 0;  ///< that compressed or sparse data takes while it is read
  std::uint64_t triangles = 0;      ///< instances included
  bool details = false;             ///< whether Scene::details is needed
  std::uint64_t texture_bytes = 0;  ///< decoded

  static SceneSize of(const Scene& scene);
};

/// Frees what is large: triangles, details, texels. For scenes whose device records are made.
void release_arrays(Scene& scene);

/// As it is stored, on the host and on the device.
std::uint64_t bytes_of(const Texture& texture);

}  // namespace ppm::scene
