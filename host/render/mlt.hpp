// Metropolis light transport in primary sample space [Kelemen et al. 2002], over bidirectional
// samples.
#pragma once

#include <vector>

#include "bidirectional_sampler.hpp"
#include "film.hpp"
#include "integrator.hpp"
#include "layers.hpp"
#include "scene_buffers.hpp"

namespace ppm::render {

/// A pass is as many mutations as the picture has pixels, shared by all chains.
class MltIntegrator final : public Integrator, public LayerSource {
 public:
  MltIntegrator(const Settings& settings, const scene::Scene& scene, gpu::Device& device, Log& log,
                unsigned threads);

  bool prepare(const std::function<bool()>& interrupted) override;
  bool advance(const std::function<bool()>& interrupted) override;
  void look_from(const scene::Camera& camera) override;
  Picture resolve() override;
  SavedState save_state() override;
  void restore_state(const SavedState& state) override;
  const Statistics& statistics() override;
  std::vector<image::Layer> layers(std::span<const LayerKind> kinds) override;

  /// Mean luminance of a sample, as known so far.
  double normalisation() const { return normalisation_; }

 private:
  /// Samples `paths` of a phase in tiles that fit, and decides about each. False: interrupted.
  bool run(std::uint32_t step, std::uint32_t phase, std::uint32_t paths,
           const std::function<bool()>& interrupted);
  bool choose_starts(const std::function<bool()>& interrupted);
  void refine_normalisation();
  std::uint64_t fingerprint() const;

  /// All that a pass changes.
  struct Snapshot {
    std::vector<std::uint32_t> words, chains, splats;
    std::uint64_t steps;
    unsigned pool;
    Statistics statistics;
  };
  Snapshot snapshot() const;
  void go_back(const Snapshot& snapshot);

  Settings settings_;
  const scene::Scene& scene_;
  gpu::Device& device_;
  SceneBuffers buffers_;
  SceneTraits traits_;
  std::uint32_t chains_, bootstrap_;
  Film film_, proposals_;  ///< the picture; what the proposals bring to their pixels
  gpu::Buffer words_, starts_, luminances_, states_;
  gpu::BindingTable sampling_, deciding_;
  BidirectionalSampler sampler_;
  gpu::Kernel step_;
  gpu::Buffer splats_[2], splat_count_;
  std::uint32_t splat_capacity_, tile_paths_;
  unsigned pool_ = 0;  ///< of splats_, which holds those of the chains' states
  std::uint64_t steps_ = 0;
  double bootstrap_sum_ = 0.0, normalisation_ = 0.0;
  Statistics statistics_;
};

}  // namespace ppm::render
