// Photons and hit points made by a test instead of by tracing, as the searches read them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "buffer.hpp"
#include "estimator.hpp"
#include "hit_tile.hpp"
#include "kernel.hpp"
#include "shared/bsdf_record.h"
#include "shared/layout.h"
#include "shared/photon.h"

namespace ppm::tests {

/// A hit point facing +z, seen from +z, on a white Lambertian surface.
struct SyntheticHit {
  glm::vec3 position{0.0f};
  float radius2 = 0.0f;  ///< or what stands in its place before the first radius is found
};

/// A photon that arrives from +z on a surface facing +z.
inline shared::Photon photon_at(glm::vec3 position, glm::vec3 flux = glm::vec3(1.0f)) {
  return {position, glm::vec3(0.0f, 0.0f, 1.0f), flux, glm::vec3(0.0f, 0.0f, 1.0f), 0};
}

/// One pixel a hit point.
inline render::HitTile make_tile(gpu::Device& device, std::span<const SyntheticHit> hits) {
  const std::uint32_t up = shared::pack_direction(glm::vec3(0.0f, 0.0f, 1.0f));
  shared::Bsdf bsdf{};
  bsdf.diffuse.albedo = glm::vec3(1.0f);
  glm::uvec4 words;
  std::uint32_t extra = 0;
  shared::pack_bsdf(bsdf, words, extra);
  std::array<std::vector<glm::uvec4>, 4> planes;
  std::vector<glm::vec4> statistics;
  std::vector<std::uint32_t> starts;
  const auto bits = [](float x) { return glm::floatBitsToUint(x); };
  for (const SyntheticHit& hit : hits) {
    const auto index = static_cast<std::uint32_t>(starts.size());
    planes[0].push_back({bits(hit.position.x), bits(hit.position.y), bits(hit.position.z), up});
    planes[1].push_back({up, up, index, 0});
    planes[2].push_back({bits(1.0f), bits(1.0f), bits(1.0f), extra});
    planes[3].push_back(words);
    statistics.push_back({0.0f, 0.0f, 0.0f, hit.radius2});
    starts.push_back(index);
  }
  starts.push_back(static_cast<std::uint32_t>(hits.size()));

  const auto upload = [&](const char* name, const auto& values) {
    return gpu::make_buffer(device, name, std::span(values), gpu::Usage::storage_and_texels);
  };
  using Words = std::span<const glm::uvec4>;
  render::HitTile tile;
  tile.pixels = tile.hits = static_cast<std::uint32_t>(hits.size());
  tile.max_pixel_hits = 1;
  tile.planes = {upload("hits 0", Words(planes[0])), upload("hits 1", Words(planes[1])),
                 upload("hits 2", Words(planes[2])), upload("hits 3", Words(planes[3])),
                 gpu::Buffer(device, "hits 4", 16, gpu::Usage::storage_and_texels)};
  tile.statistics = upload("statistics", std::span<const glm::vec4>(statistics));
  tile.sample_start = upload("starts", std::span<const std::uint32_t>(starts));
  tile.order = upload("order", std::span<const std::uint32_t>(starts));
  const std::vector<std::uint32_t> counts(hits.size(), 0);
  const std::vector<shared::GatherSum> sums(hits.size());
  tile.photon_counts = upload("counts", std::span<const std::uint32_t>(counts));
  tile.sums = upload("sums", std::span<const shared::GatherSum>(sums));
  return tile;
}

/// Photons on the device, bound as the grid reads them.
class PhotonBuffers {
 public:
  PhotonBuffers(gpu::Device& device, std::span<const shared::Photon> photons) {
    std::vector<glm::uvec4> position, flux;
    for (const shared::Photon& photon : photons) {
      position.push_back(shared::pack_photon_position(photon));
      flux.push_back(shared::pack_photon_flux(photon));
    }
    position_ = gpu::make_buffer(device, "photons", std::span<const glm::uvec4>(position),
                                 gpu::Usage::storage_and_texels);
    flux_ = gpu::make_buffer(device, "fluxes", std::span<const glm::uvec4>(flux),
                             gpu::Usage::storage_and_texels);
    table_.set(PPM_BIND_PHOTON_POSITION, position_);
    table_.set(PPM_BIND_PHOTON_FLUX, flux_);
  }
  const gpu::BindingTable& table() const { return table_; }

 private:
  gpu::Buffer position_, flux_;
  gpu::BindingTable table_;
};

/// An estimator for tiles of at most `tile_hits` synthetic hit points.
class SyntheticEstimator {
 public:
  SyntheticEstimator(gpu::Device& device, std::uint64_t tile_hits, std::uint32_t max_depth = 0)
      : constants_(make_constants(device, max_depth)), estimator_(device, table(), {}, tile_hits) {}

  render::Estimator* operator->() { return &estimator_; }

 private:
  static gpu::Buffer make_constants(gpu::Device& device, std::uint32_t max_depth) {
    shared::SceneConstants constants{};
    constants.max_depth = max_depth;
    return gpu::make_buffer(device, "scene constants",
                            std::span<const shared::SceneConstants>(&constants, 1),
                            gpu::Usage::uniform);
  }
  gpu::BindingTable table() const {
    gpu::BindingTable table;
    table.set(PPM_BIND_SCENE_CONSTANTS, constants_);
    return table;
  }

  gpu::Buffer constants_;
  render::Estimator estimator_;
};

}  // namespace ppm::tests
