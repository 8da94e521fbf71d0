#include "malformed.hpp"

namespace ppm::test {

using nlohmann::json;

std::vector<Malformed> malformed_structure() {
  return {
      {"no asset", drop("", "asset"), "asset", "is missing"},
      {"asset a list", set("/asset", json::array()), "asset", "is not a JSON object"},
      {"asset null", set("/asset", nullptr), "asset", "is not a JSON object"},
      {"no version", drop("/asset", "version"), "asset.version", "is missing"},
      {"version a number", set("/asset/version", 2.0), "asset.version", "is not a string"},
      {"old version", set("/asset/version", "1.0"), "asset.version", "is not 2.0 but 1.0"},
      {"newer version", set("/asset/version", "3.0"), "asset.version", "is not 2.0 but 3.0"},
      {"newer minimum", set("/asset/minVersion", "2.1"), "asset.version", "is not 2.0"},
      {"minimum a number", set("/asset/minVersion", 2), "asset.minVersion", "is not a string"},

      {"unknown required", set("/extensionsRequired", {"ACME_teapots"}), "extensionsRequired[0]",
       "ACME_teapots"},
      {"second unknown required", set("/extensionsRequired", {"KHR_lights_punctual", "ACME_x"}),
       "extensionsRequired[1]", "ACME_x"},
      {"sheen required", set("/extensionsRequired", {"KHR_materials_sheen"}),
       "extensionsRequired[0]", "KHR_materials_sheen"},
      {"textures of another kind required", set("/extensionsRequired", {"KHR_texture_basisu"}),
       "extensionsRequired[0]", "KHR_texture_basisu"},
      {"required not a list", set("/extensionsRequired", 3), "extensionsRequired",
       "is not a JSON array"},
      {"required not a name", set("/extensionsRequired", {7}), "extensionsRequired[0]",
       "is not a string"},
      {"used not names", set("/extensionsUsed", json::array({json::object()})), "extensionsUsed[0]",
       "is not a string"},
      {"unprintable name", set("/extensionsRequired", {"a\nb\x1b[31m"}), "extensionsRequired[0]",
       "a?b?[31m"},

      {"nodes not an array", set("/nodes", json::object()), "nodes", "is not a JSON array"},
      {"meshes a number", set("/meshes", 1), "meshes", "is not a JSON array"},
      {"buffers a string", set("/buffers", "a.bin"), "buffers", "is not a JSON array"},
      {"accessors null", set("/accessors", nullptr), "accessors", "is not a JSON array"},
      {"scenes true", set("/scenes", true), "scenes", "is not a JSON array"},
      {"node a number", set("/nodes/0", 5), "nodes[0]", "is not a JSON object"},
      {"mesh a list", set("/meshes/0", json::array()), "meshes[0]", "is not a JSON object"},
      {"material a string", set("/materials/0", "red"), "materials[0]", "is not a JSON object"},
      {"texture null", set("/textures/0", nullptr), "textures[0]", "is not a JSON object"},
      {"sampler a number", set("/samplers/0", 1), "samplers[0]", "is not a JSON object"},
      {"image a string", set("/images/0", "a.png"), "images[0]", "is not a JSON object"},
      {"camera a number", set("/cameras/0", 1), "cameras[0]", "is not a JSON object"},
      {"scene a number", set("/scenes/0", 1), "scenes[0]", "is not a JSON object"},
      {"accessor a number", set("/accessors/0", 1), "accessors[0]", "is not a JSON object"},
      {"view a number", set("/bufferViews/0", 1), "bufferViews[0]", "is not a JSON object"},
      {"skins not an array", set("/skins", 1), "skins", "is not a JSON array"},
      {"skin without joints", set("/skins", json::array({json::object()})), "skins[0].joints",
       "is missing"},

      {"index of 64 bits", set("/nodes/0/mesh", 4294967296), "nodes[0].mesh",
       "is an integer beyond 32 bits"},
      {"index of 2^31", set("/nodes/0/mesh", 2147483648), "nodes[0].mesh",
       "is an integer beyond 32 bits"},
      {"index beyond 64 bits", set("/nodes/0/mesh", 18446744073709551615u), "nodes[0].mesh",
       "is an integer beyond 32 bits"},
      {"index a fraction", set("/nodes/0/mesh", 0.5), "nodes[0].mesh", "is not a whole number"},
      {"index with a point", set("/nodes/0/mesh", 0.0), "nodes[0].mesh", "is not a whole number"},
      {"index a string", set("/nodes/0/mesh", "0"), "nodes[0].mesh", "is not a whole number"},
      {"index null", set("/nodes/0/mesh", nullptr), "nodes[0].mesh", "is not a whole number"},
      {"negative mesh", set("/nodes/0/mesh", -1), "nodes[0].mesh", "is negative"},
      {"negative scene", set("/scene", -2), "scene", "is negative"},
      {"scene a string", set("/scene", "0"), "scene", "is not a whole number"},
      {"negative index in an extension", set("/nodes/2/extensions/KHR_lights_punctual/light", -1),
       "nodes[2].extensions.KHR_lights_punctual.light", "is negative"},
      {"long index in an extension", set("/nodes/2/extensions/KHR_lights_punctual/light", 1e18),
       "nodes[2].extensions.KHR_lights_punctual.light", "refers to"},
      {"long integer in an extension",
       set("/nodes/2/extensions/KHR_lights_punctual/light", 1000000000000000000),
       "nodes[2].extensions.KHR_lights_punctual.light", "is an integer beyond 32 bits"},

      {"buffer of no length", drop("/buffers/0", "byteLength"), "buffers[0].byteLength",
       "is missing"},
      {"buffer of length 0", set("/buffers/0/byteLength", 0), "buffers[0].byteLength", "is 0"},
      {"buffer of negative length", set("/buffers/0/byteLength", -36), "buffers[0].byteLength",
       "is negative"},
      {"buffer claims more", set("/buffers/0/byteLength", 4000000000), "buffers[0]",
       "Failed to decode"},
      {"buffer beyond all", set("/buffers/0/byteLength", 18446744073709551615u),
       "buffers[0].byteLength", "is larger than any file"},
      {"buffer nowhere",
       [](json& root) {
         root["buffers"].push_back({{"byteLength", 4}});
       },
       "buffers[1].uri", "is missing"},
      {"chunk shared under an extension",
       [](json& root) {
         root["buffers"].push_back({{"byteLength", 4}, {"extensions", {{"ACME", json::object()}}}});
       },
       "buffers[1].uri", "is missing"},
      {"uri a number", set("/buffers/0/uri", 1), "buffers[0].uri", "is not a string"},
      {"buffers beyond memory",
       [](json& root) {
         for (int i = 0; i < 9; ++i) {
           root["buffers"].push_back({{"byteLength", 500000000}, {"uri", "a.bin"}});
         }
       },
       "buffers", "claim more than 4 GiB"},

      {"view of no buffer", drop("/bufferViews/0", "buffer"), "bufferViews[0].buffer",
       "is missing"},
      {"view of -1", set("/bufferViews/0/buffer", -1), "bufferViews[0].buffer", "is negative"},
      {"buffer out of range", set("/bufferViews/0/buffer", 1), "bufferViews[0].buffer",
       "refers to buffers[1]"},
      {"view of no length", drop("/bufferViews/0", "byteLength"), "bufferViews[0].byteLength",
       "is missing"},
      {"view too long", set("/bufferViews/0/byteLength", 1000000), "bufferViews[0]",
       "ends at byte"},
      {"view begins outside", set("/bufferViews/0/byteOffset", 281474976710656), "bufferViews[0]",
       "ends at byte"},
      {"view wraps",
       [](json& root) {
         root["bufferViews"][0]["byteOffset"] = 9007199254740992;
         root["bufferViews"][0]["byteLength"] = 9007199254740992;
       },
       "bufferViews[0].byteOffset", "is larger than any file"},
      {"view wraps around 2^64", set("/bufferViews/0/byteOffset", 18446744073709551580u),
       "bufferViews[0].byteOffset", "is larger than any file"},
      {"negative offset", set("/bufferViews/0/byteOffset", -4), "bufferViews[0].byteOffset",
       "is negative"},
      {"stride too small", set("/bufferViews/0/byteStride", 4), "bufferViews[0].byteStride",
       "is no stride for elements of 12 bytes"},
      {"stride too large", set("/bufferViews/0/byteStride", 1000000), "bufferViews[0].byteStride",
       "is no stride of glTF"},
      {"stride odd", set("/bufferViews/0/byteStride", 13), "bufferViews[0].byteStride",
       "is no stride of glTF"},
      {"stride negative", set("/bufferViews/0/byteStride", -16), "bufferViews[0].byteStride",
       "is negative"},
      {"stride leads out", set("/bufferViews/0/byteStride", 16), "accessors[0]", "needs 44 bytes"},
  };
}

}  // namespace ppm::test
