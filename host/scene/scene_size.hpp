// How much there is of a scene, known before any of it is allocated.
#pragma once

#include <cstdint>

#include "scene.hpp"

namespace ppm::scene {

/// What decides how much memory a scene takes. A loader knows it from headers and counts, and says
/// so before it allocates (LoadOptions::admit); `of` says it of a scene that is there.
struct SceneSize {
  std::uint64_t file_bytes = 0;     ///< of all files that are read
  std::uint64_t decoded_bytes = 0;  ///< of compressed geometry, held while the file is read
  std::uint64_t decoder_bytes = 0;  ///< that its decoders take besides, one at a time
  std::uint64_t triangles = 0;      ///< instances included, and those that are left out
  bool details = false;             ///< whether Scene::details is needed
  std::uint64_t texture_bytes = 0;  ///< decoded
  std::uint64_t environment_texels = 0;
  std::uint64_t materials = 0;
  std::uint64_t lights = 0;  ///< triangles that emit and punctual lights

  bool operator==(const SceneSize&) const = default;

  static SceneSize of(const Scene& scene);
};

/// Frees what is large: triangles, details, texels. For scenes whose device records are made.
void release_arrays(Scene& scene);

/// As it is stored, on the host and on the device.
std::uint64_t bytes_of(const Texture& texture);

}  // namespace ppm::scene
