#include "fingerprint.hpp"

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
  for (const scene::OptionalTextureUse* use : texture_uses(material)) {
    add(hash, *use);
  }
  hash.add(material.normal_scale);
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

void add(Hash& hash, const scene::Environment& environment) {
  hash.add(environment.width);
  hash.add(environment.height);
  hash.add(environment.strength);
  hash.add(environment.rotation);
  for (const glm::vec3& texel : environment.texels) hash.add(&texel, sizeof texel);
}

}  // namespace

std::vector<PartHash> part_hashes(const scene::Scene& scene) {
  Hash frame, triangles, materials, textures, lights, environment;
  frame.add(&scene.frame.centre, sizeof scene.frame.centre);
  frame.add(scene.frame.scale);
  for (const scene::Triangle& triangle : scene.triangles) {
    for (const scene::Corner& corner : triangle.corners) triangles.add(&corner, sizeof corner);
    triangles.add(triangle.material);
  }
  for (const scene::TriangleDetail& detail : scene.details) triangles.add(&detail, sizeof detail);
  for (const scene::Material& material : scene.materials) add(materials, material);
  for (const scene::Texture& texture : scene.textures) add(textures, texture);
  for (const scene::PunctualLight& light : scene.punctual_lights) add(lights, light);
  environment.add(scene.environment.has_value());
  if (scene.environment) add(environment, *scene.environment);
  return {{"size and place", frame.value()},   {"triangles", triangles.value()},
          {"materials", materials.value()},    {"textures", textures.value()},
          {"punctual lights", lights.value()}, {"environment", environment.value()}};
}

void add_scene(Hash& hash, const scene::Scene& scene) {
  for (const PartHash& part : part_hashes(scene)) hash.add(part.value);
}

void add_camera(Hash& hash, const scene::Camera& camera) {
  for (const glm::dvec3* v : {&camera.position, &camera.right, &camera.up, &camera.forward}) {
    hash.add(v, sizeof *v);
  }
  hash.add(camera.name.data(), camera.name.size());
  hash.add(camera.yfov);
  hash.add(camera.ymag.has_value());
  hash.add(camera.ymag.value_or(0.0));
}

}  // namespace ppm::render
