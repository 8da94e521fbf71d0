// glTF cameras to the scene's.
#pragma once

#include "gltf_nodes.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// The camera that hangs on a node, if one does. The node's scale is ignored, as glTF asks. Throws
/// Failure for views that no picture can show.
std::optional<Camera> read_camera(const Placement& placement, const Frame& frame);

}  // namespace ppm::scene::gltf
