#include "hit_tiles.hpp"

#include <algorithm>
#include <cstring>

#include "failure.hpp"

namespace ppm::render {
namespace {

// What passes need beside the tiles that are there: the pilot's two lists, then the search order.
constexpr std::uint64_t kLaterBytes = 12;

std::uint64_t bytes_of(const HitTile& tile) {
  std::uint64_t bytes = 0;
  for (const gpu::Buffer& plane : tile.planes) bytes += plane.bytes();
  for (const gpu::Buffer* buffer :
       {&tile.sample_start, &tile.order, &tile.statistics, &tile.photon_counts, &tile.sums}) {
    bytes += buffer->bytes();
  }
  return bytes;
}

void download(const HitTile& tile, KeptHit* kept) {
  const auto statistics = tile.statistics.download<glm::vec4>(tile.hits);
  const auto counts = tile.photon_counts.download<std::uint32_t>(tile.hits);
  for (const std::uint32_t i : tile.order.download<std::uint32_t>(tile.hits)) {
    const glm::vec4& s = statistics[i];
    *kept++ = {{s.x, s.y, s.z, s.w}, counts[i]};
  }
}

void upload(const KeptHit* kept, HitTile& tile) {
  std::vector<glm::vec4> statistics(tile.hits);
  std::vector<std::uint32_t> counts(tile.hits);
  for (const std::uint32_t i : tile.order.download<std::uint32_t>(tile.hits)) {
    const float* const s = kept->statistics;
    statistics[i] = {s[0], s[1], s[2], s[3]};
    counts[i] = kept++->photon_count;
  }
  tile.statistics.upload(std::span<const glm::vec4>(statistics));
  tile.photon_counts.upload(std::span<const std::uint32_t>(counts));
}

}  // namespace

HitTiles::HitTiles(gpu::Device& device, const gpu::BindingTable& scene, const Settings& settings,
                   Log& log)
    : device_(device), scene_(scene), settings_(settings), log_(log), anew_(settings.traces_anew) {}

void HitTiles::clear() {
  tiles_.clear();
  maker_.reset();
  kept_.clear();
  hits_ = tile_bytes_ = most_hits_ = 0;
}

void HitTiles::Totals::add(const HitTile& tile, const EyePass& eye) {
  tally.add(eye.counters());
  hits += tile.hits;
  rays += eye.rays();
  ++tiles;
  most_hits = std::max<std::uint64_t>(most_hits, tile.hits);
}

bool HitTiles::trace(const EyeKernels& kernels, const std::function<bool()>& interrupted,
                     Statistics& statistics) {
  kernels_ = &kernels;
  Totals totals;
  std::optional<bool> complete;
  if (!anew_) complete = trace_to_stay(interrupted, totals);
  if (anew_) {
    totals = {};
    maker_.emplace(device_, *kernels_, scene_, settings_, EyeTiles::Shortage::makes_tiles_smaller);
    complete = maker_->for_each(interrupted, [&](HitTile& tile, EyePass& eye) {
      totals.add(tile, eye);
      return true;
    });
  }
  totals.tally.add_to(statistics);
  statistics.eye_rays += totals.rays;
  statistics.tiles = totals.tiles;
  statistics.hit_points = hits_ = totals.hits;
  // Tiles that are made again may begin elsewhere.
  most_hits_ = anew_ ? std::min(hits_, tile_records(settings_, device_.max_storage_bytes()))
                     : totals.most_hits;
  return *complete;
}

std::optional<bool> HitTiles::trace_to_stay(const std::function<bool()>& interrupted,
                                            Totals& totals) {
  const std::uint64_t before = device_.allocated_bytes();
  std::uint64_t pixels = 0;
  bool too_much = false;
  try {
    EyeTiles maker(device_, *kernels_, scene_, settings_, EyeTiles::Shortage::throws);
    const bool complete = maker.for_each(interrupted, [&](HitTile& tile, EyePass& eye) {
      eye.tighten(tile);
      totals.add(tile, eye);
      hits_ = totals.hits;
      pixels += tile.pixels;
      tile_bytes_ += bytes_of(tile);
      tiles_.push_back(std::move(tile));
      too_much = !fits(before, pixels);
      return !too_much;
    });
    if (!too_much) return complete;
  } catch (const gpu::MemoryShortage& shortage) {
    trace_anew(shortage);
    return std::nullopt;
  }
  log_.tell("there are more hit points than expected: eye paths are traced anew for each pass");
  tiles_.clear();
  anew_ = true;
  return std::nullopt;
}

/// Whether all tiles will, by those of the first `pixels` pixels, which were made since so many
/// bytes were in use.
bool HitTiles::fits(std::uint64_t before, std::uint64_t pixels) const {
  const std::uint64_t all_pixels = std::uint64_t{settings_.width} * settings_.height;
  const double more = static_cast<double>(all_pixels - pixels) / static_cast<double>(pixels);
  const double in_all =
      static_cast<double>(device_.allocated_bytes()) + more * static_cast<double>(tile_bytes_);
  const double of_making = static_cast<double>(device_.allocated_bytes() - before - tile_bytes_);
  const double later = (1.0 + more) * static_cast<double>(hits_ * kLaterBytes);
  return in_all <= static_cast<double>(settings_.eye_allowance) &&
         in_all - of_making + later <= static_cast<double>(settings_.pass_allowance);
}

void HitTiles::trace_anew(const gpu::MemoryShortage& shortage) {
  if (anew_) throw shortage;
  log_.warn(std::string(shortage.what()) +
            "; the rendering goes on with less: eye paths are traced anew for each pass");
  tiles_.clear();
  anew_ = true;
}

std::uint64_t HitTiles::most_hits() const {
  return most_hits_;
}

bool HitTiles::for_each(const std::function<bool()>& interrupted, Keep keep,
                        const std::function<bool(HitTile&)>& use) {
  if (!anew_) {
    for (HitTile& tile : tiles_) {
      if (interrupted() || !use(tile)) return false;
    }
    return true;
  }
  if (!kernels_) return true;  // there are none
  if (!maker_) {
    maker_.emplace(device_, *kernels_, scene_, settings_, EyeTiles::Shortage::makes_tiles_smaller);
  }
  kept_.reserve(keep == Keep::yes ? hits_ : 0);
  std::uint64_t done = 0;
  return maker_->for_each(interrupted, [&](HitTile& tile, EyePass& /*eye*/) {
    tile.search_order = {};
    tile.searches = 0;
    const std::uint64_t end = done + tile.hits;
    if (end <= kept_.size()) upload(kept_.data() + done, tile);
    if (!use(tile)) return false;
    if (keep == Keep::yes) {
      kept_.resize(std::max<std::size_t>(end, kept_.size()));
      download(tile, kept_.data() + done);
    }
    done = end;
    return true;
  });
}

void HitTiles::save(SavedState& state) const {
  const auto append = [&](const std::vector<KeptHit>& hits) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(hits.data());
    state.insert(state.end(), bytes, bytes + hits.size() * sizeof(KeptHit));
  };
  state.reserve(state.size() + hits_ * sizeof(KeptHit));
  if (anew_) append(kept_);
  for (const HitTile& tile : tiles_) {
    std::vector<KeptHit> hits(tile.hits);
    download(tile, hits.data());
    append(hits);
  }
}

void HitTiles::restore(const std::uint8_t* saved) {
  const auto take = [&](std::vector<KeptHit>& hits) {
    if (!hits.empty()) std::memcpy(hits.data(), saved, hits.size() * sizeof(KeptHit));
    saved += hits.size() * sizeof(KeptHit);
  };
  if (anew_) {
    kept_.resize(hits_);
    take(kept_);
  }
  for (HitTile& tile : tiles_) {
    std::vector<KeptHit> hits(tile.hits);
    take(hits);
    upload(hits.data(), tile);
  }
}

}  // namespace ppm::render
