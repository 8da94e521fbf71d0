// What an image file is, and what it must be checked for before a library opens it.
#pragma once

#include <string>

#include "gltf_document.hpp"

namespace ppm::scene::gltf {

/// OpenImageIO's name of the format that the first bytes tell, or nothing for those not read.
const char* image_format_of(ByteView bytes);

/// What makes a file of this format a danger to its library, or nothing: work or memory out of
/// proportion to it, and ends that come too early.
std::string danger_in_image(ByteView bytes, const std::string& format);

}  // namespace ppm::scene::gltf
