#include "scene_buffers.hpp"

#include <chrono>
#include <cmath>

#include "failure.hpp"
#include "light_table.hpp"
#include "shared/bindings.h"
#include "shared/geometry.h"
#include "texture_records.hpp"

namespace ppm::render {
namespace {

// Ends paths that no random choice would: light caught between surfaces that absorb nothing. Every
// path it cuts is counted.
constexpr std::uint32_t kPhotonBounceCap = 1024;
constexpr std::uint32_t kEyeBounceCap = 250;  // a hit point keeps its count in 8 bits
constexpr float kDensest = 1e6f;
constexpr std::size_t kMaxMaterials = 65535;  // a path keeps its medium in 16 bits

shared::MaterialRecord material_record(const scene::Material& material) {
  shared::MaterialRecord record{};
  record.base_color = material.base_color;
  record.metallic = material.metallic;
  record.roughness = material.roughness;
  record.transmission = material.transmission;
  // 0: as if infinitely dense (KHR_materials_ior); the reflectance below is 1 then.
  record.ior = material.ior == 0.0f ? kDensest : material.ior;
  // KHR_materials_specular, section "Implementation".
  const float base = (material.ior - 1.0f) / (material.ior + 1.0f);
  record.specular_f0 = base * base * material.specular_color;
  record.specular = material.specular;
  record.emission = material.emission;
  record.flags = (material.double_sided ? PPM_MATERIAL_DOUBLE_SIDED : 0u) |
                 (material.solid ? PPM_MATERIAL_SOLID : 0u) |
                 (material.alpha_mode == scene::AlphaMode::mask ? PPM_MATERIAL_MASK : 0u) |
                 (material.alpha_mode == scene::AlphaMode::blend ? PPM_MATERIAL_BLEND : 0u) |
                 (material.unlit ? PPM_MATERIAL_UNLIT : 0u);
  record.alpha = material.alpha;
  record.alpha_cutoff = material.alpha_cutoff;
  record.normal_scale = material.normal_scale;
  record.clearcoat = material.clearcoat;
  record.clearcoat_roughness = material.clearcoat_roughness;
  record.clearcoat_normal_scale = material.clearcoat_normal_scale;
  record.dispersion = material.dispersion;
  if (material.solid && std::isfinite(material.attenuation_distance)) {
    // Transmittance attenuation_color after attenuation_distance; a channel of 0 lets next to
    // nothing through.
    record.absorption = -glm::log(glm::max(material.attenuation_color, glm::vec3(1e-30f))) /
                        material.attenuation_distance;
  }
  return record;
}

shared::TriangleShading shading_record(const scene::Triangle& triangle) {
  const auto color = [](const glm::vec4& c) {
    return glm::uvec2(glm::packUnorm2x16(glm::vec2(c.x, c.y)),
                      glm::packUnorm2x16(glm::vec2(c.z, c.w)));
  };
  const auto& corners = triangle.corners;
  shared::TriangleShading record{};
  record.normal0 = shared::pack_direction(corners[0].normal);
  record.normal1 = shared::pack_direction(corners[1].normal);
  record.normal2 = shared::pack_direction(corners[2].normal);
  record.material = triangle.material;
  record.texcoord0 = corners[0].texcoord;
  record.texcoord1 = corners[1].texcoord;
  record.texcoord2 = corners[2].texcoord;
  record.color0 = color(corners[0].color);
  record.color1 = color(corners[1].color);
  record.color2 = color(corners[2].color);
  return record;
}

shared::SceneConstants camera_constants(const Settings& settings) {
  const scene::Camera& camera = settings.camera;
  shared::SceneConstants constants{};
  constants.camera_position = camera.position;
  constants.camera_right = camera.right;
  constants.camera_up = camera.up;
  constants.camera_forward = camera.forward;
  constants.camera_kind = camera.ymag ? PPM_CAMERA_ORTHOGRAPHIC : PPM_CAMERA_PERSPECTIVE;
  const double tan_half_y = camera.ymag ? *camera.ymag : std::tan(0.5 * camera.yfov);
  constants.camera_tan_half_y = static_cast<float>(tan_half_y);
  constants.camera_tan_half_x = static_cast<float>(tan_half_y * settings.width / settings.height);
  constants.width = settings.width;
  constants.height = settings.height;
  constants.seed = settings.seed;
  constants.max_depth = settings.max_depth;
  constants.photon_bounce_cap = kPhotonBounceCap;
  constants.eye_bounce_cap = kEyeBounceCap;
  return constants;
}

template <class Record>
gpu::Buffer texel_buffer(gpu::Device& device, const char* name,
                         const std::vector<Record>& records) {
  return gpu::make_buffer(device, name, std::span<const Record>(records), gpu::Usage::texels);
}

}  // namespace

SceneBuffers::SceneBuffers(const scene::Scene& scene, const Settings& settings, gpu::Device& device,
                           unsigned threads)
    : constants_(camera_constants(settings)) {
  if (scene.materials.size() > kMaxMaterials) {
    throw Failure(scene.file, "materials",
                  std::to_string(scene.materials.size()) + " materials are more than 65535",
                  "merge materials");
  }
  const auto start = std::chrono::steady_clock::now();
  const bvh::Bvh bvh = bvh::build(scene.triangles, threads);
  bvh_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const glm::vec3 centre = 0.5f * (scene.bounds_min + scene.bounds_max);
  // A hair more than half the diagonal, so that rounding leaves no corner outside.
  const float radius = 0.5f * glm::length(scene.bounds_max - scene.bounds_min) * 1.00001f;
  const LightTable lights = make_light_table(scene, bvh.triangle_order, centre, radius);
  total_power_ = lights.total_power;
  constants_.grid_origin = bvh.grid_origin;
  constants_.grid_step = bvh.grid_step;
  constants_.bounding_centre = centre;
  constants_.bounding_radius = radius;
  constants_.light_count = static_cast<std::uint32_t>(lights.records.size());
  constants_.total_power = static_cast<float>(lights.total_power);

  std::vector<shared::TrianglePositions> positions;
  std::vector<shared::TriangleShading> shading;
  positions.reserve(bvh.triangle_order.size());
  shading.reserve(bvh.triangle_order.size());
  for (const std::uint32_t index : bvh.triangle_order) {
    const scene::Triangle& triangle = scene.triangles[index];
    const bool is_opaque =
        scene.materials[triangle.material].alpha_mode == scene::AlphaMode::opaque;
    positions.push_back({triangle.corners[0].position,
                         triangle.material | (is_opaque ? 0u : PPM_HAS_COVERAGE),
                         triangle.corners[1].position, 0, triangle.corners[2].position, 0});
    shading.push_back(shading_record(triangle));
  }
  std::vector<shared::MaterialRecord> materials;
  std::vector<shared::TextureUse> uses;
  for (const scene::Material& material : scene.materials) {
    materials.push_back(material_record(material));
    add_texture_uses(material, materials.back(), uses);
  }

  const TextureRecords textures = make_texture_records(scene);

  constants_buffer_ = gpu::make_buffer(device, "scene constants",
                                       std::span<const shared::SceneConstants>(&constants_, 1),
                                       gpu::Usage::uniform);
  nodes_ = texel_buffer(device, "BVH nodes", bvh.nodes);
  positions_ = texel_buffer(device, "triangle positions", positions);
  shading_ = texel_buffer(device, "triangle shading", shading);
  materials_ = texel_buffer(device, "materials", materials);
  textures_ = texel_buffer(device, "textures", textures.records);
  texels_ = texel_buffer(device, "texture texels", textures.texels);
  texture_uses_ = texel_buffer(device, "texture uses", uses);
  details_ = texel_buffer(device, "triangle details", make_details(scene, bvh.triangle_order));
  lights_ = texel_buffer(device, "lights", lights.records);
}

void SceneBuffers::bind(gpu::BindingTable& table) const {
  table.set(PPM_BIND_SCENE_CONSTANTS, constants_buffer_);
  table.set(PPM_BIND_BVH_NODES, nodes_);
  table.set(PPM_BIND_TRIANGLE_POSITIONS, positions_);
  table.set(PPM_BIND_TRIANGLE_SHADING, shading_);
  table.set(PPM_BIND_MATERIALS, materials_);
  table.set(PPM_BIND_TEXTURES, textures_);
  table.set(PPM_BIND_TEXTURE_TEXELS, texels_);
  table.set(PPM_BIND_TEXTURE_USES, texture_uses_);
  table.set(PPM_BIND_TRIANGLE_DETAILS, details_);
  table.set(PPM_BIND_LIGHTS, lights_);
}

}  // namespace ppm::render
