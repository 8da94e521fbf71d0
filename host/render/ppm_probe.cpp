// Reading a single hit point's statistics [HOJ08 Figure 4].
#include <algorithm>
#include <bit>
#include <cmath>

#include "ppm.hpp"
#include "shared/camera.h"

namespace ppm::render {
namespace {

/// Elements [first, first + count).
template <class T>
std::vector<T> download(const gpu::Buffer& buffer, std::uint64_t first, std::size_t count) {
  std::vector<T> values(count);
  if (count > 0) buffer.download(values.data(), count * sizeof(T), first * sizeof(T));
  return values;
}

/// The inverse of pixel_position.
std::uint32_t pixel_number(glm::uvec2 at, const Settings& settings) {
  std::uint32_t number = at.y / 8 * 8 * settings.width;  // its band begins there
  while (shared::pixel_position(number, settings.width, settings.height) != at) ++number;
  return number;
}

}  // namespace

std::optional<PpmIntegrator::Probe> PpmIntegrator::find_probe(std::uint32_t x, std::uint32_t y) {
  if (x >= settings_.width || y >= settings_.height) return std::nullopt;
  const std::uint32_t pixel = pixel_number({x, y}, settings_);
  std::optional<Probe> heaviest;
  std::size_t index = 0;
  std::uint64_t hits_before = 0;
  const auto look = [&](const HitTile& tile) {
    if (pixel < tile.first_pixel || pixel >= tile.first_pixel + tile.pixels) {
      ++index;
      hits_before += tile.hits;
      return true;
    }
    const std::uint64_t samples = settings_.samples_per_pixel;
    const auto starts = download<std::uint32_t>(tile.sample_start,
                                                (pixel - tile.first_pixel) * samples, samples + 1);
    float most = 0.0f;
    std::uint64_t place = hits_before + starts.front();
    for (const std::uint32_t hit :
         download<std::uint32_t>(tile.order, starts.front(), starts.back() - starts.front())) {
      const std::uint64_t this_place = place++;
      // As resolve.comp reads them.
      const glm::uvec4 plane1 = download<glm::uvec4>(tile.planes[1], hit, 1)[0];
      if ((plane1.w & PPM_HIT_EMISSION) != 0u) continue;
      const glm::uvec4 plane2 = download<glm::uvec4>(tile.planes[2], hit, 1)[0];
      const float weight = std::max({std::bit_cast<float>(plane2.x), std::bit_cast<float>(plane2.y),
                                     std::bit_cast<float>(plane2.z)});
      if (weight > most) {
        most = weight;
        heaviest =
            tiles_.are_traced_anew() ? Probe{0, this_place} : Probe{index, std::uint64_t{plane1.z}};
      }
    }
    return false;
  };
  tiles_.for_each([] { return false; }, HitTiles::Keep::no, look);
  return heaviest;
}

std::optional<ProbeReading> PpmIntegrator::probe(std::uint32_t x, std::uint32_t y) {
  const auto [entry, is_new] = probes_.try_emplace({x, y});
  if (is_new) entry->second = find_probe(x, y);
  if (!entry->second) return std::nullopt;
  const std::uint64_t slot = entry->second->slot;
  glm::vec4 statistics;
  std::uint32_t count = 0;
  if (tiles_.are_traced_anew()) {
    const KeptHit& kept = tiles_.kept()[slot];
    statistics = {kept.statistics[0], kept.statistics[1], kept.statistics[2], kept.statistics[3]};
    count = kept.photon_count;
  } else {
    const HitTile& tile = tiles_.all()[entry->second->tile];
    statistics = download<glm::vec4>(tile.statistics, slot, 1)[0];
    count = download<std::uint32_t>(tile.photon_counts, slot, 1)[0];
  }
  const double emitted =
      static_cast<double>(std::max<std::uint64_t>(statistics_.photons_emitted, 1));
  const double scale = buffers_.total_power() / emitted;
  return ProbeReading{settings_.alpha * count,
                      std::sqrt(static_cast<double>(statistics.w)) / scene_.frame.scale,
                      {scale * statistics.x, scale * statistics.y, scale * statistics.z}};
}

}  // namespace ppm::render
