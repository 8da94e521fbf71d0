// Exclusive prefix sums on the device, by serial chunks: of the entries, and where the device's
// profile finds their sums too many for one invocation, of those as well.
#pragma once

#include "kernel.hpp"

namespace ppm::render {

class ExclusiveScan {
 public:
  /// For arrays of up to `max_entries` counts.
  ExclusiveScan(gpu::Device& device, std::uint64_t max_entries);

  /// starts[i] = sum of counts[0 .. i), for i in [0, entries]; sums below 2^32. `counts` holds
  /// `entries` words, `starts` one more.
  void record(gpu::Recorder& recorder, const gpu::Buffer& counts, const gpu::Buffer& starts,
              std::uint32_t entries) const;

 private:
  // The kernels of these names, on any level.
  void record_sums(gpu::Recorder& recorder, const gpu::Buffer& counts, const gpu::Buffer& sums,
                   std::uint32_t entries) const;
  void record_serial(gpu::Recorder& recorder, const gpu::Buffer& sums, std::uint32_t chunks) const;
  void record_offsets(gpu::Recorder& recorder, const gpu::Buffer& counts, const gpu::Buffer& sums,
                      const gpu::Buffer& starts, std::uint32_t entries) const;

  std::uint32_t serial_chunks_;
  gpu::Kernel sums_, chunks_, offsets_;
  gpu::Buffer chunk_sums_;
  gpu::Buffer chunk_starts_, upper_sums_;  // where there may be more chunks than those
};

}  // namespace ppm::render
