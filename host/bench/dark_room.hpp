// The room in the dark.
#pragma once

#include <cstddef>

#include "room.hpp"

namespace ppm::bench {

/// The room without its lamp, and in it a lantern: a closed, tapering shaft that starts close to
/// the camera, is lit inside and lets light out only at the camera's end, onto a black panel behind
/// the camera. Photons bounce in the lantern as they would in a room, but the camera sees the
/// lantern's inside in a twentieth of its picture alone: no photon ever lands on the rest.
scene::Scene make_dark_room(std::size_t triangles = kRoomTriangles);

}  // namespace ppm::bench
