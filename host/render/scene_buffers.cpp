#include "scene_buffers.hpp"

#include <cmath>

#include "failure.hpp"
#include "light_table.hpp"
#include "media.hpp"
#include "media_table.hpp"
#include "ppm_shaders.hpp"
#include "record_upload.hpp"
#include "shared/bindings.h"
#include "shared/geometry.h"
#include "stopwatch.hpp"
#include "texture_records.hpp"

namespace ppm::render {
namespace {

// Ends paths that no random choice would: light caught between surfaces that absorb nothing. Every
// path it cuts is counted.
constexpr std::uint32_t kPhotonBounceCap = 1024;
constexpr std::uint32_t kEyeBounceCap = 250;  // a hit point keeps its count in 8 bits

shared::MaterialRecord material_record(const scene::Material& material) {
  shared::MaterialRecord record{};
  record.base_color = material.base_color;
  record.metallic = material.metallic;
  record.roughness = material.roughness;
  record.transmission = material.transmission;
  // 0: as if infinitely dense (KHR_materials_ior); the reflectance below is 1 then.
  record.ior = scene::index_of(material);
  // KHR_materials_specular, section "Implementation".
  const float base = (material.ior - 1.0f) / (material.ior + 1.0f);
  record.specular_f0 = base * base * material.specular_color;
  record.specular = material.specular;
  record.emission = material.emission;
  record.flags = (material.double_sided ? PPM_MATERIAL_DOUBLE_SIDED : 0u) |
                 (material.solid ? PPM_MATERIAL_SOLID : 0u) |
                 (material.alpha_mode == scene::AlphaMode::mask ? PPM_MATERIAL_MASK : 0u) |
                 (material.alpha_mode == scene::AlphaMode::blend ? PPM_MATERIAL_BLEND : 0u) |
                 (material.unlit ? PPM_MATERIAL_UNLIT : 0u) |
                 (material.emission != glm::vec3(0.0f) ? PPM_MATERIAL_EMITS : 0u);
  record.alpha = material.alpha;
  record.alpha_cutoff = material.alpha_cutoff;
  record.normal_scale = material.normal_scale;
  record.clearcoat = material.clearcoat;
  record.clearcoat_roughness = material.clearcoat_roughness;
  return record;
}

shared::TrianglePositions position_record(const scene::Scene& scene,
                                          const scene::Triangle& triangle,
                                          float light_probability) {
  const bool is_opaque = scene.materials[triangle.material].alpha_mode == scene::AlphaMode::opaque;
  const auto& corners = triangle.corners;
  return {corners[0].position, triangle.material | (is_opaque ? 0u : PPM_HAS_COVERAGE),
          corners[1].position, light_probability,
          corners[2].position, 0};
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

void set_camera(shared::SceneConstants& constants, const Settings& settings) {
  const scene::Camera& camera = settings.camera;
  constants.camera_position = camera.position;
  constants.camera_right = camera.right;
  constants.camera_up = camera.up;
  constants.camera_forward = camera.forward;
  constants.camera_kind = camera.ymag ? PPM_CAMERA_ORTHOGRAPHIC : PPM_CAMERA_PERSPECTIVE;
  const double tan_half_y = camera.ymag ? *camera.ymag : std::tan(0.5 * camera.yfov);
  constants.camera_tan_half_y = static_cast<float>(tan_half_y);
  constants.camera_tan_half_x = static_cast<float>(tan_half_y * settings.width / settings.height);
}

shared::SceneConstants constants_of(const Settings& settings) {
  shared::SceneConstants constants{};
  set_camera(constants, settings);
  constants.width = settings.width;
  constants.height = settings.height;
  constants.seed = settings.seed;
  constants.max_depth = settings.max_depth;
  constants.photon_bounce_cap = kPhotonBounceCap;
  constants.eye_bounce_cap = kEyeBounceCap;
  return constants;
}

/// By leaf slot, with which each triangle is chosen as a light; 0 for those that are none.
std::vector<float> light_probabilities(const LightTable& lights, std::size_t triangles) {
  std::vector<float> result(triangles, 0.0f);
  for (const shared::LightRecord& light : lights.records) {
    if (light.kind == PPM_LIGHT_TRIANGLE) result[light.triangle] = light.probability;
  }
  return result;
}

template <class Record>
gpu::Buffer texel_buffer(gpu::Device& device, const char* name,
                         const std::vector<Record>& records) {
  return gpu::make_buffer(device, name, std::span<const Record>(records), gpu::Usage::texels);
}

}  // namespace

bool may_need_segments(const scene::Scene& scene, gpu::SegmentSize size) {
  // Of a triangle no buffer holds more than a record of shading, a light or a node of the tree has.
  static_assert(sizeof(shared::BvhNode) <= 64 && sizeof(shared::LightRecord) <= 64);
  const std::uint64_t most = 64 * (scene.triangles.size() + scene.punctual_lights.size());
  std::uint64_t texels = 0;
  for (const scene::Texture& texture : scene.textures) texels += texel_bytes(texture);
  return std::max(most, texels) > size.bytes();
}

SceneBuffers::SceneBuffers(const scene::Scene& scene, const Settings& settings, gpu::Device& device,
                           unsigned threads)
    : segment_(gpu::segment_size(device, settings.segment_bytes)),
      constants_(constants_of(settings)) {
  const MediaTable media = make_media_table(scene);
  const double start = clock_seconds();
  bvh::Bvh bvh = bvh::build(scene.triangles, threads);
  const double built = clock_seconds();
  bvh_seconds_ = built - start;

  const glm::vec3 centre = 0.5f * (scene.bounds_min + scene.bounds_max);
  // A hair more than half the diagonal, so that rounding leaves no corner outside.
  const float radius = 0.5f * glm::length(scene.bounds_max - scene.bounds_min) * 1.00001f;
  const EnvironmentTable environment =
      scene.environment ? make_environment_table(*scene.environment) : EnvironmentTable{};
  const LightTable lights =
      make_light_table(scene, bvh.triangle_order, centre, radius, environment);
  total_power_ = lights.total_power;
  constants_.grid_origin = bvh.grid_origin;
  constants_.grid_step = bvh.grid_step;
  constants_.bounding_centre = centre;
  constants_.bounding_radius = radius;
  constants_.light_count = static_cast<std::uint32_t>(lights.records.size());
  constants_.total_power = static_cast<float>(lights.total_power);
  constants_.environment_width = environment.shape.width;
  constants_.environment_height = environment.shape.height;
  constants_.environment_turn = environment.shape.turn;
  constants_.environment_pdf_scale = environment.shape.pdf_scale;

  std::vector<shared::MaterialRecord> materials;
  std::vector<shared::TextureUse> uses;
  for (const scene::Material& material : scene.materials) {
    materials.push_back(material_record(material));
    add_texture_uses(material, materials.back(), uses);
    materials.back().medium = media.of_material[materials.size() - 1];
  }

  constants_buffer_ = gpu::make_buffer(device, "scene constants",
                                       std::span<const shared::SceneConstants>(&constants_, 1),
                                       gpu::Usage::uniform);
  materials_ = texel_buffer(device, "materials", materials);
  texture_uses_ = texel_buffer(device, "texture uses", uses);
  lights_ = upload_records(device, "lights", lights.records, segment_);
  nodes_ = upload_records(device, "BVH nodes", bvh.nodes, segment_);
  bvh.nodes = {};
  upload_triangles(scene, bvh.triangle_order,
                   light_probabilities(lights, bvh.triangle_order.size()), device, threads);
  upload_textures(scene, device);
  environment_ = texel_buffer(device, "environment", environment.texels);
  media_ = texel_buffer(device, "media", media.records);
  light_media_ = gpu::Buffer(device, "media of lights", (lights.records.size() + 1) * 4,
                             gpu::Usage::storage_and_texels);
  find_start_media(device, traits_of(scene));
  upload_seconds_ = clock_seconds() - built;
}

void SceneBuffers::look_from(const Settings& settings, const SceneTraits& traits,
                             gpu::Device& device) {
  set_camera(constants_, settings);
  constants_buffer_.upload(std::span<const shared::SceneConstants>(&constants_, 1));
  find_start_media(device, traits);
}

void SceneBuffers::upload_triangles(const scene::Scene& scene, std::span<const std::uint32_t> order,
                                    std::span<const float> light_probabilities, gpu::Device& device,
                                    unsigned threads) {
  positions_ = upload_records<shared::TrianglePositions>(
      device, "triangle positions", order.size(), threads, segment_, [&](std::size_t slot) {
        return position_record(scene, scene.triangles[order[slot]], light_probabilities[slot]);
      });
  shading_ = upload_records<shared::TriangleShading>(
      device, "triangle shading", order.size(), threads, segment_,
      [&](std::size_t slot) { return shading_record(scene.triangles[order[slot]]); });
  details_ = upload_records<shared::TriangleDetail>(
      device, "triangle details", scene.details.size(), threads, segment_,
      [&](std::size_t slot) { return detail_record(scene.details[order[slot]]); });
}

void require_light(const scene::Scene& scene) {
  if (gives_off_light(scene)) return;
  throw Failure(scene.file, "", "nothing in the scene gives off light",
                "add a light or an emissive material to it, or give --env FILE.hdr");
}

void SceneBuffers::upload_textures(const scene::Scene& scene, gpu::Device& device) {
  const std::vector<shared::TextureRecord> records = make_texture_records(scene);
  textures_ = texel_buffer(device, "textures", records);
  std::uint64_t bytes = 0;
  for (const scene::Texture& texture : scene.textures) bytes += texel_bytes(texture);
  texels_ = gpu::SegmentedBuffer(device, "texture texels", bytes, segment_);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::span<const std::byte> data = texel_data(scene.textures[i]);
    texels_.upload(data.data(), data.size(), std::uint64_t{records[i].first} * sizeof(glm::uvec4));
  }
}

void SceneBuffers::add_segments(SceneTraits& traits) const {
  traits.segment_shift = segment_.shift;
  const auto add = [&](std::uint32_t binding, const gpu::SegmentedBuffer& buffer) {
    if (buffer.count() > 1) traits.segments[binding] = buffer.count();
  };
  add(PPM_BIND_BVH_NODES, nodes_);
  add(PPM_BIND_TRIANGLE_POSITIONS, positions_);
  add(PPM_BIND_TRIANGLE_SHADING, shading_);
  add(PPM_BIND_TRIANGLE_DETAILS, details_);
  add(PPM_BIND_TEXTURE_TEXELS, texels_);
  add(PPM_BIND_LIGHTS, lights_);
}

void SceneBuffers::find_start_media(gpu::Device& device, SceneTraits traits) {
  const std::uint64_t starts = std::uint64_t{constants_.light_count} + 1;
  if (!traits.media) {
    device.run([&](gpu::Recorder& recorder) { recorder.fill(light_media_, 0, starts * 4); });
    return;
  }
  add_segments(traits);
  const gpu::Kernel kernel =
      make_kernel(device, traits, shaders::start_media, shaders::start_media_plain);
  gpu::BindingTable table;
  bind(table);
  device.run([&](gpu::Recorder& recorder) {
    recorder.dispatch(kernel, table, shared::StartMediaPush{}, starts);
  });
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
  table.set(PPM_BIND_ENVIRONMENT, environment_);
  table.set(PPM_BIND_MEDIA, media_);
  table.set(PPM_BIND_LIGHT_MEDIA, light_media_);
}

}  // namespace ppm::render
