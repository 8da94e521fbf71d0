// Scenes made by formula, for measuring: a closed room and a terrain, as large as asked for.
#pragma once

#include <cstddef>

#include "scene.hpp"

namespace ppm::support {

/// Triangles of the rooms that figures are given for.
inline constexpr std::size_t kRoomTriangles = 73000, kLargeRoomTriangles = 203000;

/// A closed room with coloured diffuse walls, a lamp below the ceiling, a glass ball and a mirror
/// ball of smooth normals, a ring and a heap of boxes, and a camera inside that sees all of them.
/// `triangles` is met within 2 %; surfaces are the same whatever their number, save for
/// tessellation. At least 5000.
scene::Scene make_room(std::size_t triangles = kRoomTriangles);

/// Hills without walls: one height field of about `triangles` triangles, unlit, seen from above.
scene::Scene make_terrain(std::size_t triangles);

}  // namespace ppm::support
