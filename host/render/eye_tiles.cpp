#include "eye_tiles.hpp"

#include <algorithm>

#include "failure.hpp"
#include "region.hpp"
#include "tally.hpp"

namespace ppm::render {

EarlyEyeKernels::EarlyEyeKernels(const scene::Scene& scene, const Settings& settings,
                                 gpu::Device& device)
    : device_(device) {
  if (may_need_segments(scene, gpu::segment_size(device, settings.segment_bytes))) return;
  begun_ = std::async(std::launch::async,
                      [&device, traits = traits_of(scene)] { return EyeKernels(device, traits); });
}

const EyeKernels& EarlyEyeKernels::get(const SceneTraits& traits) {
  if (!kernels_) kernels_ = begun_.valid() ? begun_.get() : EyeKernels(device_, traits);
  return *kernels_;
}

void check_paths(const Settings& settings) {
  if (std::uint64_t{settings.width} * settings.height * settings.samples_per_pixel > 0xffffffffu) {
    throw Failure("", "--width, --height, --spp", "more than 2^32 eye paths",
                  "make the picture smaller or lower --spp");
  }
  if (settings.photons_per_pass > 0xffffffffu) {
    throw Failure("", "--photons", "more than 2^32 - 1 paths a pass", "take more passes instead");
  }
}

bool for_each_eye_tile(gpu::Device& device, const EyeKernels& kernels,
                       const gpu::BindingTable& scene, const Settings& settings,
                       const std::function<bool()>& interrupted,
                       const std::function<void(HitTile&, const EyePass&)>& use) {
  const gpu::Region region(device, "eye");
  EyePass eye(device, kernels, scene, settings);
  const std::uint32_t all_pixels = settings.width * settings.height;
  std::uint32_t pixels = 0;
  for (std::uint32_t first = 0; first < all_pixels; first += pixels) {
    pixels = std::min(all_pixels - first, eye.suggested_pixels());
    HitTile tile;
    for (;;) {
      const EyePass::Result result = eye.trace(first, pixels, interrupted, tile);
      if (result == EyePass::Result::interrupted) return false;
      if (result == EyePass::Result::done) break;
      if (pixels == 1) {
        throw Failure("", "--spp " + std::to_string(settings.samples_per_pixel),
                      "the hit points of one pixel do not fit a tile",
                      "lower --spp or raise --tile-hits");
      }
      pixels = (pixels + 1) / 2;
    }
    use(tile, eye);
  }
  return true;
}

bool trace_eye_tiles(gpu::Device& device, const EyeKernels& kernels, const gpu::BindingTable& scene,
                     const Settings& settings, const std::function<bool()>& interrupted,
                     std::vector<HitTile>& tiles, Statistics& statistics) {
  return for_each_eye_tile(device, kernels, scene, settings, interrupted,
                           [&](HitTile& tile, const EyePass& eye) {
                             Tally tally;
                             tally.add(eye.counters());
                             tally.add_to(statistics);
                             statistics.hit_points += tile.hits;
                             statistics.eye_rays += eye.rays();
                             tiles.push_back(std::move(tile));
                             statistics.tiles = tiles.size();
                           });
}

}  // namespace ppm::render
