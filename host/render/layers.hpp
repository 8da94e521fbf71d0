// Layers beside the picture: what can be told of its pixels besides their radiance.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image.hpp"
#include "integrator.hpp"
#include "memory_plan.hpp"

namespace ppm::render {

enum class LayerKind {
  // Of the surface that an eye path finds first, seen through mirrors and smooth glass.
  albedo,            ///< what it reflects at normal incidence, as mirrors and glass tint it
  normal,            ///< shading normal; unit, world
  geometric_normal,  ///< unit, world
  depth,             ///< length of the path to it, world units
  position,          ///< world units
  // Of hit points, in methods that have them.
  radius,           ///< R, world units
  photons,          ///< N, of those found the share that is kept
  density,          ///< photons that arrived in all passes, by world area
  direct_emission,  ///< radiance of light seen directly or by way of mirrors and smooth glass
};

/// What the command line, files and EXR channels call a layer, and what it holds.
struct LayerFacts {
  LayerKind kind;
  std::string_view name;
  std::vector<std::string> channels;  ///< as pbrt-v4 names them, where it has them
  bool precise;                       ///< see image::Layer
  bool of_hit_points;                 ///< only methods with hit points have it
};

/// All, in the order of LayerKind.
const std::vector<LayerFacts>& all_layers();
const LayerFacts& facts_of(LayerKind kind);
std::optional<LayerKind> layer_named(std::string_view name);
/// Whether the method of this name has such a layer.
bool method_has_layer(std::string_view integrator, LayerKind kind);

/// An image::Layer of `kind` with room for so many pixels, all zero.
image::Layer empty_layer(LayerKind kind, std::uint64_t pixels);

/// Methods that can tell of more than the picture.
class LayerSource {
 public:
  virtual ~LayerSource() = default;
  /// Those of `kinds`, in any order, of the picture as of the passes so far. A kind that the method
  /// does not have is left out.
  virtual std::vector<image::Layer> layers(std::span<const LayerKind> kinds) = 0;
};

/// Layers of the integrator's picture; throws Failure where it has none such.
std::vector<image::Layer> layers_of(Integrator& integrator, std::span<const LayerKind> kinds);

/// What layers take beside all else (memory_plan.cpp).
std::vector<MemoryPart> layers_memory(const Settings& settings, const PassLimits& limits,
                                      std::span<const LayerKind> kinds);

/// Eye paths a pixel that layers are made of: those of the picture; in methods whose samples are
/// drawn pass by pass 16.
std::uint32_t layer_samples(const Settings& settings);

}  // namespace ppm::render
