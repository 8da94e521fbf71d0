// JSON that is sound glTF, but that tinygltf 2.7.0 refuses, put into words that it takes.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ppm::scene::gltf {

/// `root` put so that tinygltf reads it, or nothing where it does so anyway. Mended are buffers
/// without uri that only stand in for compressed data (EXT_meshopt_compression), skins without
/// inverseBindMatrices, and indices that lie in a Draco stream alone: these become a member of the
/// extension. `is_binary`: in a .glb.
std::optional<std::string> mended(const nlohmann::json& root, bool is_binary);

/// A .glb with its JSON chunk replaced by `text`.
std::vector<unsigned char> with_json_chunk(const std::vector<unsigned char>& glb, std::string text);

}  // namespace ppm::scene::gltf
