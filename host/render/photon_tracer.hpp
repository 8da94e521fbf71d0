// The photon tracing pass: paths from the lights, photons where they land.
#pragma once

#include <functional>
#include <optional>

#include "counters.hpp"
#include "device_batch.hpp"
#include "kernel.hpp"
#include "scene_traits.hpp"
#include "tracing_rounds.hpp"

namespace ppm::render {

/// Paths that are traced together: [first_path, first_path + paths) of each of the passes.
struct PathRange {
  std::uint32_t stream;              ///< PPM_STREAM_*
  std::uint32_t first_pass, passes;  ///< numbers of the passes; at most PPM_BATCH_LIMIT of them
  std::uint32_t first_path, paths;   ///< paths * passes: at most PhotonTracer::path_capacity
};

/// Kernel and queues of the photon pass, and the photons of the batch in hand.
class PhotonTracer {
 public:
  /// Holds up to `photon_capacity` photons and traces up to `path_capacity` paths at a time.
  PhotonTracer(gpu::Device& device, const gpu::BindingTable& scene, const SceneTraits& traits,
               std::uint64_t photon_capacity, std::uint64_t path_capacity);

  enum class Result { done, overflow, interrupted };

  /// Records rounds of bounces, as many as end the paths by experience. When the submission has
  /// ended `finish` must be called.
  void record(gpu::Recorder& recorder, const PathRange& range);
  /// Traces what is alive after the rounds that were recorded. done: all photons are stored.
  /// overflow: those of a pass do not fit its share; what is stored means nothing and fewer passes
  /// or paths must be tried.
  Result finish(const std::function<bool()>& interrupted);

  /// Both, for a range of paths of one pass, in submissions of its own.
  Result trace(std::uint32_t stream, std::uint32_t pass, std::uint32_t first_path,
               std::uint32_t paths, const std::function<bool()>& interrupted);

  /// Whether paths were alive or photons too many when the rounds recorded last had run.
  bool has_more() const { return batch_->alive[rounds_.count()] > 0; }
  bool overflowed() const;

  std::uint32_t photon_count() const { return batch_->photons[0]; }  ///< of a range of one pass
  /// Photons that each pass of `passes` may store: pass b's begin at b times this.
  std::uint32_t photon_share(std::uint32_t passes) const {
    return static_cast<std::uint32_t>(photon_capacity_ / passes);
  }
  /// Photons that one pass of `paths` paths is likely to store.
  std::uint64_t expected_photons(std::uint64_t paths) const;
  std::uint64_t path_capacity() const { return path_capacity_; }
  std::uint32_t rounds() const { return rounds_.count(); }  ///< that were recorded last
  const Counters& counters() const { return counters_; }    ///< of the last range
  DeviceBatch& batch() { return batch_; }
  const DeviceBatch& batch() const { return batch_; }
  void bind_photons(gpu::BindingTable& table) const;

 private:
  void record_rounds(gpu::Recorder& recorder);
  void learn();

  gpu::Device& device_;
  gpu::Kernel kernel_;
  gpu::BindingTable table_;
  std::uint64_t photon_capacity_, path_capacity_;
  gpu::Buffer queue_[2], position_, flux_;
  DeviceBatch batch_;
  Counters counters_;

  PathRange range_{};
  TracingRounds rounds_;
  double usual_photons_;  // a path, by experience
};

}  // namespace ppm::render
