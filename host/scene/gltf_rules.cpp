#include "gltf_rules.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>

#include "failure.hpp"

namespace ppm::scene::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMostBufferBytes = std::uint64_t{1} << 32;

using Items = std::span<const json>;

/// The items of a top-level array, of which the schema holds already.
Items items_of(const json& root, const char* array) {
  const auto found = root.find(array);
  return found == root.end() ? Items() : Items(found->get_ref<const json::array_t&>());
}

std::string place_of(const char* array, std::size_t position, const char* member) {
  return std::string(array) + "[" + std::to_string(position) + "]" + member;
}

/// tinygltf gives every buffer its bytes, however many buffers share a chunk or a file.
void check_buffers(const json& root, bool is_binary, const std::string& file) {
  std::uint64_t sum = 0;
  const Items buffers = items_of(root, "buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const auto bytes = buffers[i]["byteLength"].get<std::uint64_t>();
    if (bytes == 0) {
      throw Failure(file, place_of("buffers", i, ".byteLength"), "is 0", "remove the buffer");
    }
    if (bytes > kMostBufferBytes - sum) {
      throw Failure(file, "buffers", "claim more than 4 GiB", "use a smaller scene");
    }
    sum += bytes;
    // Of data that is compressed: it has no bytes of its own.
    const json::json_pointer fallback("/extensions/EXT_meshopt_compression/fallback");
    const bool is_fallback = buffers[i].contains(fallback) && buffers[i][fallback] == true;
    if (!buffers[i].contains("uri") && !is_fallback && !(is_binary && i == 0)) {
      throw Failure(file, place_of("buffers", i, ".uri"), "is missing",
                    "name the file with the data; only the first buffer of a .glb lies in it");
    }
  }
}

/// The index that stands at `place`, into the top-level array `array`.
void check_index(const json& root, const json& index, const char* array, const std::string& place,
                 const std::string& file) {
  const std::size_t count = items_of(root, array).size();
  if (index.get<std::size_t>() < count) return;
  throw Failure(file, place,
                "refers to " + place_of(array, index.get<std::size_t>(), "") +
                    ", but the file has " + std::to_string(count) + " of them",
                "use an index below that");
}

void check_views(const json& root, const std::string& file) {
  const Items views = items_of(root, "bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    check_index(root, views[i]["buffer"], "buffers", place_of("bufferViews", i, ".buffer"), file);
    const auto stride = views[i].find("byteStride");
    if (stride == views[i].end()) continue;
    const int bytes = stride->get<int>();
    if (bytes % 4 != 0 || bytes > 252) {  // less than 4 is found where the element's size is known
      throw Failure(file, place_of("bufferViews", i, ".byteStride"), "is no stride of glTF 2.0",
                    "use a multiple of 4 in [4, 252]");
    }
  }
}

void check_accessors(const json& root, const std::string& file) {
  constexpr std::array kTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
  constexpr std::array kComponentTypes{5120, 5121, 5122, 5123, 5125, 5126};
  const Items accessors = items_of(root, "accessors");
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    const auto& type = accessors[i]["type"].get_ref<const std::string&>();
    if (std::ranges::find(kTypes, type) == kTypes.end()) {
      throw Failure(file, place_of("accessors", i, ".type"), "is not a type of glTF 2.0",
                    "use SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
    }
    if (std::ranges::find(kComponentTypes, accessors[i]["componentType"].get<int>()) ==
        kComponentTypes.end()) {
      throw Failure(file, place_of("accessors", i, ".componentType"),
                    "is not a component type of glTF 2.0", "use 5120 to 5126 but 5124");
    }
  }
}

void check_images(const json& root, const std::string& file) {
  const Items images = items_of(root, "images");
  for (std::size_t i = 0; i < images.size(); ++i) {
    const bool has_uri = images[i].contains("uri");
    if (has_uri == images[i].contains("bufferView")) {
      throw Failure(
          file, place_of("images", i, ""),
          has_uri ? "has both a uri and a bufferView" : "has neither a uri nor a bufferView",
          "give it one of them");
    }
    if (has_uri) continue;
    check_index(root, images[i]["bufferView"], "bufferViews", place_of("images", i, ".bufferView"),
                file);
  }
}

/// tinygltf looks into the accessors of indices.
void check_indices(const json& root, const std::string& file) {
  const Items accessors = items_of(root, "accessors"), meshes = items_of(root, "meshes");
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const json& primitives = meshes[i]["primitives"];
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const auto index = primitives[k].find("indices");
      if (index == primitives[k].end()) continue;
      const std::string place =
          place_of("meshes", i, ".primitives") + "[" + std::to_string(k) + "].indices";
      check_index(root, *index, "accessors", place, file);
      const auto accessor = index->get<std::size_t>();
      const bool has_data =
          accessors[accessor].contains("bufferView") || primitives[k].contains("extensions");
      if (has_data) continue;
      throw Failure(file, place_of("accessors", accessor, ".bufferView"), "is missing",
                    "indices must be there: add it");
    }
  }
}

void check_cameras(const json& root, const std::string& file) {
  const Items cameras = items_of(root, "cameras");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto& type = cameras[i]["type"].get_ref<const std::string&>();
    if (type != "perspective" && type != "orthographic") {
      throw Failure(file, place_of("cameras", i, ".type"), "is not a kind of camera",
                    "use perspective or orthographic");
    }
    if (!cameras[i].contains(type)) {
      throw Failure(file, place_of("cameras", i, ("." + type).c_str()), "is missing",
                    "add it: glTF 2.0 requires it");
    }
  }
}

void check_lights(const json& root, const std::string& file) {
  const json::json_pointer list("/extensions/KHR_lights_punctual/lights");
  if (!root.contains(list)) return;
  for (std::size_t i = 0; i < root[list].size(); ++i) {
    const json& light = root[list][i];
    const std::string place = place_of("extensions.KHR_lights_punctual.lights", i, "");
    if (light["type"] == "spot" && !light.contains("spot")) {
      throw Failure(file, place + ".spot", "is missing", "add it, or make it a point light");
    }
  }
}

}  // namespace

void check_rules(const json& root, bool is_binary, const std::string& file) {
  check_buffers(root, is_binary, file);
  check_views(root, file);
  check_accessors(root, file);
  check_images(root, file);
  check_indices(root, file);
  check_cameras(root, file);
  check_lights(root, file);
}

}  // namespace ppm::scene::gltf
