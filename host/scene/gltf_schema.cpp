#include "gltf_schema.hpp"

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "failure.hpp"
#include "gltf_document.hpp"

namespace ppm::scene::gltf {
namespace {

using nlohmann::json;

enum class Type {
  boolean,
  integer,  // fits 32 bits
  index,    // not negative, fits 31 bits
  size,     // not negative, below 2^53
  number,
  string,
  numbers,  // a list of them, `length` long where that is not 0
  indices,
  strings,
  index_map,   // an object of indices under names that the file chooses
  index_maps,  // a list of these
  object,
  objects,
};

/// A property: `of` are those of the objects that stand there.
struct Property {
  std::string_view name;
  Type type;
  bool required = false;
  std::size_t length = 0;
  std::span<const Property> of = {};
};

using enum Type;
constexpr bool kRequired = true;

constexpr Property optional_object(std::string_view name, std::span<const Property> of) {
  return {name, object, false, 0, of};
}
constexpr Property required_object(std::string_view name, std::span<const Property> of) {
  return {name, object, kRequired, 0, of};
}
constexpr Property list_of(std::string_view name, std::span<const Property> of,
                           bool required = false) {
  return {name, objects, required, 0, of};
}
constexpr Property vector_of(std::string_view name, std::size_t length) {
  return {name, numbers, false, length, {}};
}

constexpr std::array kAsset{Property{"version", string, kRequired}, Property{"minVersion", string}};

constexpr std::array kSparseIndices{Property{"bufferView", index, kRequired},
                                    Property{"byteOffset", index},
                                    Property{"componentType", integer, kRequired}};
constexpr std::array kSparseValues{Property{"bufferView", index, kRequired},
                                   Property{"byteOffset", index}};
// tinygltf cuts the numbers of sparse accessors to 32 bits.
constexpr std::array kSparse{Property{"count", index, kRequired},
                             required_object("indices", kSparseIndices),
                             required_object("values", kSparseValues)};
constexpr std::array kAccessor{Property{"bufferView", index},
                               Property{"byteOffset", size},
                               Property{"componentType", integer, kRequired},
                               Property{"normalized", boolean},
                               Property{"count", size, kRequired},
                               Property{"type", string, kRequired},
                               Property{"min", numbers},
                               Property{"max", numbers},
                               optional_object("sparse", kSparse)};
constexpr std::array kBuffer{Property{"uri", string}, Property{"byteLength", size, kRequired}};
constexpr std::array kBufferView{Property{"buffer", index, kRequired}, Property{"byteOffset", size},
                                 Property{"byteLength", size, kRequired},
                                 Property{"byteStride", index}, Property{"target", integer}};

constexpr std::array kPerspective{Property{"yfov", number, kRequired},
                                  Property{"znear", number, kRequired}, Property{"zfar", number},
                                  Property{"aspectRatio", number}};
constexpr std::array kOrthographic{
    Property{"xmag", number, kRequired}, Property{"ymag", number, kRequired},
    Property{"znear", number, kRequired}, Property{"zfar", number, kRequired}};
constexpr std::array kCamera{Property{"type", string, kRequired},
                             optional_object("perspective", kPerspective),
                             optional_object("orthographic", kOrthographic)};

constexpr std::array kImage{Property{"uri", string}, Property{"mimeType", string},
                            Property{"bufferView", index}};
constexpr std::array kTextureInfo{Property{"index", index, kRequired}, Property{"texCoord", index}};
constexpr std::array kNormalTexture{Property{"index", index, kRequired},
                                    Property{"texCoord", index}, Property{"scale", number}};
constexpr std::array kOcclusionTexture{Property{"index", index, kRequired},
                                       Property{"texCoord", index}, Property{"strength", number}};
constexpr std::array kMetallicRoughness{
    vector_of("baseColorFactor", 4), optional_object("baseColorTexture", kTextureInfo),
    Property{"metallicFactor", number}, Property{"roughnessFactor", number},
    optional_object("metallicRoughnessTexture", kTextureInfo)};
constexpr std::array kMaterial{optional_object("pbrMetallicRoughness", kMetallicRoughness),
                               optional_object("normalTexture", kNormalTexture),
                               optional_object("occlusionTexture", kOcclusionTexture),
                               optional_object("emissiveTexture", kTextureInfo),
                               vector_of("emissiveFactor", 3),
                               Property{"alphaMode", string},
                               Property{"alphaCutoff", number},
                               Property{"doubleSided", boolean}};
constexpr std::array kSampler{Property{"magFilter", integer}, Property{"minFilter", integer},
                              Property{"wrapS", integer}, Property{"wrapT", integer}};
constexpr std::array kTexture{Property{"sampler", index}, Property{"source", index}};

constexpr std::array kPrimitive{Property{"attributes", index_map, kRequired},
                                Property{"indices", index}, Property{"material", index},
                                Property{"mode", integer}, Property{"targets", index_maps}};
constexpr std::array kMesh{list_of("primitives", kPrimitive, kRequired),
                           Property{"weights", numbers}};
constexpr std::array kNode{
    Property{"camera", index}, Property{"children", indices}, Property{"skin", index},
    vector_of("matrix", 16),   Property{"mesh", index},       vector_of("rotation", 4),
    vector_of("scale", 3),     vector_of("translation", 3),   Property{"weights", numbers}};
constexpr std::array kScene{Property{"nodes", indices}};
constexpr std::array kSkin{Property{"inverseBindMatrices", index}, Property{"skeleton", index},
                           Property{"joints", indices, kRequired}};

constexpr std::array kSpot{Property{"innerConeAngle", number}, Property{"outerConeAngle", number}};
constexpr std::array kLight{Property{"type", string, kRequired}, vector_of("color", 3),
                            Property{"intensity", number}, Property{"range", number},
                            optional_object("spot", kSpot)};
constexpr std::array kLightsPunctual{list_of("lights", kLight, kRequired)};
constexpr std::array kExtensions{optional_object("KHR_lights_punctual", kLightsPunctual)};

constexpr std::array kRoot{required_object("asset", kAsset),
                           Property{"scene", index},
                           Property{"extensionsUsed", strings},
                           Property{"extensionsRequired", strings},
                           list_of("accessors", kAccessor),
                           list_of("animations", {}),
                           list_of("buffers", kBuffer),
                           list_of("bufferViews", kBufferView),
                           list_of("cameras", kCamera),
                           list_of("images", kImage),
                           list_of("materials", kMaterial),
                           list_of("meshes", kMesh),
                           list_of("nodes", kNode),
                           list_of("samplers", kSampler),
                           list_of("scenes", kScene),
                           list_of("skins", kSkin),
                           list_of("textures", kTexture),
                           optional_object("extensions", kExtensions)};

/// Where the walk is, without a string for each of the places that are sound.
struct Step {
  const Step* owner = nullptr;
  std::string_view key = {};
  std::size_t position = 0;  // where there is no key

