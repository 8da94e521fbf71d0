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
  const Findings& findings = scene.findings;
  size.file_bytes = findings.file_bytes;
  size.decoded_bytes = findings.decoded_bytes;
  size.decoder_bytes = findings.decoder_bytes;
  size.triangles =
      scene.triangles.size() + findings.triangles_without_area + findings.triangles_too_small;
  size.details = !scene.details.empty();
  for (const Texture& texture : scene.textures) size.texture_bytes += bytes_of(texture);
  if (scene.environment) size.environment_texels = scene.environment->texels.size();
  size.materials = scene.materials.size();
  size.lights = scene.punctual_lights.size();
  for (const Triangle& triangle : scene.triangles) {
    size.lights += scene.materials[triangle.material].emission != glm::vec3(0.0f) ? 1 : 0;
  }
  return size;
}

}  // namespace ppm::scene
