// The types of what glTF 2.0 says about a document, and what it requires.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ppm::scene::gltf {

/// Checks every property of glTF's own objects that the loader or tinygltf reads: its type, how
/// many numbers it has, the range of what are indices or sizes, and whether what is required is
/// there. Names, `extras` and extensions other than KHR_lights_punctual may be anything. Throws
/// Failure naming `file` and the property's place.
void check_schema(const nlohmann::json& root, const std::string& file);

}  // namespace ppm::scene::gltf
