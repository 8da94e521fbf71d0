#include "gltf_material.hpp"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace ppm::scene::gltf {
namespace {

constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 28;  // 2 GiB of half floats
constexpr double kLargestFactor = 1e20;  // for factors without an upper limit: products stay finite
constexpr double kLargestIor = 1e3;
constexpr float kSmoothRoughness =
    0.03f;  // rougher glass looks different from the smooth one drawn

std::span<float> components(glm::vec3& v) {
  return {glm::value_ptr(v), 3};
}

void warn_of_members(const Element& element, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const std::optional<Element> member = element.find(name)) {
      member->warn(name, std::string(name) + " is ignored");
    }
  }
}

void warn_of_alpha(const Element& element) {
  const std::optional<Element> mode = element.find("alphaMode");
  if (mode && mode->text() != "OPAQUE") {
    mode->warn("alphaMode", "alphaMode " + printable(mode->text()) + " is rendered as OPAQUE");
  }
}

void read_emission(const Element& element, Material& material) {
  element.factors("emissiveFactor", components(material.emission), 0.0, 1.0);
  if (const auto extension = element.extension("KHR_materials_emissive_strength")) {
    material.emission *= extension->factor("emissiveStrength", 1.0, 0.0, kLargestFactor);
  }
}

void read_specular(const Element& element, Material& material) {
  const auto extension = element.extension("KHR_materials_specular");
  if (!extension) return;
  material.specular = extension->factor("specularFactor", 1.0, 0.0, 1.0);
  extension->factors("specularColorFactor", components(material.specular_color), 0.0,
                     kLargestFactor);
  warn_of_members(*extension, {"specularTexture", "specularColorTexture"});
}

void read_ior(const Element& element, Material& material) {
  const auto extension = element.extension("KHR_materials_ior");
  if (!extension) return;
  if (extension->number_or("ior", 1.5) == 0.0) {
    extension->warn("ior 0", "ior 0, the specular-glossiness mode, is not known; 1.5 is used");
    return;
  }
  material.ior = extension->factor("ior", 1.5, 1.0, kLargestIor);
}

void read_transmission(const Element& element, Material& material) {
  const auto extension = element.extension("KHR_materials_transmission");
  if (!extension) return;
  material.transmission = extension->factor("transmissionFactor", 0.0, 0.0, 1.0);
  warn_of_members(*extension, {"transmissionTexture"});
  if (material.transmission > 0.0f && material.roughness > kSmoothRoughness) {
    extension->warn("rough transmission", "rough transmission is rendered smooth");
  }
}

void read_volume(const Element& element, Material& material, double length_scale) {
  const auto extension = element.extension("KHR_materials_volume");
  if (!extension) return;
  material.solid = extension->factor("thicknessFactor", 0.0, 0.0, kLargestFactor) > 0.0f;
  extension->factors("attenuationColor", components(material.attenuation_color), 0.0, 1.0);
  warn_of_members(*extension, {"thicknessTexture"});
  const std::optional<Element> distance = extension->find("attenuationDistance");
  if (!distance) return;
  const auto scaled = static_cast<float>(distance->number() * length_scale);
  if (scaled > 0.0f) {
    material.attenuation_distance = scaled;
  } else {
    distance->warn("attenuationDistance", "is not positive; the material does not attenuate");
  }
}

Wrap wrap_of(const Element& sampler, const char* key) {
  switch (sampler.whole_or(key, 10497)) {
    case 10497:
      return Wrap::repeat;
    case 33071:
      return Wrap::clamp_to_edge;
    case 33648:
      return Wrap::mirrored_repeat;
    default:
      sampler.require(key).fail("is not a wrapping mode", "use 10497, 33071 or 33648");
  }
}

bool is_nearest(const Element& sampler) {
  switch (sampler.whole_or("magFilter", 9729)) {
    case 9728:
      return true;
    case 9729:
      return false;
    default:
      sampler.require("magFilter").fail("is not a filter", "use 9728 or 9729");
  }
}

}  // namespace

Texture MaterialReader::decode_texture(const Element& element) {
  const Element source = element.follow("source", "images");
  Texture texture;
  texture.name = element.name().empty() ? source.name() : element.name();
  if (element.find("sampler")) {
    const Element sampler = element.follow("sampler", "samplers");
    texture.wrap_s = wrap_of(sampler, "wrapS");
    texture.wrap_t = wrap_of(sampler, "wrapT");
    texture.nearest = is_nearest(sampler);
  }
  Image image = decode_image(source, buffers_, kMostTexels - texel_count_);
  texel_count_ += image.texels.size();
  texture.width = image.width;
  texture.height = image.height;
  texture.texels = std::move(image.texels);
  return texture;
}

std::optional<std::uint32_t> MaterialReader::read_texture(const Element& info) {
  const std::uint32_t index = info.index("index", "textures");
  if (info.whole_or("texCoord", 0) != 0) {
    info.warn("texCoord", "textures that use another set than TEXCOORD_0 are ignored");
    return std::nullopt;
  }
  const Element element = info.follow("index", "textures");
  if (!element.find("source")) {
    element.warn("texture source", "a texture without a PNG or JPEG source is ignored");
    return std::nullopt;
  }
  const auto known = textures_by_index_.find(index);
  if (known != textures_by_index_.end()) return known->second;
  textures_.push_back(decode_texture(element));
  const auto position = static_cast<std::uint32_t>(textures_.size() - 1);
  textures_by_index_.emplace(index, position);
  return position;
}

void MaterialReader::read_metallic_roughness(const Element& element, Material& material) {
  const std::optional<Element> pbr = element.find("pbrMetallicRoughness");
  if (!pbr) return;
  std::array<float, 4> base{1.0f, 1.0f, 1.0f, 1.0f};
  pbr->factors("baseColorFactor", base, 0.0, 1.0);
  material.base_color = {base[0], base[1], base[2]};
  material.metallic = pbr->factor("metallicFactor", 1.0, 0.0, 1.0);
  material.roughness = pbr->factor("roughnessFactor", 1.0, 0.0, 1.0);
  if (const auto info = pbr->find("baseColorTexture"))
    material.base_color_texture = read_texture(*info);
  warn_of_members(*pbr, {"metallicRoughnessTexture"});
}

Material MaterialReader::read(const Element& element, double length_scale) {
  Material material;
  material.name = element.name();
  read_metallic_roughness(element, material);
  read_emission(element, material);
  read_specular(element, material);
  read_ior(element, material);
  read_transmission(element, material);
  read_volume(element, material, length_scale);
  material.double_sided = element.boolean_or("doubleSided", false);
  warn_of_members(element, {"normalTexture", "occlusionTexture", "emissiveTexture"});
  warn_of_alpha(element);
  return material;
}

}  // namespace ppm::scene::gltf