  std::string path() const {
    if (owner == nullptr) return "";
    if (key.empty()) return owner->path() + "[" + std::to_string(position) + "]";
    const std::string before = owner->path();
    return before.empty() ? printable(key) : before + "." + printable(key);
  }
};

class Walk {
 public:
  explicit Walk(const std::string& file) : file_(file) {}

  void members(const json& value, std::span<const Property> properties, const Step& at) const {
    if (!value.is_object()) fail(at, "is not a JSON object", "write {...} here");
    for (const Property& property : properties) {
      const Step step{&at, property.name};
      const auto found = value.find(property.name);
      if (found != value.end()) {
        check(*found, property, step);
      } else if (property.required) {
        fail(step, "is missing", "add it: glTF 2.0 requires it");
      }
    }
  }

 private:
  [[noreturn]] void fail(const Step& at, std::string_view what, std::string_view remedy) const {
    throw Failure(file_, at.path(), what, remedy);
  }

  void check(const json& value, const Property& property, const Step& at) const {
    switch (property.type) {
      case boolean:
        if (!value.is_boolean()) fail(at, "is neither true nor false", "write one of them here");
        break;
      case integer:
      case index:
      case size:
        whole_number(value, property.type, at);
        break;
      case number:
        if (!value.is_number()) fail(at, "is not a number", "write a number here");
        break;
      case string:
        if (!value.is_string()) fail(at, "is not a string", "write \"...\" here");
        break;
      case numbers:
        items(value, {"", number}, at);
        if (property.length != 0 && value.size() != property.length) {
          fail(at, "has " + std::to_string(value.size()) + " items",
               "write " + std::to_string(property.length));
        }
        break;
      case indices:
        items(value, {"", index}, at);
        break;
      case strings:
        items(value, {"", string}, at);
        break;
      case index_map:
        if (!value.is_object()) fail(at, "is not a JSON object", "write {...} here");
        for (const auto& [key, member] : value.items()) {
          whole_number(member, index, Step{&at, key});
        }
        break;
      case index_maps:
        items(value, {"", index_map}, at);
        break;
      case object:
        members(value, property.of, at);
        break;
      case objects:
        items(value, {"", object, false, 0, property.of}, at);
        break;
    }
  }

  void items(const json& value, const Property& each, const Step& at) const {
    if (!value.is_array()) fail(at, "is not a JSON array", "write [...] here");
    for (std::size_t i = 0; i < value.size(); ++i) check(value[i], each, Step{&at, {}, i});
  }

  void whole_number(const json& value, Type type, const Step& at) const {
    if (!value.is_number_integer()) fail(at, "is not a whole number", "write one without a point");
    const bool is_huge = value.is_number_unsigned() &&
                         value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max();
    const auto n = value.get<std::int64_t>();
    if (type != integer && n < 0 && !is_huge) fail(at, "is negative", "correct the number");
    constexpr std::int64_t kLargestSize = std::int64_t{1} << 53;
    const std::int64_t largest = type == size ? kLargestSize : std::numeric_limits<int>::max();
    if (is_huge || n > largest || n < std::numeric_limits<int>::min()) {
      fail(at, type == size ? "is larger than any file" : "is an integer beyond 32 bits",
           "correct the number");
    }
  }

  const std::string& file_;
};

}  // namespace

void check_schema(const json& root, const std::string& file) {
  Walk(file).members(root, kRoot, Step{});
}

}  // namespace ppm::scene::gltf
