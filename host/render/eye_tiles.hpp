// The hit points of the whole picture, tile by tile: for methods whose eye paths end in them.
#pragma once

#include <functional>
#include <future>
#include <optional>

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

/// Makes the tiles of all pixels one after the other, any number of times.
class EyeTiles {
 public:
  /// What is done when the device has no memory for a tile.
  enum class Shortage { throws, makes_tiles_smaller };
  /// `scene`: the table of scene buffers. The kernels must outlive it.
  EyeTiles(gpu::Device& device, const EyeKernels& kernels, const gpu::BindingTable& scene,
           const Settings& settings, Shortage shortage);

  /// Gives each tile to `use`, with the pass that made it. The tile's buffers are those of the one
  /// before as far as they suffice, unless `use` takes them away. Returns false as soon as
  /// `interrupted` says yes or `use` returns false. Where tiles are made smaller `use` may be
  /// called again for the pixels that it met a MemoryShortage with.
  bool for_each(const std::function<bool()>& interrupted,
                const std::function<bool(HitTile&, EyePass&)>& use);

 private:
  bool make(std::uint32_t first_pixel, const std::function<bool()>& interrupted);
  /// False: they are as small as they can be.
  bool shrink();

  gpu::Device& device_;
  const EyeKernels& kernels_;
  gpu::BindingTable scene_;
  Settings settings_;
  Shortage shortage_;
  std::optional<EyePass> eye_;
  HitTile tile_;
};

}  // namespace ppm::render
