// The photon tracing pass: paths from the lights, photons where they land.
#pragma once

#include <functional>
#include <optional>

#include "counters.hpp"
#include "kernel.hpp"

namespace ppm::render {

/// Kernel and queues of the photon pass, and the photons of the chunk in hand.
class PhotonTracer {
 public:
  /// Holds up to `photon_capacity` photons and traces up to `path_capacity` paths at a time.
  PhotonTracer(gpu::Device& device, const gpu::BindingTable& scene, std::uint64_t photon_capacity,
               std::uint64_t path_capacity);

  enum class Result { done, overflow, interrupted };

  /// Traces paths [first_path, first_path + paths) of the pass to their ends. done: all their
  /// photons are stored. overflow: they do not fit; what is stored means nothing and fewer paths
  /// must be tried.
  Result trace(std::uint32_t stream, std::uint32_t pass, std::uint32_t first_path,
               std::uint32_t paths, const std::function<bool()>& interrupted);

  std::uint32_t photon_count() const { return photon_count_; }
  std::uint64_t path_capacity() const { return path_capacity_; }
  const Counters& counters() const { return counters_; }  ///< of the last trace
  void bind_photons(gpu::BindingTable& table) const;

 private:
  gpu::Device& device_;
  gpu::Kernel kernel_;
  gpu::BindingTable table_;
  std::uint64_t photon_capacity_, path_capacity_;
  gpu::Buffer queue_[2], position_, flux_;
  Counters counters_;
  std::uint32_t photon_count_ = 0;
};

}  // namespace ppm::render
