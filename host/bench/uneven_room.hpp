// The room with light here and there.
#pragma once

#include <cstddef>

#include "room.hpp"

namespace ppm::bench {

/// The room without its lamp, lit by four spots of equal power that are each three times as wide as
/// the one before; the two narrowest fall on dark cards close to the camera. Where they fall
/// photons lie up to 10^4 times as dense as where none does, so that the pilot's radii spread over
/// 1:100.
scene::Scene make_uneven_room(std::size_t triangles = kRoomTriangles);

}  // namespace ppm::bench
