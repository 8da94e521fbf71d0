#include "eye_tiles.hpp"

#include <algorithm>

#include "failure.hpp"
#include "memory_shortage.hpp"
#include "region.hpp"

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

EyeTiles::EyeTiles(gpu::Device& device, const EyeKernels& kernels, const gpu::BindingTable& scene,
                   const Settings& settings, Shortage shortage)
    : device_(device), kernels_(kernels), scene_(scene), settings_(settings), shortage_(shortage) {}

bool EyeTiles::for_each(const std::function<bool()>& interrupted,
                        const std::function<bool(HitTile&, EyePass&)>& use) {
  const gpu::Region region(device_, "eye");
  const std::uint32_t all_pixels = settings_.width * settings_.height;
  for (std::uint32_t first = 0; first < all_pixels;) {
    try {
      if (!make(first, interrupted)) return false;
      const std::uint32_t pixels = tile_.pixels;
      if (!use(tile_, *eye_)) return false;
      first += pixels;
    } catch (const gpu::MemoryShortage&) {
      if (shortage_ == Shortage::throws || !shrink()) throw;
    }
  }
  return true;
}

bool EyeTiles::make(std::uint32_t first_pixel, const std::function<bool()>& interrupted) {
  if (!eye_) eye_.emplace(device_, kernels_, scene_, settings_);
  const std::uint32_t left = settings_.width * settings_.height - first_pixel;
  for (std::uint32_t pixels = std::min(left, eye_->suggested_pixels());;
       pixels = (pixels + 1) / 2) {
    const EyePass::Result result = eye_->trace(first_pixel, pixels, interrupted, tile_);
    if (result == EyePass::Result::interrupted) return false;
    if (result == EyePass::Result::done) return true;
    if (pixels == 1) {
      throw Failure("", "--spp " + std::to_string(settings_.samples_per_pixel),
                    "the hit points of one pixel do not fit a tile",
                    "lower --spp or raise --tile-hits");
    }
  }
}

bool EyeTiles::shrink() {
  const std::uint64_t most = tile_records(settings_, device_.max_storage_bytes());
  if (most / 2 < std::max<std::uint64_t>(kFewestTileHits, settings_.samples_per_pixel)) {
    return false;
  }
  tile_ = {};
  eye_.reset();
  settings_.tile_hits = most / 2;
  return true;
}

}  // namespace ppm::render
