// A scene on the device: what the kernels' lib/scene.glsl, surface.glsl and lights.glsl read.
#pragma once

#include <span>
#include <vector>

#include "bvh.hpp"
#include "integrator.hpp"
#include "kernel.hpp"
#include "scene_traits.hpp"
#include "shared/layout.h"

namespace ppm::render {

/// Whether some buffer of the scene may have several segments; where it cannot, kernels can be made
/// before the buffers are.
bool may_need_segments(const scene::Scene& scene, gpu::SegmentSize size);

/// Builds the BVH, uploads everything and binds it. Throws Failure when a limit of the device is
/// passed.
class SceneBuffers {
 public:
  SceneBuffers(const scene::Scene& scene, const Settings& settings, gpu::Device& device,
               unsigned threads);

  /// Puts the camera of `settings`, all else in which is as it was, in the place of the last one.
  /// `traits`: as traits_of had them.
  void look_from(const Settings& settings, const SceneTraits& traits, gpu::Device& device);

  void bind(gpu::BindingTable& table) const;
  gpu::BindingTable table() const {
    gpu::BindingTable table;
    bind(table);
    return table;
  }

  /// How the buffers are cut, for the kernels that read them.
  void add_segments(SceneTraits& traits) const;
  /// Those of the scene and of how its buffers are cut.
  SceneTraits traits_of(const scene::Scene& scene) const {
    SceneTraits traits = render::traits_of(scene);
    add_segments(traits);
    return traits;
  }

  const shared::SceneConstants& constants() const { return constants_; }
  double total_power() const { return total_power_; }  ///< W * frame.scale^2, mean over channels
  std::uint32_t light_count() const { return constants_.light_count; }
  double bvh_seconds() const { return bvh_seconds_; }
  double upload_seconds() const { return upload_seconds_; }

 private:
  void upload_triangles(const scene::Scene& scene, std::span<const std::uint32_t> order,
                        std::span<const float> light_probabilities, gpu::Device& device,
                        unsigned threads);
  void upload_textures(const scene::Scene& scene, gpu::Device& device);
  /// Fills `light_media_`. `traits`: the scene's, with or without those of its buffers.
  void find_start_media(gpu::Device& device, SceneTraits traits);

  gpu::SegmentSize segment_;
  shared::SceneConstants constants_{};
  double total_power_ = 0.0;
  double bvh_seconds_ = 0.0, upload_seconds_ = 0.0;
  gpu::Buffer constants_buffer_, materials_, textures_, texture_uses_, environment_, media_,
      light_media_;
  gpu::SegmentedBuffer nodes_, positions_, shading_, details_, texels_, lights_;
};

/// Throws Failure where nothing gives off light; of a scene, before anything is made of it.
void require_light(const scene::Scene& scene);

}  // namespace ppm::render
