// A closed room made by formula, for measuring, as large as asked for.
#pragma once

#include <cstddef>

#include "scene.hpp"

namespace ppm::bench {

/// Triangles of the rooms that figures are given for.
inline constexpr std::size_t kRoomTriangles = 73000, kLargeRoomTriangles = 203000;

/// Half the room's edges, about the origin.
inline constexpr glm::vec3 kRoom{0.9f, 0.7f, 0.98f};

/// Coloured diffuse walls, a glass ball and a mirror ball of smooth normals, a ring and a heap of
/// boxes, and a camera inside that sees all of them; without light. `triangles` is met within 2 %;
/// surfaces are the same whatever their number, save for tessellation. At least 5000.
scene::Scene make_unlit_room(std::size_t triangles);

/// The same with a lamp below the ceiling.
scene::Scene make_room(std::size_t triangles = kRoomTriangles);

}  // namespace ppm::bench
