// The table of malformed documents: a sound one, bent in one place each.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ppm::test {

/// A fault in the JSON of everything(), and the line that must answer it: `FILE: place:
/// ...words...: remedy`.
struct Malformed {
  const char* name;
  std::function<void(nlohmann::json&)> fault;
  std::string place;  ///< as in `nodes[3].mesh`; empty for the file as a whole
  const char* words;  ///< of what is wrong there
};

/// The document and its arrays: types, what is required, versions, extensions, buffers.
std::vector<Malformed> malformed_structure();
/// Accessors, meshes, nodes, scenes.
std::vector<Malformed> malformed_geometry();
/// Materials, textures, images, lights, cameras.
std::vector<Malformed> malformed_appearance();

/// Puts `value` where the JSON pointer says.
inline std::function<void(nlohmann::json&)> set(const char* pointer, nlohmann::json value) {
  return [=](nlohmann::json& root) { root[nlohmann::json::json_pointer(pointer)] = value; };
}

/// Removes `key` from the object at the JSON pointer `parent`.
inline std::function<void(nlohmann::json&)> drop(const char* parent, const char* key) {
  return [=](nlohmann::json& root) { root[nlohmann::json::json_pointer(parent)].erase(key); };
}

}  // namespace ppm::test
