#include "surface_layers.hpp"

#include <algorithm>

#include "eye_tiles.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"
#include "shared/camera.h"
#include "shared/layout.h"

namespace ppm::render {
namespace {

// As surfaces.comp writes them.
struct PixelSums {
  glm::vec4 albedo, place, geometric, shading;
};
static_assert(sizeof(PixelSums) == 64);

/// A direction, or zero where sums cancel to what rounding leaves.
glm::dvec3 unit_or_zero(glm::dvec3 sum, double weight) {
  const double size = glm::length(sum);
  return size > 1e-3 * weight && size > 0.0 ? sum / size : glm::dvec3(0.0);
}

glm::dvec3 value_of(LayerKind kind, const PixelSums& sums, const scene::Frame& frame) {
  const double weight = static_cast<double>(sums.geometric.w);
  if (!(weight > 0.0)) return glm::dvec3(0.0);
  switch (kind) {
    case LayerKind::albedo:
      return glm::clamp(glm::dvec3(sums.albedo), 0.0, 1.0);
    case LayerKind::normal:
      return unit_or_zero(glm::dvec3(sums.shading), weight);
    case LayerKind::geometric_normal:
      return unit_or_zero(glm::dvec3(sums.geometric), weight);
    case LayerKind::depth:
      return glm::dvec3(static_cast<double>(sums.place.w) / weight / frame.scale);
    default:
      return frame.to_world(glm::dvec3(sums.place) / weight);
  }
}

std::vector<PixelSums> sum_up(gpu::Device& device, const gpu::Kernel& kernel,
                              const gpu::BindingTable& scene, const HitTile& tile,
                              std::uint32_t samples) {
  const gpu::Region region(device, "layers");
  gpu::Buffer pixels(device, "layers", tile.pixels * sizeof(PixelSums), gpu::Usage::storage);
  gpu::BindingTable table = scene;
  tile.bind(table);
  table.set(PPM_BIND_PIXELS, pixels);
  device.run([&](gpu::Recorder& recorder) {
    std::uint32_t skip = 0;
    do {
      recorder.dispatch(kernel, table, shared::ResolvePush{0, 0, samples, skip, 0.0f}, tile.pixels);
      skip += PPM_RESOLVE_SLICE;
    } while (skip < tile.max_pixel_hits);
  });
  return pixels.download<PixelSums>(tile.pixels);
}

}  // namespace

std::vector<image::Layer> surface_layers(gpu::Device& device, const gpu::BindingTable& scene,
                                         const SceneTraits& traits, const Settings& settings,
                                         const scene::Frame& frame,
                                         std::span<const LayerKind> kinds) {
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  std::vector<LayerKind> wanted;
  std::vector<image::Layer> layers;
  for (const LayerKind kind : kinds) {
    if (facts_of(kind).of_hit_points) continue;
    wanted.push_back(kind);
    layers.push_back(empty_layer(kind, pixels));
  }
  if (layers.empty()) return layers;

  Settings own = settings;
  own.samples_per_pixel = layer_samples(settings);
  const EyeKernels kernels(device, traits, EyeKernels::Find::surfaces);
  const gpu::Kernel kernel(device, shaders::surfaces);
  const auto add = [&](const HitTile& tile, const EyePass& /*eye*/) {
    const auto sums = sum_up(device, kernel, scene, tile, own.samples_per_pixel);
    for (std::uint32_t i = 0; i < tile.pixels; ++i) {
      const glm::uvec2 at =
          shared::pixel_position(tile.first_pixel + i, settings.width, settings.height);
      const std::uint64_t pixel = std::uint64_t{at.y} * settings.width + at.x;
      for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        const glm::dvec3 value = value_of(wanted[layer], sums[i], frame);
        const std::size_t channels = layers[layer].channels.size();
        for (std::size_t channel = 0; channel < channels; ++channel) {
          layers[layer].values[channels * pixel + channel] =
              static_cast<float>(value[static_cast<int>(channel)]);
        }
      }
    }
    return true;
  };
  EyeTiles(device, kernels, scene, own, EyeTiles::Shortage::makes_tiles_smaller)
      .for_each([] { return false; }, add);
  return layers;
}

}  // namespace ppm::render
