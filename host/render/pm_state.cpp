// Saving and restoring a photon map between two passes.
//
// Photons follow from their numbers: a map of millions is traced again in seconds, and as bytes
// would be what a checkpoint takes longest to write. What they add up to tells whether they are the
// same.
#include "fingerprint.hpp"
#include "pm.hpp"
#include "saved_state.hpp"

namespace ppm::render {
namespace {

struct PhotonMapHeader {
  std::uint64_t fingerprint;
  std::uint64_t passes, photons_emitted, map_photons;
};

}  // namespace

std::uint64_t PhotonMapIntegrator::fingerprint() const {
  Hash hash;
  hash.add(settings_.integrator.data(), settings_.integrator.size());
  hash.add(settings_.photons_per_pass);
  hash.add(settings_.map_photons);
  hash.add(settings_.nearest);
  hash.add(static_cast<std::uint32_t>(settings_.radius_mode));
  hash.add(settings_.radius);
  hash.add(settings_.samples_per_pixel);
  hash.add(static_cast<std::uint32_t>(settings_.filter));
  hash.add(&buffers_.constants(), sizeof(shared::SceneConstants));
  add_scene(hash, scene_);
  return hash.value();
}

SavedState PhotonMapIntegrator::save_state() {
  const PhotonMapHeader header{fingerprint(), statistics_.passes, statistics_.photons_emitted,
                               map_.photons()};
  return state_of(header);
}

void PhotonMapIntegrator::restore_state(const SavedState& state) {
  const auto header = header_of<PhotonMapHeader>(state, fingerprint());
  if (state.size() != sizeof header) refuse_state("truncated");
  const auto never = [] { return false; };
  prepare(never);
  while (statistics_.passes < header.passes && !complete_) advance(never);
  if (statistics_.passes != header.passes ||
      statistics_.photons_emitted != header.photons_emitted ||
      map_.photons() != header.map_photons) {
    refuse_state("of another device or program");
  }
  statistics_.pass_seconds.clear();  // those of this program's own
}

}  // namespace ppm::render
