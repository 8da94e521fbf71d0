#include "gltf_gate.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "failure.hpp"
#include "gltf_document.hpp"

namespace ppm::scene::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::size_t kLargestText = std::numeric_limits<int>::max();
constexpr std::uint64_t kMostBufferBytes = std::uint64_t{1} << 32;
constexpr std::uint64_t kMostValues = std::uint64_t{1} << 25;  // some 200 bytes each in tinygltf
constexpr int kDeepestNesting = 256;                           // glTF itself needs about ten

// What tinygltf ignores where it is of another type.
constexpr std::array kArrays{
    "accessors",      "animations", "bufferViews", "buffers", "cameras", "extensionsRequired",
    "extensionsUsed", "images",     "materials",   "meshes",  "nodes",   "samplers",
    "scenes",         "skins",      "textures"};

std::uint32_t word(const std::vector<unsigned char>& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);  // little-endian, as the hosts of Vulkan
  return value;
}

[[noreturn]] void fail_glb(const std::string& file, const std::string& what) {
  throw Failure(file, "", what, "export or copy the file again");
}

/// The length that the chunk at `at` claims, which must lie before `end`.
std::uint32_t chunk_length(const std::vector<unsigned char>& bytes, std::size_t at, std::size_t end,
                           const std::string& file) {
  const std::uint32_t length = word(bytes, at);
  const std::size_t left = end - at - kChunkHeaderBytes;
  if (length <= left) return length;
  fail_glb(file, "the .glb is cut short: a chunk claims " + std::to_string(length) + " bytes, " +
                     std::to_string(left) + " are left");
}

/// The JSON chunk of a .glb. The chunk behind it is checked, too: tinygltf 2.7.0 forgets its header
/// when it compares lengths.
std::string_view json_chunk(const std::vector<unsigned char>& bytes, const std::string& file) {
  constexpr std::size_t kStart = kHeaderBytes + kChunkHeaderBytes;
  if (bytes.size() < kStart) fail_glb(file, "the .glb ends within its header");
  if (word(bytes, 4) != 2) {
    throw Failure(file, "", "is a .glb of version " + std::to_string(word(bytes, 4)),
                  "export it as glTF 2.0");
  }
  const std::uint32_t size = word(bytes, 8);
  if (size < kStart || size > bytes.size()) {
    fail_glb(file, "the .glb is cut short: its header claims " + std::to_string(size) +
                       " bytes, the file has " + std::to_string(bytes.size()));
  }
  if (word(bytes, 16) != 0x4e4f534a) fail_glb(file, "the first chunk of the .glb is not JSON");
  const std::uint32_t length = chunk_length(bytes, kHeaderBytes, size, file);
  const std::size_t next = kStart + length;
  if (next + kChunkHeaderBytes <= size) chunk_length(bytes, next, size, file);
  return {reinterpret_cast<const char*>(bytes.data()) + kStart, length};
}

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
std::optional<std::string> cut_integer(const json& value) {
  if (value.is_number_integer()) {
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= std::numeric_limits<int>::max()
                          : value.get<std::int64_t>() >= std::numeric_limits<int>::min();
    return fits ? std::nullopt : std::optional(std::string());
  }
  if (!value.is_structured()) return std::nullopt;
  constexpr std::array kRead64{"byteLength", "byteOffset", "count", "min", "max", "extras"};
  for (const auto& [key, member] : value.items()) {
    if (std::find(kRead64.begin(), kRead64.end(), key) != kRead64.end()) continue;
    if (const std::optional<std::string> rest = cut_integer(member)) {
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

/// tinygltf gives every buffer its bytes, however many buffers share a chunk or a file.
void check_buffers(const json& root, const std::string& file) {
  const auto buffers = root.find("buffers");
  if (buffers == root.end()) return;
  std::uint64_t sum = 0;
  for (const json& buffer : *buffers) {
    const auto length = buffer.find("byteLength");
    if (length == buffer.end() || !length->is_number_unsigned()) continue;  // tinygltf refuses it
    const auto bytes = length->get<std::uint64_t>();
    if (bytes > kMostBufferBytes - sum) {
      throw Failure(file, "buffers", "claim more than 4 GiB", "use a smaller scene");
    }
    sum += bytes;
  }
}

bool leads_outside(const std::filesystem::path& path) {
  return path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
}

}  // namespace

std::string read_file(const std::filesystem::path& file, std::uint64_t limit,
                      std::vector<unsigned char>& bytes) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) return "there is no such file";
  if (!std::filesystem::is_regular_file(status)) return "is not a regular file";
  std::ifstream stream(file, std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(file, code);
  if (!stream || code) return "cannot be opened for reading";
  if (size > limit) return "is too large";
  bytes.resize(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return static_cast<std::uint64_t>(stream.gcount()) == size ? "" : "cannot be read to its end";
}

std::string Surroundings::read(const std::string& uri, std::vector<unsigned char>& bytes) {
  if (uri.find('\0') != std::string::npos) return "is not a file name";
  if (uri.substr(0, uri.find('/')).find(':') != std::string::npos) {
    return "has a scheme; only files beside the glTF file and base64 data URIs are read";
  }
  const std::filesystem::path path(uri);
  if (leads_outside(path) || uri.find('\\') != std::string::npos) {
    return "leads outside the folder of the glTF file";
  }
  std::string error = read_file(folder_ / path, budget_, bytes);
  if (error.empty()) budget_ -= bytes.size();
  return error;
}

Survey survey(const std::vector<unsigned char>& bytes, const std::string& file) {
  Survey result;
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  result.is_binary = text.starts_with("glTF");
  if (result.is_binary) text = json_chunk(bytes, file);
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string_view::npos || text[first] != '{') {
    throw Failure(file, "", "is neither a .gltf (JSON) nor a .glb file",
                  "export the scene as glTF 2.0");
  }
  if (text.size() > kLargestText) {
    throw Failure(file, "", "its JSON is larger than 2 GiB", "put the data into buffers");
  }
  const json root = parse(text, file);
  if (const std::optional<std::string> path = cut_integer(root)) {
    throw Failure(file, path->substr(1), "is an integer beyond 32 bits", "correct the number");
  }
  if (const std::optional<std::string> path = negative_index(root)) {
    throw Failure(file, path->substr(1), "is negative", "correct the number");
  }
  if (const auto asset = root.find("asset"); asset == root.end() || !asset->is_object()) {
    throw Failure(file, "asset", "is missing or no object", "export the scene as glTF 2.0");
  }
  check_buffers(root, file);
  add_extensions(root, result.extensions);
  for (const char* array : kArrays) {
    const auto member = root.find(array);
    if (member == root.end()) continue;
    if (!member->is_array()) throw Failure(file, array, "is not a JSON array", "write [...] here");
    result.lengths[array] = member->size();
  }
  if (!result.lengths.contains("extensionsUsed")) return result;
  for (const json& name : root["extensionsUsed"]) {
    if (name.is_string()) result.extensions.insert(name.get<std::string>());
  }
  return result;
}

}  // namespace ppm::scene::gltf
