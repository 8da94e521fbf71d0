// A closed room with one of everything, for tests that compare pictures with each other.
#pragma once

#include <string>

#include "render_harness.hpp"

namespace ppm::test {

/// Diffuse, rough and mirroring walls, a solid glass ball that attenuates, a mirror ball; an
/// emissive square, a spot and a point light; the camera inside. `scale` is half the room's edge:
/// everything grows with it, intensities by its square, so that radiance stays. A root node moves
/// it all, the camera too, by `offset`.
GltfWriter small_room(double scale = 1.0, glm::dvec3 offset = glm::dvec3(0.0));

/// For pictures of that room that take a fraction of a second: 24 x 18 pixels of 4 eye paths.
render::Settings room_settings(const scene::Scene& scene);

/// Whether all channels of all pixels are the same to the bit; tells how many are not.
::testing::AssertionResult same_bits(const render::Picture& a, const render::Picture& b);

}  // namespace ppm::test
