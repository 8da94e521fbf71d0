#include "hit_layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/camera.h"
#include "shared/layout.h"

namespace ppm::render {
namespace {

constexpr LayerKind kKinds[] = {LayerKind::radius, LayerKind::photons, LayerKind::density};

/// What is read of a tile, once for all its pixels.
struct TileData {
  explicit TileData(const HitTile& tile, std::uint32_t samples)
      : flags(tile.planes[1].download<glm::uvec4>(tile.hits)),
        weights(tile.planes[2].download<glm::vec4>(tile.hits)),
        statistics(tile.statistics.download<glm::vec4>(tile.hits)),
        counts(tile.photon_counts.download<std::uint32_t>(tile.hits)),
        order(tile.order.download<std::uint32_t>(tile.hits)),
        starts(tile.sample_start.download<std::uint32_t>(tile.pixels * samples + 1ull)) {}

  std::vector<glm::uvec4> flags;
  std::vector<glm::vec4> weights, statistics;
  std::vector<std::uint32_t> counts, order, starts;
};

struct Means {
  double weight = 0.0, radius = 0.0, photons = 0.0, density = 0.0;

  double of(LayerKind kind) const {
    if (weight <= 0.0) return 0.0;
    if (kind == LayerKind::radius) return radius / weight;
    return (kind == LayerKind::photons ? photons : density) / weight;
  }
};

/// Of the hit points [first, last) of `order`; lengths in working units times `unit`.
Means means_of(const TileData& data, std::uint32_t first, std::uint32_t last, double kept,
               double unit) {
  Means means;
  for (std::uint32_t i = first; i < last; ++i) {
    const std::uint32_t hit = data.order[i];
    if ((data.flags[hit].w & PPM_HIT_EMISSION) != 0u) continue;
    const glm::vec4 w = data.weights[hit];
    const double weight =
        (static_cast<double>(w.x) + static_cast<double>(w.y) + static_cast<double>(w.z)) / 3.0;
    const std::uint32_t slot = data.flags[hit].z;
    // Negative before the pilot has found one.
    const double radius2 =
        std::max(static_cast<double>(data.statistics[slot].w), 0.0) * unit * unit;
    const double photons = kept * data.counts[slot];
    means.weight += weight;
    means.radius += weight * std::sqrt(radius2);
    means.photons += weight * photons;
    if (radius2 > 0.0) means.density += weight * photons / (std::numbers::pi * radius2);
  }
  return means;
}

}  // namespace

std::vector<image::Layer> hit_layers(HitTiles& tiles, const Settings& settings, double kept,
                                     const scene::Frame& frame, std::span<const LayerKind> kinds) {
  std::vector<LayerKind> wanted;
  std::vector<image::Layer> layers;
  for (const LayerKind kind : kinds) {
    if (std::ranges::find(kKinds, kind) == std::end(kKinds)) continue;
    wanted.push_back(kind);
    layers.push_back(empty_layer(kind, std::uint64_t{settings.width} * settings.height));
  }
  if (layers.empty()) return layers;
  const std::uint32_t samples = settings.samples_per_pixel;
  const auto add = [&](const HitTile& tile) {
    const TileData data(tile, samples);
    for (std::uint32_t i = 0; i < tile.pixels; ++i) {
      const Means means = means_of(data, data.starts[i * samples], data.starts[(i + 1) * samples],
                                   kept, 1.0 / frame.scale);
      const glm::uvec2 at =
          shared::pixel_position(tile.first_pixel + i, settings.width, settings.height);
      for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        layers[layer].values[std::uint64_t{at.y} * settings.width + at.x] =
            static_cast<float>(means.of(wanted[layer]));
      }
    }
    return true;
  };
  tiles.for_each([] { return false; }, HitTiles::Keep::no, add);
  return layers;
}

}  // namespace ppm::render
