#include "photon_map.hpp"

#include <algorithm>

#include "failure.hpp"
#include "region.hpp"

namespace ppm::render {
namespace {

constexpr std::uint64_t kPlaneBytes = 16;  // of a photon in each of its two buffers

gpu::Buffer plane(gpu::Device& device, const char* name, std::uint64_t photons) {
  return gpu::Buffer(device, name, photons * kPlaneBytes, gpu::Usage::storage_and_texels);
}

}  // namespace

PhotonMapShape PhotonMapShape::of(const Settings& settings, const PassLimits& limits) {
  const std::uint64_t photons = std::max<std::uint64_t>(settings.map_photons, 1);
  std::uint64_t fit = std::max<std::uint64_t>(limits.storage_bytes / kPlaneBytes, 1);
  if (settings.photon_capacity > 0) fit = std::min(fit, settings.photon_capacity);
  const std::uint64_t grids = std::max<std::uint64_t>((photons + fit - 1) / fit, 1);
  return {static_cast<std::uint32_t>(grids), (photons + grids - 1) / grids};
}

std::uint64_t PhotonMapShape::bytes() const {
  const std::uint64_t table =
      2 * sizeof(std::uint32_t) * max_entries(hashed_entries_for(grid_photons));
  return grids * (2 * kPlaneBytes * grid_photons + table) + 2 * kPlaneBytes * grid_photons;
}

PhotonMap::PhotonMap(gpu::Device& device, glm::vec3 bounds_min, glm::vec3 bounds_max,
                     PhotonMapShape shape)
    : device_(device),
      grid_photons_(shape.grid_photons),
      spare_position_(plane(device, "spare photon positions", shape.grid_photons)),
      spare_flux_(plane(device, "spare photon fluxes", shape.grid_photons)) {
  grids_.reserve(shape.grids);
  for (std::uint32_t i = 0; i < shape.grids; ++i) {
    grids_.emplace_back(device, bounds_min, bounds_max, grid_photons_);
  }
}

std::uint64_t PhotonMap::photons_in(std::size_t grid) const {
  const std::uint64_t first = grid * grid_photons_;
  return photons_ > first ? std::min(photons_ - first, grid_photons_) : 0;
}

void PhotonMap::append(const gpu::BindingTable& table, std::uint64_t count) {
  PPM_ASSERT(photons_ + count <= capacity(), std::to_string(count) + " photons too many");
  const gpu::Region region(device_, "grid");
  for (std::uint64_t done = 0; done < count;) {
    PhotonGrid& grid = grids_[photons_ / grid_photons_];
    const std::uint64_t place = photons_ % grid_photons_;
    const std::uint64_t part = std::min(count - done, grid_photons_ - place);
    // Photons are appended to the very buffers that the grid reads: out with them, and back.
    gpu::Buffer position, flux;
    grid.exchange_photons(position, flux);
    device_.run([&](gpu::Recorder& recorder) {
      const auto copy = [&](std::uint32_t from, const gpu::Buffer& to) {
        recorder.copy(*table.get(from), to, part * kPlaneBytes, done * kPlaneBytes,
                      place * kPlaneBytes);
      };
      copy(PPM_BIND_PHOTON_POSITION, position);
      copy(PPM_BIND_PHOTON_FLUX, flux);
    });
    grid.exchange_photons(position, flux);
    done += part;
    photons_ += part;
  }
}

void PhotonMap::truncate(std::uint64_t photons) {
  PPM_ASSERT(sorted_ <= photons && photons <= photons_, std::to_string(photons));
  photons_ = photons;
}

void PhotonMap::sort(float cell) {
  for (std::size_t i = 0; i < grids().size(); ++i) {
    grids_[i].exchange_photons(spare_position_, spare_flux_);
    gpu::BindingTable table;
    table.set(PPM_BIND_PHOTON_POSITION, spare_position_);
    table.set(PPM_BIND_PHOTON_FLUX, spare_flux_);
    grids_[i].build(device_, table, static_cast<std::uint32_t>(photons_in(i)), cell);
  }
  sorted_ = photons_;
}

std::span<const PhotonGrid> PhotonMap::grids() const {
  return std::span(grids_).first((photons_ + grid_photons_ - 1) / grid_photons_);
}

}  // namespace ppm::render
