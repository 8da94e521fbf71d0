// Bidirectional samples: light and camera sub-paths of a tile, and every way in which they meet.
#pragma once

#include <cstdint>
#include <functional>

#include "counters.hpp"
#include "integrator.hpp"
#include "kernel.hpp"
#include "scene_traits.hpp"
#include "shared/bidirectional.h"

namespace ppm::render {

/// Samples that are traced together.
struct SampleRange {
  std::uint32_t pass;               ///< number of the first pass, or of the chains' step
  std::uint32_t first_path, paths;  ///< of the passes, one after the other, or of the chains; at
                                    ///< most path_capacity of them
  std::uint32_t phase = 0;          ///< PPM_CHAINS_*
  std::uint32_t passes = 1;         ///< passes * pixels < 2^24 unless it is 1
};

/// What is held at a time: samples, and their vertices and pairs by experience.
struct SamplerCapacities {
  std::uint32_t paths, vertices, pairs;
  std::uint64_t bytes(bool splats) const;  ///< on the device
};
/// `storage_bytes`: the largest buffer; `chains`: as of BidirectionalSampler.
SamplerCapacities sampler_capacities(const Settings& settings, std::uint64_t storage_bytes,
                                     std::uint32_t chains);

/// Kernels, queues and vertices. What is sampled is a function of the range's numbers alone,
/// whatever the tiles.
class BidirectionalSampler {
 public:
  /// `scene`: the scene and the film, and for Markov chains their words and starts. `ways`:
  /// PPM_BDPT_*, in which paths may meet. `chains`: how many there are; 0: a sample of each pixel.
  BidirectionalSampler(gpu::Device& device, const gpu::BindingTable& scene,
                       const SceneTraits& traits, const Settings& settings, std::uint32_t ways,
                       std::uint32_t chains = 0);

  enum class Result { done, overflow, interrupted };

  /// Traces both sub-paths of each sample; nothing is added to the film. overflow: vertices or
  /// pairs do not fit, and fewer paths must be tried.
  Result trace(const SampleRange& range, const std::function<bool()>& interrupted);
  /// Adds to the film what the paths traced last bring.
  void deposit();

  std::uint32_t path_capacity() const { return capacities_.paths; }
  std::uint32_t vertex_capacity() const { return capacities_.vertices; }
  /// Of chains: what came through the lens, and from which vertices.
  void bind_splats(gpu::BindingTable& table) const;
  const Counters& counters() const { return counters_; }  ///< of the last range
  /// Once more, after other kernels have counted, too.
  void read_counters(gpu::Recorder& recorder) { counters_.read(recorder); }

 private:
  enum class Side { light, camera };
  Result trace_side(Side side, std::uint32_t paths, const std::function<bool()>& interrupted);
  bool overflowed() const;

  gpu::Device& device_;
  std::uint32_t ways_;
  gpu::Kernel light_, camera_, lens_, direct_, connect_;
  gpu::BindingTable table_;
  SamplerCapacities capacities_;
  gpu::Buffer queue_[2], light_vertices_, camera_vertices_, light_heads_, pairs_, splats_, unused_;
  Counters counters_;
  shared::BidirectionalPush push_{};
};

}  // namespace ppm::render
