#include "film_state.hpp"

#include <cstring>

#include "fingerprint.hpp"
#include "saved_state.hpp"

namespace ppm::render {

std::uint64_t film_fingerprint(const Settings& settings, const shared::SceneConstants& constants,
                               const scene::Scene& scene) {
  Hash hash;
  hash.add(settings.integrator.data(), settings.integrator.size());
  hash.add(static_cast<std::uint32_t>(settings.filter));
  hash.add(&constants, sizeof constants);
  add_scene(hash, scene);
  return hash.value();
}

SavedState save_film(const Film& film, const FilmState& header) {
  const std::vector<std::uint32_t> sums = film.save();
  SavedState state = state_of(header);
  state.resize(sizeof header + sums.size() * sizeof sums[0]);
  std::memcpy(state.data() + sizeof header, sums.data(), state.size() - sizeof header);
  return state;
}

std::uint64_t restore_film(Film& film, const SavedState& state, std::uint64_t fingerprint) {
  const auto header = header_of<FilmState>(state, fingerprint);
  std::vector<std::uint32_t> sums((state.size() - sizeof header) / sizeof(std::uint32_t));
  std::memcpy(sums.data(), state.data() + sizeof header, sums.size() * sizeof sums[0]);
  if (!film.restore(sums)) refuse_state("truncated");
  return header.passes;
}

}  // namespace ppm::render
