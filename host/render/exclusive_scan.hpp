// Exclusive prefix sums on the device, by serial chunks.
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
  gpu::Kernel sums_, chunks_, offsets_;
  gpu::Buffer chunk_sums_;
};

}  // namespace ppm::render
