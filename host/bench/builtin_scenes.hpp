// The scenes that need no file.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene.hpp"

namespace ppm::bench {

struct BuiltinScene {
  std::string_view name;
  std::string_view group;  ///< a name for several of them; empty: none
  std::string_view what;   ///< a few words
  scene::Scene (*make)();
};

/// All of them, in the order in which they are measured.
const std::vector<BuiltinScene>& builtin_scenes();

/// Those that `name` means, by name or group; none where it is neither.
std::vector<BuiltinScene> find_builtin_scenes(std::string_view name);

/// "room, big (big-700k, big-1500k), dark, uneven".
std::string builtin_scene_names();

}  // namespace ppm::bench
