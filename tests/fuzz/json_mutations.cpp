#include "json_mutations.hpp"

#include <array>
#include <string>
#include <vector>

namespace ppm::fuzz {
namespace {

using nlohmann::json;

constexpr std::size_t kMostText = 1 << 14;

std::size_t below(std::size_t limit, std::minstd_rand& random) {
  return random() % limit;
}

/// A random value below `root`, or itself; `owner` becomes what holds it.
json& pick(json& root, std::minstd_rand& random, json** owner = nullptr) {
  json* value = &root;
  while (value->is_structured() && !value->empty() && below(6, random) != 0) {
    if (owner != nullptr) *owner = value;
    auto item = value->begin();
    std::advance(item, static_cast<std::ptrdiff_t>(below(value->size(), random)));
    value = &*item;
  }
  return *value;
}

json number(std::minstd_rand& random) {
  static const std::vector<json> numbers{0,
                                         1,
                                         2,
                                         3,
                                         4,
                                         5,
                                         6,
                                         7,
                                         8,
                                         9,
                                         12,
                                         16,
                                         32,
                                         64,
                                         127,
                                         128,
                                         200,
                                         252,
                                         255,
                                         256,
                                         1000,
                                         32767,
                                         32768,
                                         65535,
                                         65536,
                                         16777216,
                                         2147483647,
                                         2147483648,
                                         4294967295,
                                         4294967296,
                                         -1,
                                         -2,
                                         -128,
                                         -32768,
                                         -2147483648,
                                         0.5,
                                         -0.5,
                                         1.5,
                                         3.14159265,
                                         1e-7,
                                         1e-30,
                                         1e-300,
                                         1e19,
                                         1e30,
                                         1e38,
                                         1e300,
                                         -1e38,
                                         -1e300,
                                         -0.0,
                                         281474976710656,
                                         9007199254740993,
                                         9223372036854775807,
                                         18446744073709551615u};
  return numbers[below(numbers.size(), random)];
}

json string(std::minstd_rand& random) {
  static const std::array words{"SCALAR",
                                "VEC2",
                                "VEC3",
                                "VEC4",
                                "MAT4",
                                "OPAQUE",
                                "MASK",
                                "BLEND",
                                "perspective",
                                "orthographic",
                                "point",
                                "spot",
                                "directional",
                                "weights",
                                "translation",
                                "image/png",
                                "image/jpeg",
                                "beside.bin",
                                "input",
                                ".",
                                "data:,",
                                "data:application/octet-stream;base64,AAAA",
                                "data:image/png;base64,iVBORw0KGgo=",
                                "%",
                                "\n",
                                "",
                                "TRIANGLES",
                                "INDICES",
                                "ATTRIBUTES",
                                "OCTAHEDRAL",
                                "QUATERNION",
                                "EXPONENTIAL"};
  return words[below(words.size(), random)];
}

/// Members that some object of glTF may have.
std::pair<std::string, json> member(std::minstd_rand& random) {
  static const std::vector<std::pair<const char*, const char*>> members{
      {"material", "0"},
      {"mesh", "0"},
      {"camera", "0"},
      {"skin", "0"},
      {"indices", "0"},
      {"mode", "5"},
      {"byteStride", "16"},
      {"byteOffset", "4"},
      {"normalized", "true"},
      {"bufferView", "0"},
      {"buffer", "0"},
      {"count", "3"},
      {"componentType", "5123"},
      {"sparse",
       R"({"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}})"},
      {"children", "[0]"},
      {"nodes", "[0]"},
      {"scene", "0"},
      {"weights", "[1]"},
      {"matrix", "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"},
      {"rotation", "[0,0,0,1]"},
      {"scale", "[1,1,1]"},
      {"translation", "[0,0,0]"},
      {"uri", "\"beside.bin\""},
      {"targets", R"([{"POSITION":0}])"},
      {"texCoord", "1"},
      {"sampler", "0"},
      {"source", "0"},
      {"POSITION", "0"},
      {"NORMAL", "0"},
      {"TANGENT", "0"},
      {"TEXCOORD_0", "0"},
      {"TEXCOORD_1", "0"},
      {"TEXCOORD_2", "0"},
      {"COLOR_0", "0"},
      {"JOINTS_0", "0"},
      {"WEIGHTS_0", "0"},
      {"JOINTS_1", "0"},
      {"WEIGHTS_1", "0"},
      {"extras", R"({"a":[[{}]]})"},
      {"baseColorTexture", R"({"index":0})"},
      {"normalTexture", R"({"index":0,"scale":2})"},
      {"emissiveTexture", R"({"index":0})"},
      {"alphaMode", "\"BLEND\""},
      {"alphaCutoff", "0.5"},
      {"inverseBindMatrices", "0"},
      {"skeleton", "0"},
      {"joints", "[0]"},
      {"name", "\"a\""},
      {"KHR_texture_transform", R"({"offset":[1,0],"rotation":1,"scale":[2,2],"texCoord":1})"},
      {"EXT_mesh_gpu_instancing", R"({"attributes":{"TRANSLATION":0}})"},
      {"EXT_meshopt_compression",
       R"({"buffer":0,"byteOffset":0,"byteLength":36,"byteStride":12,"mode":"ATTRIBUTES","count":3})"},
      {"KHR_draco_mesh_compression", R"({"bufferView":0,"attributes":{"POSITION":0}})"},
      {"KHR_lights_punctual", R"({"light":0})"},
      {"KHR_materials_clearcoat", R"({"clearcoatFactor":1})"},
      {"KHR_materials_dispersion", R"({"dispersion":1})"},
      {"KHR_materials_unlit", "{}"},
      {"KHR_materials_sheen", R"({"sheenColorFactor":[1,1,1]})"},
      {"KHR_materials_iridescence", R"({"iridescenceFactor":1})"},
      {"KHR_materials_anisotropy", R"({"anisotropyStrength":1})"},
      {"KHR_materials_transmission",
       R"({"transmissionFactor":1,"transmissionTexture":{"index":0}})"},
      {"EXT_lights_image_based", R"({"light":0})"},
      {"EXT_texture_webp", R"({"source":0})"},
      {"extensions", "{}"}};
  const auto& [key, text] = members[below(members.size(), random)];
  return {key, json::parse(text)};
}

