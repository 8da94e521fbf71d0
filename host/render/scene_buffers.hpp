// A scene on the device: what the kernels' lib/scene.glsl, surface.glsl and lights.glsl read.
#pragma once

#include <vector>

#include "bvh.hpp"
#include "integrator.hpp"
#include "kernel.hpp"
#include "shared/layout.h"

namespace ppm::render {

/// Builds the BVH, uploads everything and binds it. Throws Failure when a limit of the device is
/// passed.
class SceneBuffers {
 public:
  SceneBuffers(const scene::Scene& scene, const Settings& settings, gpu::Device& device,
               unsigned threads);

  void bind(gpu::BindingTable& table) const;

  const shared::SceneConstants& constants() const { return constants_; }
  double total_power() const { return total_power_; }  ///< W * frame.scale^2, mean over channels
  std::uint32_t light_count() const { return constants_.light_count; }
  double bvh_seconds() const { return bvh_seconds_; }

 private:
  shared::SceneConstants constants_{};
  double total_power_ = 0.0;
  double bvh_seconds_ = 0.0;
  gpu::Buffer constants_buffer_, nodes_, positions_, shading_, materials_, textures_, texels_,
      texture_uses_, details_, lights_;
};

}  // namespace ppm::render
