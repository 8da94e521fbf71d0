// A pass's photon paths in chunks whose photons fit.
#pragma once

#include <functional>
#include <optional>

#include "photon_tracer.hpp"

namespace ppm::render {

class PathChunks {
 public:
  /// `tracer` must outlive it. paths: that a chunk has at most, to begin with.
  PathChunks(PhotonTracer& tracer, std::uint32_t paths) : tracer_(tracer), paths_(paths) {}

  /// Traces paths [first, first + paths) of a pass, and calls `use` when the tracer holds the
  /// photons of each chunk. Returns how many chunks it took; nothing when interrupted, by itself or
  /// by `use`.
  std::optional<std::uint32_t> trace(std::uint32_t stream, std::uint32_t pass, std::uint32_t first,
                                     std::uint32_t paths, const std::function<bool()>& interrupted,
                                     const std::function<bool()>& use);

  std::uint32_t paths() const { return paths_; }  ///< of a chunk, at most
  void halve() { paths_ = (paths_ + 1) / 2; }

 private:
  PhotonTracer& tracer_;
  std::uint32_t paths_;
};

}  // namespace ppm::render
