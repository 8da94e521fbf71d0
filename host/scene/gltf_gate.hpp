// What a document must pass before tinygltf sees it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ppm::scene::gltf {

/// What was found out about a document that passed.
struct Survey {
  std::map<std::string, std::size_t> lengths;   ///< of the top-level arrays
  bool has_animations = false;                  ///< of which tinygltf learns nothing
  std::set<std::string> extensions;             ///< that are used anywhere or declared
  std::vector<std::uint64_t> external_lengths;  ///< of the buffers in files beside, in their order
  std::optional<std::string> mended_json;       ///< to be read instead, see gltf_mending.hpp
};

/// Checks the JSON of a .gltf or, where `is_binary`, a .glb file for what tinygltf would not
/// survive, misread or complain of without a place: JSON too deep or too large for its recursion
/// and copies, integers that it cuts to 32 bits, properties of a wrong type or missing, values that
/// glTF does not have. Throws Failure naming `file`.
Survey survey(std::string_view text, bool is_binary, const std::string& file);

}  // namespace ppm::scene::gltf
