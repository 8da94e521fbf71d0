#include "gltf_material.hpp"

#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace ppm::scene::gltf {
namespace {

constexpr double kLargestFactor = 1e20;  // for factors without an upper limit: products stay finite
constexpr double kLargestIor = 1e3;
constexpr double kLargestPriority = 1e6;

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

void read_alpha(const MaterialElement& element, Material& material) {
  const Place mode = element.member("alphaMode");
  if (element->alphaMode == "MASK") {
    material.alpha_mode = AlphaMode::mask;
  } else if (element->alphaMode == "BLEND") {
    material.alpha_mode = AlphaMode::blend;
  } else if (element->alphaMode != "OPAQUE") {
    mode.warn("alphaMode", "alphaMode " + printable(element->alphaMode) + " is rendered as OPAQUE");
  }
  material.alpha_cutoff = static_cast<float>(
      element.member("alphaCutoff").clamped(element->alphaCutoff, 0.0, kLargestFactor));
}

/// KHR_materials_unlit: the eye sees the base colour. Nothing else of the material counts.
void read_unlit(const MaterialElement& element, Material& material) {
  if (!extension_of(element, "KHR_materials_unlit")) return;
  material.unlit = true;
  material.emission = glm::vec3(0.0f);
  material.emissive_texture.reset();
  material.normal_texture.reset();
  material.metallic_roughness_texture.reset();
  material.metallic = 0.0f;
  material.specular = 0.0f;
  material.transmission = 0.0f;
  material.clearcoat = 0.0f;
  material.solid = false;
}

void read_ior(const MaterialElement& element, Material& material) {
  const auto extension = extension_of(element, "KHR_materials_ior");
  if (!extension) return;
  // 0 stands for the reflectance of infinitely dense matter, which KHR_materials_specular then
  // colours as it likes.
  if (extension->number("ior") == 0.0) {
    material.ior = 0.0f;
  } else {
    material.ior = extension->factor("ior", 1.5, 1.0, kLargestIor);
  }
}

void read_dispersion(const MaterialElement& element, Material& material) {
  const auto extension = extension_of(element, "KHR_materials_dispersion");
  if (extension) material.dispersion = extension->factor("dispersion", 0.0, 0.0, kLargestIor);
}

/// `extras.priority`, ours: which of two media that overlap counts.
void read_priority(const MaterialElement& element, Material& material) {
  if (!element->extras.IsObject() || !element->extras.Has("priority")) return;
  const tinygltf::Value& value = element->extras.Get("priority");
  const Place place = element.member("extras.priority");
  if (!value.IsNumber()) {
    place.warn("priority", "is not a number and was ignored");
    return;
  }
  material.priority = static_cast<int>(
      std::lround(place.clamped(value.GetNumberAsDouble(), -kLargestPriority, kLargestPriority)));
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

}  // namespace

void MaterialReader::read_metallic_roughness(const MaterialElement& element, Material& material) {
  const tinygltf::PbrMetallicRoughness& pbr = element->pbrMetallicRoughness;
  const Place place = element.member("pbrMetallicRoughness");
  std::array<float, 4> base{};
  place.member("baseColorFactor").clamped(pbr.baseColorFactor, base, 0.0, 1.0);
  material.base_color = {base[0], base[1], base[2]};
  material.alpha = base[3];
  material.metallic =
      static_cast<float>(place.member("metallicFactor").clamped(pbr.metallicFactor, 0.0, 1.0));
  material.roughness =
      static_cast<float>(place.member("roughnessFactor").clamped(pbr.roughnessFactor, 0.0, 1.0));
  material.base_color_texture =
      textures_.read({place.member("baseColorTexture"), pbr.baseColorTexture}, Content::colors);
  material.metallic_roughness_texture = textures_.read(
      {place.member("metallicRoughnessTexture"), pbr.metallicRoughnessTexture}, Content::data);
}

void MaterialReader::read_normals(const MaterialElement& element, Material& material) {
  const Element info(element.member("normalTexture"), element->normalTexture);
  material.normal_texture = textures_.read(info, Content::data);
  material.normal_scale =
      static_cast<float>(info.member("scale").clamped(info->scale, -kLargestIor, kLargestIor));
  warn_of_member(element, "occlusionTexture", element->occlusionTexture.index != -1);
}

void MaterialReader::read_emission(const MaterialElement& element, Material& material) {
  element.member("emissiveFactor")
      .clamped(element->emissiveFactor, components(material.emission), 0.0, 1.0);
  if (const auto extension = extension_of(element, "KHR_materials_emissive_strength")) {
    material.emission *= extension->factor("emissiveStrength", 1.0, 0.0, kLargestFactor);
  }
  if (material.emission == glm::vec3(0.0f)) return;
  material.emissive_texture = textures_.read(
      {element.member("emissiveTexture"), element->emissiveTexture}, Content::colors);
}

void MaterialReader::read_specular(const MaterialElement& element, Material& material) {
  const auto extension = extension_of(element, "KHR_materials_specular");
  if (!extension) return;
  material.specular = extension->factor("specularFactor", 1.0, 0.0, 1.0);
  extension->factors("specularColorFactor", components(material.specular_color), 0.0,
                     kLargestFactor);
  material.specular_texture = textures_.read(*extension, "specularTexture", Content::data);
  material.specular_color_texture =
      textures_.read(*extension, "specularColorTexture", Content::colors);
}

void MaterialReader::read_transmission(const MaterialElement& element, Material& material) {
  const auto extension = extension_of(element, "KHR_materials_transmission");
  if (!extension) return;
  material.transmission = extension->factor("transmissionFactor", 0.0, 0.0, 1.0);
  if (material.transmission == 0.0f) return;
  material.transmission_texture = textures_.read(*extension, "transmissionTexture", Content::data);
}

void MaterialReader::read_clearcoat(const MaterialElement& element, Material& material) {
  const auto extension = extension_of(element, "KHR_materials_clearcoat");
  if (!extension) return;
  material.clearcoat = extension->factor("clearcoatFactor", 0.0, 0.0, 1.0);
  if (material.clearcoat == 0.0f) return;
  material.clearcoat_roughness = extension->factor("clearcoatRoughnessFactor", 0.0, 0.0, 1.0);
  material.clearcoat_texture = textures_.read(*extension, "clearcoatTexture", Content::data);
  material.clearcoat_roughness_texture =
      textures_.read(*extension, "clearcoatRoughnessTexture", Content::data);
  warn_of_member(*extension, "clearcoatNormalTexture", extension->has("clearcoatNormalTexture"));
}

Material MaterialReader::read(const MaterialElement& element, double length_scale) {
  Material material;
  material.name = element.name();
  read_metallic_roughness(element, material);
  read_alpha(element, material);
  read_normals(element, material);
  read_emission(element, material);
  read_specular(element, material);
  read_ior(element, material);
  read_transmission(element, material);
  read_volume(element, material, length_scale);
  read_dispersion(element, material);
  read_clearcoat(element, material);
  read_priority(element, material);
  read_unlit(element, material);
  material.double_sided = element->doubleSided;
  return material;
}

}  // namespace ppm::scene::gltf
