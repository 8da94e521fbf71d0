// glTF 2.0 files (.gltf with .bin or data URIs, .glb) to a Scene.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "log.hpp"
#include "scene.hpp"
#include "scene_size.hpp"

namespace ppm::scene {

/// What of a file is read, and how.
struct LoadOptions {
  /// Name or index of the scene (`scenes`). Empty: the file's default one, the first if it names
  /// none, all root nodes if it has none.
  std::string scene{};
  /// Asked with all that is known of the scene's size whenever more of it is, before that is
  /// allocated; throws Failure where it is too much. `scene` is null until the size is complete,
  /// and then has at least its name, frame, bounds and cameras. May be empty.
  std::function<void(const SceneSize& size, const Scene* scene)> admit{};
  /// Lumen a watt: what punctual lights' candela and lux are divided by.
  double luminous_efficacy = 1.0;
  /// A map that replaces the file's own environment; empty: none.
  std::filesystem::path environment{};
  double environment_rotation = 0.0;  ///< about +Y, degrees, counter-clockwise seen from above
  double environment_strength = 1.0;  ///< multiplies the map
};

/// Reads a scene of the file, as `options` say.
///
/// What the renderer does not understand is warned of once per kind through `log`. Throws `Failure`
/// naming the file, the JSON path and the remedy when the file is missing, malformed, refers
/// outside itself, has non-finite numbers where they matter, requires an unknown extension, or has
/// no triangles. Never reads outside the file's buffers and never allocates in proportion to a
/// number the file merely claims.
Scene load_gltf(const std::filesystem::path& file, Log& log, const LoadOptions& options = {});

/// A camera that sees all triangles, for files without one: 45 degrees, from +Z slightly above.
Camera frame_camera(const Scene& scene);

}  // namespace ppm::scene