json misfit(std::minstd_rand& random) {
  switch (below(8, random)) {
    case 0:
      return nullptr;
    case 1:
      return below(2, random) == 0;
    case 2:
      return json::array();
    case 3:
      return json::object();
    case 4:
      return json::array({number(random), number(random), number(random)});
    case 5:
      return string(random);
    default:
      return number(random);
  }
}

void nudge(json& value, std::minstd_rand& random) {
  if (value.is_number_integer()) {
    const auto n = value.get<std::uint64_t>();  // wraps where a signed number would overflow
    const std::array<std::uint64_t, 4> near{n - 1, n + 1, n / 2, 2 * n};
    value = static_cast<std::int64_t>(near[below(near.size(), random)]);
  } else if (value.is_number()) {
    value = value.get<double>() * (below(2, random) == 0 ? -1.0 : 1e3);
  } else if (value.is_string()) {
    value = string(random);
  } else {
    value = misfit(random);
  }
}

}  // namespace

void bend(json& document, std::minstd_rand& random) {
  json* owner = nullptr;
  json& value = pick(document, random, &owner);
  switch (below(9, random)) {
    case 0:
      value = misfit(random);
      break;
    case 1:
    case 2:
      if (value.is_number()) {
        value = number(random);
        break;
      }
      [[fallthrough]];
    case 3:
      if (value.is_primitive()) nudge(value, random);
      break;
    case 4:
      if (owner != nullptr && owner->is_array()) {
        owner->erase(below(owner->size(), random));
      } else if (owner != nullptr && owner->is_object()) {
        auto item = owner->begin();
        std::advance(item, static_cast<std::ptrdiff_t>(below(owner->size(), random)));
        owner->erase(item);
      }
      break;
    case 5:
      if (owner != nullptr && owner->is_array() && owner->size() < 200) {
        const json item = value;
        for (std::size_t n = std::size_t{1} << below(5, random); n > 0; --n) owner->push_back(item);
      }
      break;
    case 6: {
      const json copy = pick(document, random);
      if (copy.dump(-1, ' ', false, json::error_handler_t::replace).size() < kMostText / 8)
        value = copy;
      break;
    }
    default: {
      json* target = value.is_object() ? &value : owner;
      if (target != nullptr && target->is_object()) {
        const auto [key, content] = member(random);
        (*target)[key] = content;
      }
    }
  }
}

void graft(json& document, const json& other, std::minstd_rand& random) {
  json donor = other;
  json* donor_owner = nullptr;
  const json part = pick(donor, random, &donor_owner);
  json* owner = nullptr;
  json& value = pick(document, random, &owner);
  if (owner != nullptr && owner->is_array() && below(2, random) == 0) {
    owner->push_back(part);
  } else {
    value = part;
  }
}

}  // namespace ppm::fuzz
