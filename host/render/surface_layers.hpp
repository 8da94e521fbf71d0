// Layers of what the eye sees first, from an eye pass of their own: the same for all methods.
#pragma once

#include "device.hpp"
#include "kernel.hpp"
#include "layers.hpp"
#include "scene.hpp"
#include "scene_traits.hpp"

namespace ppm::render {

/// Those of `kinds` that are about surfaces; others are left out. A path ends at the first surface
/// that has more than specular lobes (or none: black); both ways at glass count by what they carry.
/// Albedos add up, 0 where there is no surface; depth and position are weighted means, 0 where
/// there is none; normals are the direction of the mean, or zero. `scene`: the table of scene
/// buffers. The same bytes however the picture is tiled.
std::vector<image::Layer> surface_layers(gpu::Device& device, const gpu::BindingTable& scene,
                                         const SceneTraits& traits, const Settings& settings,
                                         const scene::Frame& frame,
                                         std::span<const LayerKind> kinds);

}  // namespace ppm::render
