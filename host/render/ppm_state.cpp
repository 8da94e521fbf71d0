// Saving and restoring a rendering between two passes.
#include "fingerprint.hpp"
#include "memory_shortage.hpp"
#include "ppm.hpp"
#include "saved_state.hpp"

namespace ppm::render {
namespace {

// Everything else follows from scene and settings: geometry of hit points by tracing the eye paths
// again, photons by their numbers.
struct PpmHeader {
  std::uint64_t fingerprint;
  std::uint64_t passes, photons_emitted, photons_stored;
  std::uint64_t hit_points;
};

}  // namespace

std::uint64_t PpmIntegrator::fingerprint() const {
  Hash hash;
  hash.add(settings_.width);
  hash.add(settings_.height);
  hash.add(settings_.photons_per_pass);
  hash.add(settings_.alpha);
  hash.add(static_cast<std::uint32_t>(settings_.radius_mode));
  hash.add(settings_.radius);
  hash.add(settings_.samples_per_pixel);
  hash.add(static_cast<std::uint32_t>(settings_.filter));
  hash.add(&buffers_.constants(),
           sizeof(shared::SceneConstants));  // camera, seed, depth, lights' power
  add_scene(hash, scene_);
  return hash.value();
}

void PpmIntegrator::measure_kept_radii() {
  estimator_.clear_radii();
  for (const KeptHit& hit : tiles_.kept()) estimator_.add_radius(hit.statistics[3]);
}

SavedState PpmIntegrator::save_state() {
  const PpmHeader header{fingerprint(), statistics_.passes, statistics_.photons_emitted,
                         statistics_.photons_stored, statistics_.hit_points};
  SavedState state = state_of(header);
  tiles_.save(state);
  return state;
}

void PpmIntegrator::restore_state(const SavedState& state) {
  const auto header = header_of<PpmHeader>(state, fingerprint());
  if (state.size() != sizeof header + header.hit_points * sizeof(KeptHit))
    refuse_state("truncated");
  trace_eye_paths([] { return false; });
  if (statistics_.hit_points != header.hit_points) refuse_state("of another device or program");
  const std::uint8_t* const hits = state.data() + sizeof header;
  try {
    tiles_.restore(hits);
    estimator_.prepare_searches(tiles_.all());
    for (const HitTile& tile : tiles_.all()) estimator_.reserve_pixels(tile.pixels);
  } catch (const gpu::MemoryShortage& shortage) {
    tiles_.trace_anew(shortage);
    tiles_.restore(hits);
  }
  if (tiles_.are_traced_anew()) measure_kept_radii();
  statistics_.passes = header.passes;
  statistics_.photons_emitted = header.photons_emitted;
  statistics_.photons_stored = header.photons_stored;
}

}  // namespace ppm::render
