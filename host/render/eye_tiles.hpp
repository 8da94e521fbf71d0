// The hit points of the whole picture, tile by tile: for methods whose eye paths end in them.
#pragma once

#include <functional>
#include <future>
#include <optional>
#include <vector>

#include "eye_pass.hpp"
#include "hit_tile.hpp"
#include "scene_buffers.hpp"

namespace ppm::render {

/// Kernels of the eye pass, begun while the tree is built; in scenes whose buffers must be known
/// first, made when they are needed.
class EarlyEyeKernels {
 public:
  EarlyEyeKernels(const scene::Scene& scene, const Settings& settings, gpu::Device& device);

  /// `traits`: with those of the buffers (SceneBuffers::traits_of).
  const EyeKernels& get(const SceneTraits& traits);

 private:
  gpu::Device& device_;
  std::future<EyeKernels> begun_;
  std::optional<EyeKernels> kernels_;
};

/// Throws Failure where there are more eye paths or photon paths a pass than can be numbered.
void check_paths(const Settings& settings);

/// Makes the tiles of all pixels one after the other and gives each to `use`, with the pass that
/// made it. `scene`: the table of scene buffers. Returns false when interrupted.
bool for_each_eye_tile(gpu::Device& device, const EyeKernels& kernels,
                       const gpu::BindingTable& scene, const Settings& settings,
                       const std::function<bool()>& interrupted,
                       const std::function<void(HitTile&, const EyePass&)>& use);

/// Appends the tiles of all pixels to `tiles`, and adds to the statistics what they took. `scene`:
/// the table of scene buffers. Returns false when interrupted.
bool trace_eye_tiles(gpu::Device& device, const EyeKernels& kernels, const gpu::BindingTable& scene,
                     const Settings& settings, const std::function<bool()>& interrupted,
                     std::vector<HitTile>& tiles, Statistics& statistics);

}  // namespace ppm::render
