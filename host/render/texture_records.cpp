#include "texture_records.hpp"

#include <cstring>

#include "failure.hpp"
#include "shared/geometry.h"

namespace ppm::render {
namespace {

constexpr std::size_t kRecordBytes = sizeof(glm::uvec4);
constexpr std::uint64_t kMostRecords = 0xffffffffu;

struct Bytes {
  const void* data;
  std::size_t size;
};

Bytes bytes_of(const scene::Texture& texture) {
  if (!texture.halves.empty()) {
    return {texture.halves.data(), texture.halves.size() * sizeof texture.halves[0]};
  }
  return {texture.rgba8.data(), texture.rgba8.size() * sizeof texture.rgba8[0]};
}

std::uint64_t records_of(const scene::Texture& texture) {
  return (bytes_of(texture).size + kRecordBytes - 1) / kRecordBytes;
}

std::uint32_t sampling_of(const scene::Texture& texture) {
  return static_cast<std::uint32_t>(texture.wrap_s) |
         (static_cast<std::uint32_t>(texture.wrap_t) << 2) |
         (texture.nearest ? PPM_TEXTURE_NEAREST : 0u) |
         (texture.halves.empty() ? 0u : PPM_TEXTURE_HALVES) |
         (texture.srgb ? PPM_TEXTURE_SRGB : 0u);
}

/// With the handedness in the lowest bit.
std::uint32_t pack_tangent(glm::vec4 tangent) {
  const glm::vec3 direction(tangent);
  const glm::vec3 unit = direction == glm::vec3(0.0f) ? glm::vec3(1.0f, 0.0f, 0.0f) : direction;
  return (shared::pack_direction(unit) & ~1u) | (tangent.w < 0.0f ? 1u : 0u);
}

}  // namespace

TextureRecords make_texture_records(const scene::Scene& scene) {
  std::uint64_t total = 0;
  for (const scene::Texture& texture : scene.textures) total += records_of(texture);
  if (total > kMostRecords) {
    throw Failure(scene.file, "textures", "more than 64 GiB in all", "scale textures down");
  }
  TextureRecords result;
  result.texels.reserve(total);
  for (const scene::Texture& texture : scene.textures) {
    const Bytes bytes = bytes_of(texture);
    const std::size_t first = result.texels.size();
    result.records.push_back(
        {texture.width, texture.height, static_cast<std::uint32_t>(first), sampling_of(texture)});
    result.texels.resize(first + records_of(texture));
    std::memcpy(result.texels.data() + first, bytes.data, bytes.size);
  }
  return result;
}

void add_texture_uses(const scene::Material& material, shared::MaterialRecord& record,
                      std::vector<shared::TextureUse>& uses) {
  record.first_use = static_cast<std::uint32_t>(uses.size());
  std::uint32_t which = PPM_USE_BASE_COLOR;
  for (const scene::OptionalTextureUse* use :
       {&material.base_color_texture, &material.metallic_roughness_texture,
        &material.normal_texture, &material.emissive_texture, &material.transmission_texture,
        &material.specular_texture, &material.specular_color_texture, &material.clearcoat_texture,
        &material.clearcoat_roughness_texture}) {
    if (*use) {
      record.use_mask |= which;
      uses.push_back({(*use)->row_s,
                      (*use)->texture | ((*use)->texcoord_set == 1 ? PPM_SECOND_TEXCOORD : 0u),
                      (*use)->row_t, 0});
    }
    which <<= 1;
  }
}

std::vector<shared::TriangleDetail> make_details(const scene::Scene& scene,
                                                 std::span<const std::uint32_t> order) {
  std::vector<shared::TriangleDetail> result;
  if (scene.details.empty()) return result;
  result.reserve(order.size());
  for (const std::uint32_t index : order) {
    const scene::TriangleDetail& detail = scene.details[index];
    shared::TriangleDetail record{};
    record.texcoord0 = detail[0].texcoord1;
    record.texcoord1 = detail[1].texcoord1;
    record.texcoord2 = detail[2].texcoord1;
    record.tangent0 = pack_tangent(detail[0].tangent);
    record.tangent1 = pack_tangent(detail[1].tangent);
    record.tangent2 = pack_tangent(detail[2].tangent);
    result.push_back(record);
  }
  return result;
}

}  // namespace ppm::render
