#include "scene_size.hpp"

namespace ppm::scene {

void release_arrays(Scene& scene) {
  scene.triangles = {};
  scene.details = {};
  for (Texture& texture : scene.textures) {
    texture.rgba8 = {};
    texture.halves = {};
  }
}

std::uint64_t bytes_of(const Texture& texture) {
  return texture.rgba8.size() * sizeof texture.rgba8[0] +
         texture.halves.size() * sizeof texture.halves[0];
}

SceneSize SceneSize::of(const Scene& scene) {
  SceneSize size;
  size.file_bytes = scene.findings.file_bytes;
  size.triangles = scene.triangles.size();
  size.details = !scene.details.empty();
  for (const Texture& texture : scene.textures) size.texture_bytes += bytes_of(texture);
  return size;
}

}  // namespace ppm::scene
