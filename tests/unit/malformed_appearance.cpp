#include "malformed.hpp"

namespace ppm::test {

using nlohmann::json;

namespace {

constexpr const char* kBaseColorTexture = "/materials/0/pbrMetallicRoughness/baseColorTexture";
constexpr const char* kLights = "/extensions/KHR_lights_punctual/lights";

/// A camera of these parameters instead of the sound one.
std::function<void(json&)> camera(const char* kind, json parameters) {
  return set("/cameras/0", {{"type", kind}, {kind, std::move(parameters)}});
}

/// An extension of the material.
std::function<void(json&)> extension(const char* name, json members) {
  return [=](json& root) { root["materials"][0]["extensions"][name] = members; };
}

const std::string kTransform =
    "materials[0].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform";

/// A KHR_texture_transform of the base colour's texture.
std::function<void(json&)> transform(json members) {
  return [=](json& root) {
    root[json::json_pointer(kBaseColorTexture)]["extensions"]["KHR_texture_transform"] = members;
  };
}

}  // namespace

std::vector<Malformed> malformed_appearance() {
  return {
      {"factor a string", set("/materials/0/extensions/KHR_materials_volume/thicknessFactor", "1"),
       "materials[0].extensions.KHR_materials_volume.thicknessFactor", "is not a number"},
      {"metallic a string", set("/materials/0/pbrMetallicRoughness/metallicFactor", "0.5"),
       "materials[0].pbrMetallicRoughness.metallicFactor", "is not a number"},
      {"colour of two", set("/materials/0/emissiveFactor", {1, 1}), "materials[0].emissiveFactor",
       "has 2 items"},
      {"colour of three", set("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1}),
       "materials[0].pbrMetallicRoughness.baseColorFactor", "has 3 items"},
      {"colour a name", set("/materials/0/pbrMetallicRoughness/baseColorFactor", "red"),
       "materials[0].pbrMetallicRoughness.baseColorFactor", "is not a JSON array"},
      {"model a number", set("/materials/0/pbrMetallicRoughness", 1),
       "materials[0].pbrMetallicRoughness", "is not a JSON object"},
      {"sides a number", set("/materials/0/doubleSided", 1), "materials[0].doubleSided",
       "is neither true nor false"},
      {"cutoff a string", set("/materials/0/alphaCutoff", "0.5"), "materials[0].alphaCutoff",
       "is not a number"},
      {"ior a string", extension("KHR_materials_ior", {{"ior", "1.5"}}),
       "materials[0].extensions.KHR_materials_ior.ior", "is not a number"},
      {"attenuation of two",
       extension("KHR_materials_volume", {{"thicknessFactor", 1}, {"attenuationColor", {1, 1}}}),
       "materials[0].extensions.KHR_materials_volume.attenuationColor", "has 2 items"},
      {"attenuation of names",
       extension("KHR_materials_volume",
                 {{"thicknessFactor", 1}, {"attenuationColor", {1, "a", 1}}}),
       "materials[0].extensions.KHR_materials_volume.attenuationColor[1]", "is not a number"},

      {"texture out of range", set("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 5),
       "materials[0].pbrMetallicRoughness.baseColorTexture.index", "refers to textures[5]"},
      {"texture without index", drop(kBaseColorTexture, "index"),
       "materials[0].pbrMetallicRoughness.baseColorTexture.index", "is missing"},
      {"texture a number", set(kBaseColorTexture, 0),
       "materials[0].pbrMetallicRoughness.baseColorTexture", "is not a JSON object"},
      {"negative set", set("/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", -1),
       "materials[0].pbrMetallicRoughness.baseColorTexture.texCoord", "is negative"},
      {"image out of range", set("/textures/0/source", 3), "textures[0].source",
       "refers to images[3]"},
      {"sampler out of range", set("/textures/0/sampler", 3), "textures[0].sampler",
       "refers to samplers[3]"},
      {"wrap mode", set("/samplers/0/wrapS", 1), "samplers[0].wrapS", "is not a wrapping mode"},
      {"wrap a name", set("/samplers/0/wrapT", "REPEAT"), "samplers[0].wrapT",
       "is not a whole number"},
      {"filter", set("/samplers/0/magFilter", 1), "samplers[0].magFilter", "is not a filter"},

      {"normal map out of range", set("/materials/0/normalTexture", {{"index", 9}}),
       "materials[0].normalTexture.index", "refers to textures[9]"},
      {"emissive map without index", set("/materials/0/emissiveTexture", json::object()),
       "materials[0].emissiveTexture.index", "is missing"},
      {"normal scale a string", set("/materials/0/normalTexture", {{"index", 0}, {"scale", "1"}}),
       "materials[0].normalTexture.scale", "is not a number"},
      {"texture in an extension out of range",
       extension("KHR_materials_transmission",
                 {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 9}}}}),
       "materials[0].extensions.KHR_materials_transmission.transmissionTexture.index",
       "refers to textures[9]"},
      {"texture in an extension without index",
       extension("KHR_materials_transmission",
                 {{"transmissionFactor", 1}, {"transmissionTexture", {{"texCoord", 0}}}}),
       "materials[0].extensions.KHR_materials_transmission.transmissionTexture", "has no index"},
      {"texture in an extension a number",
       extension("KHR_materials_transmission",
                 {{"transmissionFactor", 1}, {"transmissionTexture", 0}}),
       "materials[0].extensions.KHR_materials_transmission.transmissionTexture", "is no object"},
      {"texture in an extension by half",
       extension("KHR_materials_specular", {{"specularTexture", {{"index", 0.5}}}}),
       "materials[0].extensions.KHR_materials_specular.specularTexture.index",
       "is not a whole number"},
      {"coat of strings", extension("KHR_materials_clearcoat", {{"clearcoatFactor", "1"}}),
       "materials[0].extensions.KHR_materials_clearcoat.clearcoatFactor", "is not a number"},
      {"dispersion a list", extension("KHR_materials_dispersion", {{"dispersion", {1}}}),
       "materials[0].extensions.KHR_materials_dispersion.dispersion", "is not a number"},
      {"offset of strings", transform({{"offset", {"0", 0}}}), kTransform + ".offset[0]",
       "is not a number"},
      {"offset of three", transform({{"offset", {0, 0, 0}}}), kTransform + ".offset",
       "has 3 items"},
      {"scale of one", transform({{"scale", {1}}}), kTransform + ".scale", "has 1 items"},
      {"turn of two", transform({{"rotation", {1, 2}}}), kTransform + ".rotation",
       "is not a number"},
      {"transform to a set before the first", transform({{"texCoord", -1}}),
       kTransform + ".texCoord", "is negative"},
      {"webp out of range",
       [](json& root) { root["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 9; },
       "textures[0].extensions.EXT_texture_webp.source", "refers to images[9]"},

      {"image of nothing", set("/images/0", json::object()), "images[0]",
       "has neither a uri nor a bufferView"},
      {"image with two sources", set("/images/0/uri", "none.png"), "images[0]",
       "has both a uri and a bufferView"},
      {"no image", set("/images/0/bufferView", 0), "images[0]", "is no PNG"},
      {"image view out of range", set("/images/0/bufferView", 99), "images[0].bufferView",
       "refers to bufferViews[99]"},
      {"missing image file", set("/images/0", {{"uri", "none.png"}}), "images[0].uri",
       "\"none.png\" cannot be read"},
      {"image from the web", set("/images/0", {{"uri", "https://example.org/a.png"}}),
       "images[0].uri", "cannot be read"},
      {"image from elsewhere", set("/images/0", {{"uri", "../../../../etc/passwd"}}),
       "images[0].uri", "cannot be read"},
      {"image uri a number", set("/images/0", {{"uri", 1}}), "images[0].uri", "is not a string"},
      {"image beyond the buffer", set("/bufferViews/7/byteOffset", 1000000000000), "bufferViews[7]",
       "ends at byte"},
      {"image of a broken uri", set("/images/0", {{"uri", "data:image/png;base64,!!"}}),
       "images[0]", "Failed to decode"},

      {"light out of range", set("/nodes/2/extensions/KHR_lights_punctual/light", 1),
       "nodes[2].extensions.KHR_lights_punctual.light", "refers to"},
      {"light a string", set("/nodes/2/extensions/KHR_lights_punctual/light", "0"),
       "nodes[2].extensions.KHR_lights_punctual.light", "is not a number"},
      {"lights not a list", set(kLights, 1), "extensions.KHR_lights_punctual.lights",
       "is not a JSON array"},
      {"no lights", set("/extensions/KHR_lights_punctual", json::object()),
       "extensions.KHR_lights_punctual.lights", "is missing"},
      {"light without type", set(kLights, json::array({json::object()})),
       "extensions.KHR_lights_punctual.lights[0].type", "is missing"},
      {"light type", set("/extensions/KHR_lights_punctual/lights/0/type", "area"),
       "extensions.KHR_lights_punctual.lights[0].type", "is not a kind of light"},
      {"spot without cone", drop("/extensions/KHR_lights_punctual/lights/0", "spot"),
       "extensions.KHR_lights_punctual.lights[0].spot", "is missing"},
      {"cone a string", set("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", "45"),
       "extensions.KHR_lights_punctual.lights[0].spot.outerConeAngle", "is not a number"},
      {"bright light", set("/extensions/KHR_lights_punctual/lights/0/intensity", 1e300),
       "extensions.KHR_lights_punctual.lights[0]", "intensity overflows"},
      {"light colour of two", set("/extensions/KHR_lights_punctual/lights/0/color", {1, 1}),
       "extensions.KHR_lights_punctual.lights[0].color", "has 2 items"},
      {"light too far away", set("/nodes/2/translation", {1e300, 0, 0}), "nodes[2]",
       "too far away"},

      {"camera out of range", set("/nodes/1/camera", 1), "nodes[1].camera", "refers to cameras[1]"},
      {"no camera type", drop("/cameras/0", "type"), "cameras[0].type", "is missing"},
      {"camera type", set("/cameras/0/type", "fisheye"), "cameras[0].type",
       "is not a kind of camera"},
      {"camera of the other kind", set("/cameras/0/type", "orthographic"),
       "cameras[0].orthographic", "is missing"},
      {"no field of view", drop("/cameras/0/perspective", "yfov"), "cameras[0].perspective.yfov",
       "is missing"},
      {"field of view a string", set("/cameras/0/perspective/yfov", "40"),
       "cameras[0].perspective.yfov", "is not a number"},
      {"wide camera", set("/cameras/0/perspective/yfov", 3.2), "cameras[0].perspective.yfov",
       "is not between 0 and pi"},
      {"camera of pi", set("/cameras/0/perspective/yfov", 3.141592653589793),
       "cameras[0].perspective.yfov", "is not between 0 and pi"},
      {"narrow camera", set("/cameras/0/perspective/yfov", 0), "cameras[0].perspective.yfov",
       "is not between 0 and pi"},
      {"backward camera", set("/cameras/0/perspective/yfov", -1), "cameras[0].perspective.yfov",
       "is not between 0 and pi"},
      {"flat camera", set("/cameras/0/perspective/aspectRatio", 1e-9),
       "cameras[0].perspective.aspectRatio", "is not the aspect"},
      {"negative aspect", set("/cameras/0/perspective/aspectRatio", -1),
       "cameras[0].perspective.aspectRatio", "is not the aspect"},
      {"no near plane", drop("/cameras/0/perspective", "znear"), "cameras[0].perspective.znear",
       "is missing"},
      {"orthographic without width",
       camera("orthographic", {{"ymag", 1}, {"znear", 0}, {"zfar", 9}}),
       "cameras[0].orthographic.xmag", "is missing"},
      {"far before near", set("/cameras/0/perspective/zfar", 0.05), "cameras[0].perspective.zfar",
       "is not beyond znear"},
      {"far is near", set("/cameras/0/perspective/zfar", 0.1), "cameras[0].perspective.zfar",
       "is not beyond znear"},
      {"far behind", set("/cameras/0/perspective/zfar", -1), "cameras[0].perspective.zfar",
       "is not beyond znear"},
      {"orthographic far before near",
       camera("orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 9}, {"zfar", 1}}),
       "cameras[0].orthographic.zfar", "is not beyond znear"},
      {"orthographic of no width",
       camera("orthographic", {{"xmag", 0}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}),
       "cameras[0].orthographic.xmag", "is out of all proportion"},
      {"orthographic of endless height",
       camera("orthographic", {{"xmag", 1}, {"ymag", 1e300}, {"znear", 0}, {"zfar", 9}}),
       "cameras[0].orthographic.ymag", "is out of all proportion"},
      {"camera too far away",
       [](json& root) {
         root["nodes"].push_back({{"camera", 0}, {"translation", {1e308, 0, 0}}});
         root["scenes"][0]["nodes"].push_back(3);
       },
       "nodes[3]", "its camera is too far away"},
  };
}

}  // namespace ppm::test
