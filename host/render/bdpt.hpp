// Bidirectional path tracing [Veach97 chapter 10], and light tracing by the same samples.
#pragma once

#include "bidirectional_sampler.hpp"
#include "film.hpp"
#include "integrator.hpp"
#include "layers.hpp"
#include "scene_buffers.hpp"

namespace ppm::render {

/// A pass is one sample of every pixel. "lt": only light that the lens sees on surfaces, and
/// emitters seen directly or through specular surfaces.
class BdptIntegrator final : public Integrator, public LayerSource {
 public:
  BdptIntegrator(const Settings& settings, const scene::Scene& scene, gpu::Device& device, Log& log,
                 unsigned threads);

  bool prepare(const std::function<bool()>& interrupted) override;
  bool advance(const std::function<bool()>& interrupted) override;
  std::uint64_t advance_up_to(std::uint64_t passes,
                              const std::function<bool()>& interrupted) override;
  void look_from(const scene::Camera& camera) override;
  Picture resolve() override;
  SavedState save_state() override;
  void restore_state(const SavedState& state) override;
  const Statistics& statistics() override;
  std::vector<image::Layer> layers(std::span<const LayerKind> kinds) override;

 private:
  void record(const Counters& counters);

  Settings settings_;
  const scene::Scene& scene_;
  gpu::Device& device_;
  SceneBuffers buffers_;
  SceneTraits traits_;
  Film film_;
  gpu::BindingTable table_;
  BidirectionalSampler sampler_;
  std::uint32_t tile_paths_;  ///< traced at a time, at most
  Statistics statistics_;
};

}  // namespace ppm::render
