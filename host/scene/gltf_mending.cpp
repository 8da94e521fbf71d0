#include "gltf_mending.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace ppm::scene::gltf {
namespace {

using nlohmann::json;

/// The objects in the array `name`, none where there is no such array.
template <typename Visitor>
void for_each_object(const json& root, const char* name, Visitor&& visit) {
  const auto array = root.find(name);
  if (array == root.end() || !array->is_array()) return;
  for (std::size_t i = 0; i < array->size(); ++i) {
    if ((*array)[i].is_object()) visit(i, (*array)[i]);
  }
}

/// The object at `key`, or nothing.
const json* object_in(const json& owner, const char* key) {
  const auto found = owner.find(key);
  return found != owner.end() && found->is_object() ? &*found : nullptr;
}

/// Whether the primitive's indices lie in a Draco stream alone.
bool has_packed_indices(const json& root, const json& primitive) {
  const json* const extensions = object_in(primitive, "extensions");
  if (!extensions || !object_in(*extensions, "KHR_draco_mesh_compression")) return false;
  const auto accessors = root.find("accessors");
  const auto index = primitive.find("indices");
  if (index == primitive.end() || !index->is_number_unsigned()) return false;
  if (accessors == root.end() || !accessors->is_array()) return false;
  const auto position = index->get<std::size_t>();
  return position < accessors->size() && (*accessors)[position].is_object() &&
         !(*accessors)[position].contains("bufferView");
}

bool is_fallback(const json& buffer) {
  const json* const extensions = object_in(buffer, "extensions");
  if (!extensions || buffer.contains("uri")) return false;
  const json* const extension = object_in(*extensions, "EXT_meshopt_compression");
  return extension && extension->value("fallback", json(false)) == true;
}

void put_word(std::vector<unsigned char>& bytes, std::size_t at, std::uint64_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<unsigned char>(value >> (8 * i));
}

}  // namespace

std::optional<std::string> mended(const json& root, bool is_binary) {
  std::vector<std::size_t> buffers, skins;
  for_each_object(root, "buffers", [&](std::size_t i, const json& buffer) {
    const bool is_chunk = is_binary && i == 0;
    if (!is_chunk && is_fallback(buffer)) buffers.push_back(i);
  });
  for_each_object(root, "skins", [&](std::size_t i, const json& skin) {
    if (!skin.contains("inverseBindMatrices")) skins.push_back(i);
  });
  std::vector<std::pair<std::size_t, std::size_t>> primitives;  // mesh, primitive
  for_each_object(root, "meshes", [&](std::size_t i, const json& mesh) {
    for_each_object(mesh, "primitives", [&](std::size_t j, const json& primitive) {
      if (has_packed_indices(root, primitive)) primitives.emplace_back(i, j);
    });
  });
  const bool is_animated = root.contains("animations");
  if (buffers.empty() && skins.empty() && primitives.empty() && !is_animated) return std::nullopt;
  json copy = root;
  copy.erase("animations");
  for (const std::size_t i : buffers) {  // one byte, which nobody reads
    copy["buffers"][i]["uri"] = "data:application/octet-stream;base64,AA==";
    copy["buffers"][i]["byteLength"] = 1;
  }
  for (const std::size_t i : skins) copy["skins"][i]["inverseBindMatrices"] = -1;
  for (const auto& [i, j] : primitives) {
    json& primitive = copy["meshes"][i]["primitives"][j];
    primitive["extensions"]["KHR_draco_mesh_compression"]["indices"] = primitive["indices"];
    primitive.erase("indices");
  }
  return copy.dump();
}

std::vector<unsigned char> with_json_chunk(const std::vector<unsigned char>& glb,
                                           std::string text) {
  constexpr std::size_t kHeaders = 20;  // of the file and its first chunk
  std::uint32_t old_length = 0;
  std::memcpy(&old_length, glb.data() + 12, sizeof old_length);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<unsigned char> result;
  result.reserve(glb.size() - old_length + text.size());
  const auto rest = glb.begin() + static_cast<std::ptrdiff_t>(kHeaders + old_length);
  std::copy(glb.begin(), glb.begin() + kHeaders, std::back_inserter(result));
  std::copy(text.begin(), text.end(), std::back_inserter(result));
  std::copy(rest, glb.end(), std::back_inserter(result));
  put_word(result, 8, result.size());
  put_word(result, 12, text.size());
  return result;
}

}  // namespace ppm::scene::gltf
