// Several photon passes recorded at a time: the device goes from one to the next without the host.
//
// Paths of all passes are traced together, their photons sorted together, each pass into a table of
// its own; then each pass is searched and ends with its update, one after the other. So every hit
// point sees what it would see in passes made one by one, to the byte. Whatever does not go as
// usual is noticed on the device (batch_check.comp), which then lets the rest be, and told here.
#pragma once

#include <functional>
#include <span>

#include "estimator.hpp"
#include "photon_grid.hpp"
#include "photon_tracer.hpp"

namespace ppm::render {

class PassBatch {
 public:
  /// All must outlive it.
  PassBatch(gpu::Device& device, PhotonTracer& tracer, PhotonGrid& grid, Estimator& estimator);

  struct Request {
    std::uint32_t first_pass, passes;  ///< at most PPM_BATCH_LIMIT
    std::uint32_t paths;               ///< of each pass
    float alpha;
    float cell;  ///< of the grid, working units
  };
  enum class End {
    complete,
    interrupted,
    photons_overflow,  ///< those of one pass do not fit its share: none was made
    long_searches,     ///< some searches met more photons than the recorded dispatches look at
  };
  struct Result {
    End end = End::complete;
    std::uint32_t passes = 0;  ///< that were made, updates and all; the others left no trace
    std::uint64_t photons_stored = 0, clamped = 0, overflow = 0;  ///< of those
  };
  Result make(std::span<const HitTile> tiles, const Request& request,
              const std::function<bool()>& interrupted);

  /// Passes that are likely to fit, at most `most`, at least one.
  std::uint32_t fitting(std::uint64_t most, std::uint64_t paths, float cell) const;

 private:
  void record_sort(gpu::Recorder& recorder, const Request& request);
  bool record_passes(gpu::Recorder& recorder, std::span<const HitTile> tiles,
                     const Request& request, const std::function<bool()>& interrupted);
  void record_check(gpu::Recorder& recorder, const Request& request, std::uint32_t step,
                    std::uint32_t pass) const;

  gpu::Device& device_;
  PhotonTracer& tracer_;
  PhotonGrid& grid_;
  Estimator& estimator_;
  gpu::Kernel check_;
  gpu::BindingTable photons_, check_table_;
};

}  // namespace ppm::render
