// What glTF 2.0 says about values, beyond their types, as far as tinygltf would complain of it
// without a place.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ppm::scene::gltf {

/// Checks a document that passed check_schema: where buffers lie and what they claim together,
/// kinds of accessors and cameras, strides, the indices that tinygltf follows. `is_binary`: it
/// comes from a .glb. Throws Failure naming `file` and the place.
void check_rules(const nlohmann::json& root, bool is_binary, const std::string& file);

}  // namespace ppm::scene::gltf
