// Layers of what hit points have gathered.
#pragma once

#include "hit_tiles.hpp"
#include "layers.hpp"
#include "scene.hpp"

namespace ppm::render {

/// Radius, photons and density, as far as `kinds` have them; others are left out. Means over the
/// hit points of a pixel, weighted as in the picture, 0 where there are none. `kept`: the share of
/// the photons found that N counts (alpha); with it N / (pi R^2) is the density of all that
/// arrived.
std::vector<image::Layer> hit_layers(HitTiles& tiles, const Settings& settings, double kept,
                                     const scene::Frame& frame, std::span<const LayerKind> kinds);

}  // namespace ppm::render
