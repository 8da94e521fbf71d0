#include "texture_records.hpp"

#include "failure.hpp"
#include "shared/geometry.h"

namespace ppm::render {
namespace {

constexpr std::size_t kRecordBytes = sizeof(glm::uvec4);
constexpr std::uint64_t kMostRecords = 0xffffffffu;

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

std::span<const std::byte> texel_data(const scene::Texture& texture) {
  return texture.halves.empty() ? std::as_bytes(std::span(texture.rgba8))
                                : std::as_bytes(std::span(texture.halves));
}

std::uint64_t texel_bytes(const scene::Texture& texture) {
  return (texel_data(texture).size() + kRecordBytes - 1) / kRecordBytes * kRecordBytes;
}

std::vector<shared::TextureRecord> make_texture_records(const scene::Scene& scene) {
  std::vector<shared::TextureRecord> records;
  std::uint64_t first = 0;
  for (const scene::Texture& texture : scene.textures) {
    records.push_back(
        {texture.width, texture.height, static_cast<std::uint32_t>(first), sampling_of(texture)});
    first += texel_bytes(texture) / kRecordBytes;
    if (first > kMostRecords) {
      throw Failure(scene.file, "textures", "more than 64 GiB in all", "scale textures down");
    }
  }
  return records;
}

void add_texture_uses(const scene::Material& material, shared::MaterialRecord& record,
                      std::vector<shared::TextureUse>& uses) {
  record.first_use = static_cast<std::uint32_t>(uses.size());
  std::uint32_t which = PPM_USE_BASE_COLOR;
  for (const scene::OptionalTextureUse* use : texture_uses(material)) {
    if (*use) {
      record.use_mask |= which;
      uses.push_back({(*use)->row_s,
                      (*use)->texture | ((*use)->texcoord_set == 1 ? PPM_SECOND_TEXCOORD : 0u),
                      (*use)->row_t, 0});
    }
    which <<= 1;
  }
}

shared::TriangleDetail detail_record(const scene::TriangleDetail& detail) {
  shared::TriangleDetail record{};
  record.texcoord0 = detail[0].texcoord1;
  record.texcoord1 = detail[1].texcoord1;
  record.texcoord2 = detail[2].texcoord1;
  record.tangent0 = pack_tangent(detail[0].tangent);
  record.tangent1 = pack_tangent(detail[1].tangent);
  record.tangent2 = pack_tangent(detail[2].tangent);
  return record;
}

}  // namespace ppm::render
