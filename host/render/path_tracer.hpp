// Path tracing, the paper's reference: from the camera, with one light sampled at each surface
// ("pt"), and the same with multiple importance sampling ("pt-mis"). A pass is a sample of every
// pixel.
#pragma once

#include "counters.hpp"
#include "device_batch.hpp"
#include "film.hpp"
#include "integrator.hpp"
#include "layers.hpp"
#include "scene_buffers.hpp"
#include "tracing_rounds.hpp"

namespace ppm::render {

class PathTracer final : public Integrator, public LayerSource {
 public:
  PathTracer(const Settings& settings, const scene::Scene& scene, gpu::Device& device, Log& log,
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
  /// Traces paths [first, first + paths) of a batch that begins with the next pass.
  void trace(std::uint32_t first, std::uint32_t paths);
  void record_rounds(gpu::Recorder& recorder, std::uint32_t first, std::uint32_t paths);

  Settings settings_;
  const scene::Scene& scene_;
  gpu::Device& device_;
  SceneBuffers buffers_;
  SceneTraits traits_;
  gpu::BindingTable table_;
  double pipelines_begin_;  // reading of the clock, between the members that are timed
  gpu::Kernel kernel_;
  std::uint64_t path_capacity_;
  gpu::Buffer queue_[2];
  DeviceBatch batch_;
  Counters counters_;
  Film film_;
  Statistics statistics_;
  TracingRounds rounds_;
};

}  // namespace ppm::render
