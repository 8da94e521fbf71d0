// Saved states of methods whose state is a film and a number of passes.
#pragma once

#include "film.hpp"

namespace ppm::render {

struct FilmState {
  std::uint64_t fingerprint;  ///< of scene and settings
  std::uint64_t passes;
};

/// Of what the film's sums depend on: method, filter, picture, camera and scene, whose arrays must
/// not have been released.
std::uint64_t film_fingerprint(const Settings& settings, const shared::SceneConstants& constants,
                               const scene::Scene& scene);

SavedState save_film(const Film& film, const FilmState& header);

/// Returns the number of passes. Throws Failure where the state is cut short or of something else.
std::uint64_t restore_film(Film& film, const SavedState& state, std::uint64_t fingerprint);

}  // namespace ppm::render
