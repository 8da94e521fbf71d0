#include "fingerprint.hpp"

#include "failure.hpp"

namespace ppm::render {
namespace {

void add(Hash& hash, const scene::OptionalTextureUse& use) {
  hash.add(use.has_value());
  if (!use) return;
  hash.add(use->texture);
  hash.add(use->texcoord_set);
  hash.add(&use->row_s, sizeof use->row_s);
  hash.add(&use->row_t, sizeof use->row_t);
}

void add(Hash& hash, const scene::Material& material) {
  hash.add(&material.base_color, sizeof material.base_color);
  for (const scene::OptionalTextureUse* use :
       {&material.base_color_texture, &material.metallic_roughness_texture,
        &material.normal_texture, &material.emissive_texture, &material.transmission_texture,
        &material.specular_texture, &material.specular_color_texture, &material.clearcoat_texture,
        &material.clearcoat_roughness_texture, &material.clearcoat_normal_texture}) {
    add(hash, *use);
  }
  hash.add(material.normal_scale);
  hash.add(material.clearcoat_normal_scale);
  hash.add(static_cast<std::uint32_t>(material.alpha_mode));
  hash.add(material.alpha);
  hash.add(material.alpha_cutoff);
  hash.add(material.dispersion);
  hash.add(material.clearcoat);
  hash.add(material.clearcoat_roughness);
  hash.add(material.unlit);
  hash.add(material.priority);
  hash.add(material.metallic);
  hash.add(material.roughness);
  hash.add(material.specular);
  hash.add(&material.specular_color, sizeof material.specular_color);
  hash.add(material.ior);
  hash.add(material.transmission);
  hash.add(material.solid);
  hash.add(&material.attenuation_color, sizeof material.attenuation_color);
  hash.add(material.attenuation_distance);
  hash.add(&material.emission, sizeof material.emission);
  hash.add(material.double_sided);
}

void add(Hash& hash, const scene::Texture& texture) {
  hash.add(texture.width);
  hash.add(texture.height);
  hash.add(static_cast<std::uint32_t>(texture.wrap_s));
  hash.add(static_cast<std::uint32_t>(texture.wrap_t));
  hash.add(texture.nearest);
  hash.add(texture.srgb);
  hash.add(texture.rgba8.data(), texture.rgba8.size() * sizeof texture.rgba8[0]);
  hash.add(texture.halves.data(), texture.halves.size() * sizeof texture.halves[0]);
}

void add(Hash& hash, const scene::PunctualLight& light) {
  hash.add(static_cast<std::uint32_t>(light.kind));
  hash.add(&light.position, sizeof light.position);
  hash.add(&light.direction, sizeof light.direction);
  hash.add(&light.intensity, sizeof light.intensity);
  hash.add(light.inner_cone_angle);
  hash.add(light.outer_cone_angle);
  hash.add(light.range);
}

}  // namespace

void add_scene(Hash& hash, const scene::Scene& scene) {
  PPM_ASSERT(!scene.triangles.empty(), "the scene's arrays were released");
  for (const scene::Triangle& triangle : scene.triangles) {
    for (const scene::Corner& corner : triangle.corners) hash.add(&corner, sizeof corner);
    hash.add(triangle.material);
  }
  for (const scene::TriangleDetail& detail : scene.details) hash.add(&detail, sizeof detail);
  for (const scene::Material& material : scene.materials) add(hash, material);
  for (const scene::Texture& texture : scene.textures) add(hash, texture);
  for (const scene::PunctualLight& light : scene.punctual_lights) add(hash, light);
  if (scene.environment) {
    for (const glm::vec3& texel : scene.environment->texels) hash.add(&texel, sizeof texel);
  }
}

}  // namespace ppm::render
