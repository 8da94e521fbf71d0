#include "media_table.hpp"

#include <cmath>
#include <string>

#include "failure.hpp"
#include "media.hpp"
#include "shared/media.h"

namespace ppm::render {
namespace {

/// 1 / working length, by channel.
glm::vec3 absorption_of(const scene::Material& material) {
  if (!std::isfinite(material.attenuation_distance)) return glm::vec3(0.0f);
  // Transmittance attenuation_color after attenuation_distance; a channel of 0 lets next to
  // nothing through.
  return -glm::log(glm::max(material.attenuation_color, glm::vec3(1e-30f))) /
         material.attenuation_distance;
}

}  // namespace

MediaTable make_media_table(const scene::Scene& scene) {
  const scene::MediaRanking ranking = scene::rank_media(scene.materials);
  if (ranking.example.size() > PPM_MOST_MEDIA) {
    throw Failure(scene.file, "materials",
                  std::to_string(ranking.example.size()) + " kinds of solids are more than " +
                      std::to_string(PPM_MOST_MEDIA),
                  "let more materials share ior, attenuation and priority");
  }
  MediaTable table;
  table.of_material = ranking.of_material;
  for (const std::uint32_t example : ranking.example) {
    const scene::Material& material = scene.materials[example];
    table.records.push_back(
        {absorption_of(material), scene::index_of(material), material.dispersion, 0, 0, 0});
  }
  return table;
}

}  // namespace ppm::render
