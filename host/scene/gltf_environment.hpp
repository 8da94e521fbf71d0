// EXT_lights_image_based to the scene's environment.
#pragma once

#include <optional>
#include <string>

#include "gltf_document.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// The image-based light of the scene that `wanted` names (see find_scene), if it has one that
/// shines: the six faces of its first mip as a map over longitude and latitude. PNG files hold
/// RGBD, JPEG files plain colours. Throws Failure for what is malformed.
std::optional<Environment> read_environment(Document& document, const std::string& wanted);

}  // namespace ppm::scene::gltf
