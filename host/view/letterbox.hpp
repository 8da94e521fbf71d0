// A picture in a frame of another size: as large as it fits, in the middle.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "glm/glm.hpp"
#include "image.hpp"
#include "integrator.hpp"

namespace ppm::view {

/// Pixels of the frame, from its top left.
struct Box {
  glm::uvec2 corner{0}, size{0};
};

/// Where the picture goes, its shape kept. Neither side of either is 0.
Box letterbox(glm::uvec2 picture, glm::uvec2 frame);

/// The picture's pixel, from its top left, at a point of the frame; nothing beside the picture.
std::optional<glm::uvec2> pixel_at(glm::dvec2 point, const Box& box, glm::uvec2 picture);

/// What the frame shows, 3 bytes a pixel, row by row from the bottom as OpenGL has it: the picture
/// as a PNG would hold it, on dark grey. Shrunk by means of radiance, enlarged by repetition.
std::vector<std::uint8_t> framed(const render::Picture& picture, glm::uvec2 frame,
                                 const image::Encoding& encoding);

}  // namespace ppm::view
