// Saving and restoring a rendering between two passes.
#include <cstring>

#include "failure.hpp"
#include "fingerprint.hpp"
#include "ppm.hpp"

namespace ppm::render {
namespace {

// Everything else follows from scene and settings: geometry of hit points by tracing the eye paths
// again, photons by their numbers.
struct Header {
  std::uint64_t fingerprint;
  std::uint64_t passes, photons_emitted, photons_stored;
  std::uint64_t hit_points;
};

void append(SavedState& state, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  state.insert(state.end(), bytes, bytes + size);
}

[[noreturn]] void refuse(const char* why) {
  throw Failure("", "saved state", why, "resume with the scene and options it was saved with");
}

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

SavedState PpmIntegrator::save_state() {
  SavedState state;
  const Header header{fingerprint(), statistics_.passes, statistics_.photons_emitted,
                      statistics_.photons_stored, statistics_.hit_points};
  append(state, &header, sizeof header);
  for (const HitTile& tile : tiles_) {
    // In canonical order and without a mark between tiles: how the picture is cut into tiles may
    // differ when the rendering goes on.
    const auto statistics = tile.statistics.download<glm::vec4>(tile.hits);
    const auto counts = tile.photon_counts.download<std::uint32_t>(tile.hits);
    for (const std::uint32_t i : tile.order.download<std::uint32_t>(tile.hits)) {
      append(state, &statistics[i], sizeof statistics[i]);
      append(state, &counts[i], sizeof counts[i]);
    }
  }
  return state;
}

void PpmIntegrator::restore_state(const SavedState& state) {
  constexpr std::size_t kRecord = sizeof(glm::vec4) + sizeof(std::uint32_t);
  Header header;
  if (state.size() < sizeof header) refuse("truncated");
  std::memcpy(&header, state.data(), sizeof header);
  if (header.fingerprint != fingerprint()) refuse("of another scene or other options");
  if (state.size() != sizeof header + header.hit_points * kRecord) refuse("truncated");
  trace_eye_paths([] { return false; });
  if (statistics_.hit_points != header.hit_points) refuse("of another device or program");

  const std::uint8_t* next = state.data() + sizeof header;
  for (HitTile& tile : tiles_) {
    std::vector<glm::vec4> statistics(tile.hits);
    std::vector<std::uint32_t> counts(tile.hits);
    for (const std::uint32_t i : tile.order.download<std::uint32_t>(tile.hits)) {
      std::memcpy(&statistics[i], next, sizeof statistics[i]);
      std::memcpy(&counts[i], next + sizeof statistics[i], sizeof counts[i]);
      next += kRecord;
    }
    tile.statistics.upload(std::span<const glm::vec4>(statistics));
    tile.photon_counts.upload(std::span<const std::uint32_t>(counts));
  }
  estimator_.prepare_searches(tiles_);
  statistics_.passes = header.passes;
  statistics_.photons_emitted = header.photons_emitted;
  statistics_.photons_stored = header.photons_stored;
}

}  // namespace ppm::render
