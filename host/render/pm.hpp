// Classic photon mapping [Jensen, as HOJ08 section 3 has it]: one map of photons, and at each hit
// point the radiance of the n nearest of them, Eq. 1.
//
// L = sum of f_r * flux / (pi r^2) over the photons no further than r, the distance of the n-th
// nearest, that one included. In even light n / (pi r^2) exceeds the density of photons by a factor
// of n / (n - 1) in the mean: that is Eq. 1 as it stands, 0.2 % for n = 500. Whoever has fewer than
// n photons within the largest radius gets those, over that radius.
#pragma once

#include <future>
#include <optional>
#include <vector>

#include "estimator.hpp"
#include "eye_tiles.hpp"
#include "hit_tiles.hpp"
#include "integrator.hpp"
#include "layers.hpp"
#include "nearest_photons.hpp"
#include "pass_capacities.hpp"
#include "path_chunks.hpp"
#include "photon_map.hpp"
#include "photon_tracer.hpp"
#include "scene_buffers.hpp"
#include "tally.hpp"

namespace ppm::render {

class PhotonMapIntegrator final : public Integrator, public LayerSource {
 public:
  PhotonMapIntegrator(const Settings& settings, const scene::Scene& scene, gpu::Device& device,
                      Log& log, unsigned threads);

  bool prepare(const std::function<bool()>& interrupted) override;
  /// Puts one portion of paths into the map; of the last one as many as fit.
  bool advance(const std::function<bool()>& interrupted) override;
  bool complete() const override { return complete_; }
  void look_from(const scene::Camera& camera) override;
  /// The estimate from the photons so far.
  Picture resolve() override;
  SavedState save_state() override;
  void restore_state(const SavedState& state) override;
  const Statistics& statistics() override;
  std::vector<image::Layer> layers(std::span<const LayerKind> kinds) override;

 private:
  /// The photons of these paths, if they fit; otherwise, and when interrupted, the map is as
  /// before.
  enum class Added { all, none, interrupted };
  Added add_photons(std::uint32_t pass, std::uint32_t first, std::uint32_t paths,
                    const std::function<bool()>& interrupted, Tally& tally);
  /// Memory for estimates and, where tiles stay, their search order.
  void prepare_searches();
  void order_searches(HitTile& tile);
  void estimate();
  /// What all hit points shall search for, and cell_ for that; at first by a search of some.
  NearestPhotons::Request next_request();
  void learn_cell();  ///< from the last search
  void record_radii(std::vector<float> radii2);
  std::uint64_t fingerprint() const;

  Settings settings_;
  const scene::Scene& scene_;
  gpu::Device& device_;
  EarlyEyeKernels eye_kernels_;
  SceneBuffers buffers_;
  SceneTraits traits_;
  gpu::BindingTable table_;
  PassCapacities capacities_;
  PhotonTracer tracer_;
  gpu::BindingTable photons_;  // the tracer's
  PathChunks chunks_;
  PhotonMap map_;
  Estimator estimator_;
  HitTiles tiles_;
  std::optional<NearestPhotons> nearest_;  // once there are tiles
  float largest_radius_;                   // working units
  float cell_ = 0.0f;                      // of the map, idem
  bool complete_ = false;
  std::uint64_t estimated_ = 0;   // photons of which the hit points' statistics tell; 0: none yet
  Estimator::Rejected rejected_;  // by the last estimate
  Statistics statistics_;
};

}  // namespace ppm::render
