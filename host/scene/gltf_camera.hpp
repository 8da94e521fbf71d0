// glTF cameras to the scene's.
#pragma once

#include "gltf_nodes.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// The perspective camera that hangs on a node, if one does; others are skipped with a warning.
/// The node's scale is ignored, as glTF asks.
std::optional<Camera> read_camera(const Placement& placement, const Frame& frame);

}  // namespace ppm::scene::gltf
