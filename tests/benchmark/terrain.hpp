// Hills made by formula, as large as asked for: a scene that rays leave.
#pragma once

#include <cstddef>

#include "scene.hpp"

namespace ppm::benchmark {

/// Hills without walls: one height field of about `triangles` triangles, unlit, seen from above.
scene::Scene make_terrain(std::size_t triangles);

}  // namespace ppm::benchmark
