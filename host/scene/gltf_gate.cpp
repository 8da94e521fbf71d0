#include "gltf_gate.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "failure.hpp"
#include "gltf_document.hpp"
#include "gltf_mending.hpp"
#include "gltf_rules.hpp"
#include "gltf_schema.hpp"

namespace ppm::scene::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMostValues = std::uint64_t{1} << 23;  // some 100 bytes each at one time
constexpr std::uint64_t kMostItemBytes = std::uint64_t{1} << 31;
constexpr int kDeepestNesting = 256;  // glTF itself needs about ten

/// Before any value is made: nesting that would exhaust the stack, values that would the memory.
void check_shape(std::string_view text, const std::string& file) {
  int depth = 0;
  std::uint64_t values = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') ++i;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (c == '[' || c == '{' || c == ',') ++values;
    if (depth > kDeepestNesting) {
      throw Failure(file, "", "its JSON is nested deeper than any glTF", "check the file");
    }
  }
  if (values > kMostValues) {
    throw Failure(file, "", "its JSON has too many values", "put the data into buffers");
  }
}

json parse(std::string_view text, const std::string& file) {
  check_shape(text, file);
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    const std::string_view message = error.what();
    const std::size_t prefix = message.find("] ");
    const std::size_t start = prefix == std::string_view::npos ? 0 : prefix + 2;
    throw Failure(file, "", "its JSON cannot be read: " + printable(message.substr(start)),
                  "export the file again");
  }
}

/// The path, below `value`, of an integer that tinygltf would cut to 32 bits.
std::optional<std::string> cut_integer(const json& value, bool in_extension = false) {
  if (value.is_number_integer()) {
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= std::numeric_limits<int>::max()
                          : value.get<std::int64_t>() >= std::numeric_limits<int>::min();
    return fits ? std::nullopt : std::optional(std::string());
  }
  if (!value.is_structured()) return std::nullopt;
  constexpr std::array kRead64{"byteLength", "byteOffset", "count", "min", "max", "extras"};
  for (const auto& [key, member] : value.items()) {
    const bool may_be_long = std::find(kRead64.begin(), kRead64.end(), key) != kRead64.end();
    if (may_be_long && (!in_extension || key == "extras")) continue;
    const bool is_extension = in_extension || key == "extensions";
    if (const std::optional<std::string> rest = cut_integer(member, is_extension)) {
      return (value.is_array() ? "[" + key + "]" : "." + key) + *rest;
    }
  }
  return std::nullopt;
}

/// The path, below `value`, of a negative index or size, which tinygltf would take for none.
std::optional<std::string> negative_index(const json& value) {
  constexpr std::array kNeverNegative{
      "buffer",  "bufferView", "byteLength", "byteOffset", "byteStride", "camera",
      "count",   "index",      "indices",    "light",      "mesh",       "material",
      "sampler", "scene",      "skin",       "source",     "texCoord"};
  if (!value.is_structured()) return std::nullopt;
  for (const auto& [key, member] : value.items()) {
    if (key == "extras") continue;
    const std::string step = value.is_array() ? "[" + key + "]" : "." + key;
    const bool is_index =
        std::find(kNeverNegative.begin(), kNeverNegative.end(), key) != kNeverNegative.end();
    if (is_index && member.is_number() && member.get<double>() < 0.0) return step;
    if (const std::optional<std::string> rest = negative_index(member)) return step + *rest;
  }
  return std::nullopt;
}

/// Every name that stands as a member of some "extensions" object.
void add_extensions(const json& value, std::set<std::string>& names) {
  if (!value.is_structured()) return;
  for (const auto& [key, member] : value.items()) {
    if (key == "extras") continue;
    if (key == "extensions" && member.is_object()) {
      for (const auto& [name, unused] : member.items()) names.insert(name);
    }
    add_extensions(member, names);
  }
}

/// Items may be of two bytes in the file and of thousands in tinygltf.
void check_item_bytes(const json& root, const std::string& file) {
  const auto bytes = [&](const char* array, std::size_t each) {
    const auto found = root.find(array);
    return found == root.end() ? 0 : found->size() * each;
  };
  std::uint64_t primitives = 0;
  if (root.contains("meshes")) {
    for (const json& mesh : root["meshes"]) primitives += mesh["primitives"].size();
  }
  const std::uint64_t sum =
      bytes("accessors", sizeof(tinygltf::Accessor)) +
      bytes("bufferViews", sizeof(tinygltf::BufferView)) +
      bytes("cameras", sizeof(tinygltf::Camera)) + bytes("images", sizeof(tinygltf::Image)) +
      bytes("materials", sizeof(tinygltf::Material)) + bytes("meshes", sizeof(tinygltf::Mesh)) +
      bytes("nodes", sizeof(tinygltf::Node)) + bytes("samplers", sizeof(tinygltf::Sampler)) +
      bytes("scenes", sizeof(tinygltf::Scene)) + bytes("skins", sizeof(tinygltf::Skin)) +
      bytes("textures", sizeof(tinygltf::Texture)) + primitives * sizeof(tinygltf::Primitive);
  if (sum <= kMostItemBytes) return;
  throw Failure(file, "", "its JSON has too many items: they would take more than 2 GiB",
                "merge meshes and materials that are alike");
}

Survey survey_of(const json& root) {
  Survey result;
  add_extensions(root, result.extensions);
  result.has_animations = root.contains("animations") && !root["animations"].empty();
  for (const auto& [key, member] : root.items()) {
    if (member.is_array() && key != "animations") result.lengths[key] = member.size();
  }
  if (root.contains("extensionsUsed")) {
    for (const json& name : root["extensionsUsed"]) {
      result.extensions.insert(name.get<std::string>());
    }
  }
  if (!root.contains("buffers")) return result;
  for (const json& buffer : root["buffers"]) {
    const auto uri = buffer.find("uri");
    if (uri == buffer.end() || uri->get_ref<const std::string&>().starts_with("data:")) continue;
    result.external_lengths.push_back(buffer["byteLength"].get<std::uint64_t>());
  }
  return result;
}

}  // namespace

Survey survey(std::string_view text, bool is_binary, const std::string& file) {
  const json root = parse(text, file);
  check_schema(root, file);
  if (const std::optional<std::string> path = cut_integer(root)) {
    throw Failure(file, path->substr(1), "is an integer beyond 32 bits", "correct the number");
  }
  if (const std::optional<std::string> path = negative_index(root)) {
    throw Failure(file, path->substr(1), "is negative", "correct the number");
  }
  check_rules(root, is_binary, file);
  check_item_bytes(root, file);
  Survey result = survey_of(root);
  result.mended_json = mended(root, is_binary);
  return result;
}

}  // namespace ppm::scene::gltf
