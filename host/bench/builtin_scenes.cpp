#include "builtin_scenes.hpp"

#include "dark_room.hpp"
#include "room.hpp"
#include "uneven_room.hpp"

namespace ppm::bench {

const std::vector<BuiltinScene>& builtin_scenes() {
  static const std::vector<BuiltinScene> kScenes = {
      {"room", "", "73k triangles, a lamp, a glass and a mirror ball", [] { return make_room(); }},
      {"big-700k", "big", "the same of 700k triangles", [] { return make_room(700000); }},
      {"big-1500k", "big", "the same of 1.5M triangles", [] { return make_room(1500000); }},
      {"dark", "", "the room with 95 % of the hit points unlit", [] { return make_dark_room(); }},
      {"uneven", "", "the room with radii spread over 1:100", [] { return make_uneven_room(); }},
  };
  return kScenes;
}

std::vector<BuiltinScene> find_builtin_scenes(std::string_view name) {
  std::vector<BuiltinScene> found;
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == name || (!name.empty() && scene.group == name)) found.push_back(scene);
  }
  return found;
}

std::string builtin_scene_names() {
  std::string text;
  std::string_view group;
  for (const BuiltinScene& scene : builtin_scenes()) {
    const bool closes = !group.empty() && scene.group != group;
    const bool opens = !scene.group.empty() && scene.group != group;
    text += closes ? ")" : "";
    text += text.empty() ? "" : ", ";
    if (opens) text += std::string(scene.group) + " (";
    text += scene.name;
    group = scene.group;
  }
  return text + (group.empty() ? "" : ")");
}

}  // namespace ppm::bench
