// Saving and restoring a rendering between two passes.
#include <cstring>
#include <type_traits>

#include "failure.hpp"
#include "ppm.hpp"

namespace ppm::render {
namespace {

// Everything else follows from scene and settings: geometry of hit points by tracing the eye paths
// again, photons by their numbers.
struct Header {
  std::uint64_t fingerprint;
  std::uint64_t passes, photons_emitted, photons_stored;
  std::uint64_t hit_points;
};

class Hash {  // FNV-1a, 64 bits
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3ull;
  }
  template <class T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    add(&value, sizeof value);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

void append(SavedState& state, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  state.insert(state.end(), bytes, bytes + size);
}

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

[[noreturn]] void refuse(const char* why) {
  throw Failure("", "saved state", why, "resume with the scene and options it was saved with");
}

}  // namespace

std::uint64_t PpmIntegrator::fingerprint() const {
  Hash hash;
  hash.add(settings_.width);
  hash.add(settings_.height);
  hash.add(settings_.photons_per_pass);
  hash.add(settings_.alpha);
  hash.add(static_cast<std::uint32_t>(settings_.radius_mode));
  hash.add(settings_.radius);
  hash.add(settings_.samples_per_pixel);
  hash.add(static_cast<std::uint32_t>(settings_.filter));
  hash.add(&buffers_.constants(),
           sizeof(shared::SceneConstants));  // camera, seed, depth, lights' power
  PPM_ASSERT(!scene_.triangles.empty(), "the scene's arrays were released");
  for (const scene::Triangle& triangle : scene_.triangles) {
    for (const scene::Corner& corner : triangle.corners) hash.add(&corner, sizeof corner);
    hash.add(triangle.material);
  }
  for (const scene::TriangleDetail& detail : scene_.details) hash.add(&detail, sizeof detail);
  for (const scene::Material& material : scene_.materials) add(hash, material);
  for (const scene::Texture& texture : scene_.textures) add(hash, texture);
  for (const scene::PunctualLight& light : scene_.punctual_lights) add(hash, light);
  if (scene_.environment) {
    for (const glm::vec3& texel : scene_.environment->texels) hash.add(&texel, sizeof texel);
  }
  return hash.value();
}

SavedState PpmIntegrator::save_state() {
  SavedState state;
  const Header header{fingerprint(), statistics_.passes, statistics_.photons_emitted,
                      statistics_.photons_stored, statistics_.hit_points};
  append(state, &header, sizeof header);
  for (const HitTile& tile : tiles_) {
    // In canonical order and without a mark between tiles: how the picture is cut into tiles may
    // differ when the rendering goes on.
    const auto statistics = tile.statistics.download<glm::vec4>(tile.hits);
    const auto counts = tile.photon_counts.download<std::uint32_t>(tile.hits);
    for (const std::uint32_t i : tile.order.download<std::uint32_t>(tile.hits)) {
      append(state, &statistics[i], sizeof statistics[i]);
      append(state, &counts[i], sizeof counts[i]);
    }
  }
  return state;
}

void PpmIntegrator::restore_state(const SavedState& state) {
  constexpr std::size_t kRecord = sizeof(glm::vec4) + sizeof(std::uint32_t);
  Header header;
  if (state.size() < sizeof header) refuse("truncated");
  std::memcpy(&header, state.data(), sizeof header);
  if (header.fingerprint != fingerprint()) refuse("of another scene or other options");
  if (state.size() != sizeof header + header.hit_points * kRecord) refuse("truncated");
  trace_eye_paths([] { return false; });
  if (statistics_.hit_points != header.hit_points) refuse("of another device or program");

  const std::uint8_t* next = state.data() + sizeof header;
  for (HitTile& tile : tiles_) {
    std::vector<glm::vec4> statistics(tile.hits);
    std::vector<std::uint32_t> counts(tile.hits);
    for (const std::uint32_t i : tile.order.download<std::uint32_t>(tile.hits)) {
      std::memcpy(&statistics[i], next, sizeof statistics[i]);
      std::memcpy(&counts[i], next + sizeof statistics[i], sizeof counts[i]);
      next += kRecord;
    }
    tile.statistics.upload(std::span<const glm::vec4>(statistics));
    tile.photon_counts.upload(std::span<const std::uint32_t>(counts));
  }
  estimator_.prepare_searches(tiles_);
  statistics_.passes = header.passes;
  statistics_.photons_emitted = header.photons_emitted;
  statistics_.photons_stored = header.photons_stored;
}

}  // namespace ppm::render
