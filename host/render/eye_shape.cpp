#include "eye_shape.hpp"

#include <algorithm>

#include "eye_pass.hpp"
#include "shared/layout.h"

namespace ppm::render {
namespace {

// Planes of geometry that every scene has, and the statistics beside them; one more with layers.
constexpr std::uint64_t kRoomBytes = 4 * 16 + 16, kLayerBytes = 16;
// Place in canonical order, photon count and sums of a hit point.
constexpr std::uint64_t kHitBytes = 2 * sizeof(std::uint32_t) + sizeof(shared::GatherSum);

}  // namespace

EyeShape EyeShape::of(const Settings& settings, const PassLimits& limits) {
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  const std::uint64_t samples = settings.samples_per_pixel;
  const EyeRoom room = EyeRoom::of(settings, limits.storage_bytes);
  const double hits_a_pixel = limits.hits_a_path * static_cast<double>(samples);
  const double expected = std::max(room.hits_a_pixel, hits_a_pixel);
  EyeShape shape{};
  shape.capacity = room.capacity;
  shape.queue = room.queue;
  shape.tile_pixels = std::min<std::uint64_t>(pixels, room.pixels_for(expected));
  shape.tiles = (pixels + shape.tile_pixels - 1) / std::max<std::uint64_t>(shape.tile_pixels, 1);
  const auto hits_of = [&](std::uint64_t some) {
    return static_cast<std::uint64_t>(hits_a_pixel * static_cast<double>(some)) + 1;
  };
  const auto room_of = [&](std::uint64_t some) {
    return room.tightened(room.records_for(expected, some), hits_of(some));
  };
  const std::uint64_t last = pixels - (shape.tiles - 1) * shape.tile_pixels;
  shape.room = (shape.tiles - 1) * room_of(shape.tile_pixels) + room_of(last);
  shape.hits = hits_of(pixels);
  shape.groups = pixels * samples;
  shape.tile_room = room.records_for(expected, shape.tile_pixels);
  shape.tile_hits = hits_of(shape.tile_pixels);
  shape.tile_groups = shape.tile_pixels * samples;
  shape.room_bytes = kRoomBytes + (limits.layered_hits ? kLayerBytes : 0);
  return shape;
}

std::uint64_t EyeShape::all_tiles_bytes() const {
  return room * room_bytes + hits * kHitBytes + 4 * groups + 24 * tiles;
}

std::uint64_t EyeShape::tile_bytes() const {
  return tile_room * room_bytes + tile_hits * kHitBytes + 4 * tile_groups + 24;
}

std::uint64_t EyeShape::making_bytes() const {
  return queue * (2 * sizeof(shared::EyePath) + sizeof(std::uint32_t)) +
         tile_room * (sizeof(shared::HitKey) + sizeof(std::uint32_t)) +
         (queue / PPM_SCAN_CHUNK + 2) * sizeof(std::uint32_t);
}

}  // namespace ppm::render
