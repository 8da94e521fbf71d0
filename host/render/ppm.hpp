// Progressive photon mapping [HOJ08]: the loop over passes.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "estimator.hpp"
#include "eye_tiles.hpp"
#include "hit_tiles.hpp"
#include "integrator.hpp"
#include "layers.hpp"
#include "pass_batch.hpp"
#include "pass_capacities.hpp"
#include "path_chunks.hpp"
#include "photon_grid.hpp"
#include "photon_tracer.hpp"
#include "pilot.hpp"
#include "scene_buffers.hpp"
#include "tally.hpp"

namespace ppm::render {

class PpmIntegrator final : public Integrator, public LayerSource {
 public:
  PpmIntegrator(const Settings& settings, const scene::Scene& scene, gpu::Device& device, Log& log,
                unsigned threads);

  bool prepare(const std::function<bool()>& interrupted) override;
  bool advance(const std::function<bool()>& interrupted) override;
  std::uint64_t advance_up_to(std::uint64_t passes,
                              const std::function<bool()>& interrupted) override;
  void look_from(const scene::Camera& camera) override;
  Picture resolve() override;
  std::optional<ProbeReading> probe(std::uint32_t x, std::uint32_t y) override;
  SavedState save_state() override;
  void restore_state(const SavedState& state) override;
  const Statistics& statistics() override;
  std::vector<image::Layer> layers(std::span<const LayerKind> kinds) override;

 private:
  bool trace_eye_paths(const std::function<bool()>& interrupted);
  bool find_initial_radii(const std::function<bool()>& interrupted);
  /// Of these tiles. Returns false when interrupted.
  bool find_radii_of(std::span<const HitTile> tiles, const std::function<bool()>& interrupted);
  bool run_pilot(std::span<const HitTile> tiles, const std::function<bool()>& interrupted);
  /// A further round of the pilot among the photons that the grid holds, for so many hit points.
  std::uint64_t decide_again(Pilot& pilot, const Pilot::Round& round, std::uint64_t searches);
  /// Traces all paths of a pass in chunks that fit, and calls `use` with the photons of each in the
  /// grid, in cells of `cell` working units. Returns how many chunks it took; nothing when
  /// interrupted, by itself or by `use`.
  std::optional<std::uint32_t> for_each_chunk(std::uint32_t stream, std::uint32_t pass, float cell,
                                              const std::function<bool()>& interrupted,
                                              const std::function<bool()>& use);
  /// Passes to be recorded at a time; 0: the next one is made in steps.
  std::uint32_t batch_size(std::uint64_t passes, float cell) const;
  /// Passes made, at least one; nothing when interrupted.
  std::optional<std::uint32_t> advance_lit(std::uint64_t passes, float cell,
                                           const std::function<bool()>& interrupted);
  /// Passes made, 0 when it must be tried otherwise; nothing when interrupted before the first.
  std::optional<std::uint32_t> advance_batch(std::uint32_t passes, float cell,
                                             const std::function<bool()>& interrupted);
  /// One pass under the host's eyes, in chunks that fit and with searches of any length.
  bool advance_in_steps(float cell, const std::function<bool()>& interrupted);
  /// The same tile by tile, where they are traced anew; finished once the first one is.
  bool advance_tile_by_tile(float cell, const std::function<bool()>& interrupted);
  /// Their histogram from what is kept, where tiles are traced anew.
  void measure_kept_radii();
  /// From R^2 of all hit points, in the working frame.
  void record_initial_radii(std::vector<float> radii2);

  void record_passes(std::uint32_t passes, double seconds);
  std::uint64_t fingerprint() const;

  /// Where the statistics of a pixel's hit point are.
  struct Probe {
    std::size_t tile = 0;
    std::uint64_t slot = 0;  ///< of the tile; its place, where tiles are traced anew
  };
  std::optional<Probe> find_probe(std::uint32_t x, std::uint32_t y);

  Settings settings_;
  const scene::Scene& scene_;
  gpu::Device& device_;
  Log& log_;
  EarlyEyeKernels eye_kernels_;
  SceneBuffers buffers_;
  SceneTraits traits_;
  gpu::BindingTable table_;
  double pipelines_begin_;  // reading of the clock, between the members that are timed
  PassCapacities capacities_;
  PhotonTracer tracer_;
  gpu::BindingTable photons_;  // the tracer's photons, which the grid sorts
  PhotonGrid grid_;
  Estimator estimator_;
  PassBatch batch_;
  HitTiles tiles_;
  PathChunks chunks_;
  bool pilot_is_held_ = false;  // all its photons are the tracer's last
  std::uint32_t batch_limit_;   // passes recorded at a time, at most
  bool in_steps_ = false;       // the next pass: its searches are too long for a batch
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<Probe>> probes_;  // by x, y
  Statistics statistics_;
};

}  // namespace ppm::render
