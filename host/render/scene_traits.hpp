// What searches and kernels are told of a scene beforehand.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "kernel.hpp"
#include "scene.hpp"

namespace ppm::render {

struct SceneTraits {
  glm::vec3 bounds_min{-1.0f}, bounds_max{1.0f};  ///< of all triangles, working frame
  // Whether some material may have ...
  bool rough_gloss = true;  ///< a rough glossy lobe
  bool textures = true;     ///< a texture
  bool details = false;     ///< a need of Scene::details
  bool coverage = false;    ///< an alphaMode other than OPAQUE
  bool layers = false;      ///< a rough glass or a clear coat
  bool dispersion = false;
  bool media = true;  ///< an inside
  bool environment = false;
  bool textured_lights = true;  ///< an emission that differs from point to point

  /// How the scene's buffers are cut: their numbers of segments by binding, where there are
  /// several, and the texels of a segment as a power of two.
  std::map<std::uint32_t, std::uint32_t> segments{};
  std::uint32_t segment_shift = 23;

  /// The same as constants of the kernels (shaders/lib/scene_kinds.glsl).
  using Constants = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  Constants specialisation(Constants own = {}) const;  ///< added to the kernel's own

  /// Needs nothing but kernels compiled for plain scenes (there as well).
  bool is_plain() const;
};

/// A kernel for such a scene, out of the two that the build makes of its text. `own`: constants
/// that are not the scene's.
gpu::Kernel make_kernel(gpu::Device& device, const SceneTraits& traits, const gpu::Shader& any,
                        const gpu::Shader& plain, SceneTraits::Constants own = {});

SceneTraits traits_of(const scene::Scene& scene);

}  // namespace ppm::render
