// EXT_lights_image_based to the scene's environment.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gltf_document.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// An image-based light whose faces are not decoded yet.
struct EnvironmentSource {
  float intensity = 1.0f;
  glm::dmat3 to_world{1.0};                     ///< rotation
  std::vector<Element<tinygltf::Image>> faces;  ///< six, of its first mip
  std::uint32_t face_size = 0;                  ///< texels a side

  /// Of the map that they become, twice as wide as high.
  std::uint32_t map_height() const { return 2 * face_size; }
  std::uint64_t texels() const { return std::uint64_t{2} * map_height() * map_height(); }
};

/// The image-based light of the scene that `wanted` names (see find_scene), if it has one that
/// shines. Throws Failure for what is malformed.
std::optional<EnvironmentSource> find_environment(Document& document, const std::string& wanted);

/// Its faces as a map over longitude and latitude, twice as wide as high. PNG files hold RGBD, JPEG
/// files plain colours. Throws Failure where they cannot be decoded.
Environment read_environment(const EnvironmentSource& source);

}  // namespace ppm::scene::gltf
