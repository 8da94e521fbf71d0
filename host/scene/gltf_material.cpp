#include "gltf_material.hpp"

#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace ppm::scene::gltf {
namespace {

constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 28;  // 2 GiB of half floats
constexpr double kLargestFactor = 1e20;  // for factors without an upper limit: products stay finite
constexpr double kLargestIor = 1e3;

std::span<float> components(glm::vec3& v) {
  return {glm::value_ptr(v), 3};
}

using MaterialElement = Element<tinygltf::Material>;

std::optional<Extension> extension_of(const MaterialElement& element, const char* name) {
  return Extension::find(element, element->extensions, name);
}

void warn_of_member(const Place& owner, const char* name, bool is_there) {
  if (is_there) owner.member(name).warn(name, std::string(name) + " is ignored");
}

void warn_of_unread(const MaterialElement& element) {
  warn_of_member(element, "normalTexture", element->normalTexture.index != -1);
  warn_of_member(element, "occlusionTexture", element->occlusionTexture.index != -1);
  warn_of_member(element, "emissiveTexture", element->emissiveTexture.index != -1);
  if (element->alphaMode != "OPAQUE") {
    element.member("alphaMode")
        .warn("alphaMode", "alphaMode " + printable(element->alphaMode) + " is rendered as OPAQUE");
  }
}

void read_emission(const MaterialElement& element, Material& material) {
  element.member("emissiveFactor")
      .clamped(element->emissiveFactor, components(material.emission), 0.0, 1.0);
  if (const auto extension = extension_of(element, "KHR_materials_emissive_strength")) {
    material.emission *= extension->factor("emissiveStrength", 1.0, 0.0, kLargestFactor);
  }
}

void read_specular(const MaterialElement& element, Material& material) {
  const auto extension = extension_of(element, "KHR_materials_specular");
  if (!extension) return;
  material.specular = extension->factor("specularFactor", 1.0, 0.0, 1.0);
  extension->factors("specularColorFactor", components(material.specular_color), 0.0,
                     kLargestFactor);
  for (const char* name : {"specularTexture", "specularColorTexture"}) {
    warn_of_member(*extension, name, extension->has(name));
  }
}

void read_ior(const MaterialElement& element, Material& material) {
  const auto extension = extension_of(element, "KHR_materials_ior");
  if (!extension) return;
  if (extension->number("ior") == 0.0) {
    extension->warn("ior 0", "ior 0, the specular-glossiness mode, is not known; 1.5 is used");
    return;
  }
  material.ior = extension->factor("ior", 1.5, 1.0, kLargestIor);
}

void read_transmission(const MaterialElement& element, Material& material) {
  const auto extension = extension_of(element, "KHR_materials_transmission");
  if (!extension) return;
  material.transmission = extension->factor("transmissionFactor", 0.0, 0.0, 1.0);
  warn_of_member(*extension, "transmissionTexture", extension->has("transmissionTexture"));
}

void read_volume(const MaterialElement& element, Material& material, double length_scale) {
  const auto extension = extension_of(element, "KHR_materials_volume");
  if (!extension) return;
  material.solid = extension->factor("thicknessFactor", 0.0, 0.0, kLargestFactor) > 0.0f;
  extension->factors("attenuationColor", components(material.attenuation_color), 0.0, 1.0);
  warn_of_member(*extension, "thicknessTexture", extension->has("thicknessTexture"));
  const std::optional<double> distance = extension->number("attenuationDistance");
  if (!distance) return;
  const auto scaled = static_cast<float>(*distance * length_scale);
  if (scaled > 0.0f) {
    material.attenuation_distance = scaled;
  } else {
    extension->member("attenuationDistance")
        .warn("attenuationDistance", "is not positive; the material does not attenuate");
  }
}

Wrap wrap_of(const Place& place, int number) {
  switch (number) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp_to_edge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirrored_repeat;
    default:
      place.fail("is not a wrapping mode", "use 10497, 33071 or 33648");
  }
}

bool is_nearest(const Place& place, int number) {
  switch (number) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      return true;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
    case -1:  // absent
      return false;
    default:
      place.fail("is not a filter", "use 9728 or 9729");
  }
}

}  // namespace

Texture MaterialReader::decode_texture(const Element<tinygltf::Texture>& element) {
  const tinygltf::Model& model = element.model();
  const auto source = follow(element.member("source"), element->source, model.images, "images");
  Texture texture;
  texture.name = element->name.empty() ? source.name() : element.name();
  if (element->sampler != -1) {
    const auto sampler =
        follow(element.member("sampler"), element->sampler, model.samplers, "samplers");
    texture.wrap_s = wrap_of(sampler.member("wrapS"), sampler->wrapS);
    texture.wrap_t = wrap_of(sampler.member("wrapT"), sampler->wrapT);
    texture.nearest = is_nearest(sampler.member("magFilter"), sampler->magFilter);
  }
  Image image = decode_image(source, kMostTexels - texel_count_);
  texel_count_ += image.texels.size();
  texture.width = image.width;
  texture.height = image.height;
  texture.texels = std::move(image.texels);
  return texture;
}

std::optional<std::uint32_t> MaterialReader::read_texture(
    const Element<tinygltf::TextureInfo>& info) {
  const auto element = follow(info.member("index"), info->index, info.model().textures, "textures");
  if (info->texCoord != 0) {
    info.warn("texCoord", "textures that use another set than TEXCOORD_0 are ignored");
    return std::nullopt;
  }
  if (element->source == -1) {
    element.warn("texture source", "a texture without a PNG or JPEG source is ignored");
    return std::nullopt;
  }
  const auto known = textures_by_index_.find(info->index);
  if (known != textures_by_index_.end()) return known->second;
  textures_.push_back(decode_texture(element));
  const auto position = static_cast<std::uint32_t>(textures_.size() - 1);
  textures_by_index_.emplace(info->index, position);
  return position;
}

void MaterialReader::read_metallic_roughness(const MaterialElement& element, Material& material) {
  const tinygltf::PbrMetallicRoughness& pbr = element->pbrMetallicRoughness;
  const Place place = element.member("pbrMetallicRoughness");
  std::array<float, 4> base{};
  place.member("baseColorFactor").clamped(pbr.baseColorFactor, base, 0.0, 1.0);
  material.base_color = {base[0], base[1], base[2]};
  material.metallic =
      static_cast<float>(place.member("metallicFactor").clamped(pbr.metallicFactor, 0.0, 1.0));
  material.roughness =
      static_cast<float>(place.member("roughnessFactor").clamped(pbr.roughnessFactor, 0.0, 1.0));
  if (pbr.baseColorTexture.index != -1) {
    if (const auto texture =
            read_texture({place.member("baseColorTexture"), pbr.baseColorTexture})) {
      material.base_color_texture = TextureUse{*texture, 0, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    }
  }
  warn_of_member(place, "metallicRoughnessTexture", pbr.metallicRoughnessTexture.index != -1);
}

Material MaterialReader::read(const MaterialElement& element, double length_scale) {
  Material material;
  material.name = element.name();
  read_metallic_roughness(element, material);
  read_emission(element, material);
  read_specular(element, material);
  read_ior(element, material);
  read_transmission(element, material);
  read_volume(element, material, length_scale);
  material.double_sided = element->doubleSided;
  warn_of_unread(element);
  return material;
}

}  // namespace ppm::scene::gltf
