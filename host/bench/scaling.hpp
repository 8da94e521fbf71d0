// How the cost of passes grows with what is rendered.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measure.hpp"

namespace ppm::bench {

/// The room, and the room with ten times the triangles, 10/3 times the hit points, ten times the
/// photons, in the dark, and unevenly lit. `settings` are the room's; the others follow.
std::vector<Case> scaling_cases(
    const std::function<render::Settings(const scene::Scene&, Log&)>& settings);

/// A line for each of them: what grew, what was timed, its ratio to the room's (median over
/// repetitions, in each of which both were measured), least and most, and the goal. Ends with a
/// line break.
std::string scaling_table(const Results& results);

}  // namespace ppm::bench
