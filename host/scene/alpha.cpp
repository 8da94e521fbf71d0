#include "alpha.hpp"

#include <algorithm>
#include <glm/gtc/packing.hpp>

namespace ppm::scene {
namespace {

float least_alpha(const Texture& texture) {
  float least = 1.0f;
  for (const glm::u8vec4 texel : texture.rgba8) {
    least = std::min(least, static_cast<float>(texel.w) / 255.0f);
  }
  for (const glm::u16vec4 texel : texture.halves) {
    least = std::min(least, glm::unpackHalf1x16(texel.w));
  }
  return least;
}

}  // namespace

void settle_alpha_modes(Scene& scene) {
  const auto is_opaque = [](const Material& m) { return m.alpha_mode == AlphaMode::opaque; };
  if (std::ranges::all_of(scene.materials, is_opaque)) return;
  std::vector<float> least(scene.materials.size(), 1.0f);  // of the vertices
  for (const Triangle& triangle : scene.triangles) {
    for (const Corner& corner : triangle.corners) {
      least[triangle.material] = std::min(least[triangle.material], corner.color.w);
    }
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    Material& material = scene.materials[i];
    if (material.alpha_mode == AlphaMode::opaque) continue;
    float alpha = material.alpha * least[i];
    if (material.base_color_texture) {
      alpha *= least_alpha(scene.textures[material.base_color_texture->texture]);
    }
    const float enough = material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 1.0f;
    if (alpha >= enough) material.alpha_mode = AlphaMode::opaque;
  }
}

}  // namespace ppm::scene
