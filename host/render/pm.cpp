#include "pm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "failure.hpp"
#include "hit_layers.hpp"
#include "memory_plan.hpp"
#include "memory_shortage.hpp"
#include "radius_summary.hpp"
#include "region.hpp"
#include "shared/random.h"
#include "stopwatch.hpp"
#include "surface_layers.hpp"

namespace ppm::render {
namespace {

// Searches end here, in the scene's bounding radius, lest those in the dark look at all photons.
constexpr float kLargestRadius = 0.25f;
// Hit points that tell how far photons are before all are asked.
constexpr std::uint64_t kSample = 2048;
// A map that lacks less than this share of its photons is full: the portion that fills it is cut
// by halves.
constexpr std::uint64_t kFull = 1024;
// Paths after which a scene in which none has left a photon is given up.
constexpr std::uint64_t kHopeless = std::uint64_t{1} << 22;
// Cells of the search order in likely radii.
constexpr float kOrderCell = 0.25f;

float largest_radius(const Settings& settings, const scene::Scene& scene,
                     const SceneBuffers& buffers) {
  switch (settings.radius_mode) {
    case RadiusMode::fixed:
      return static_cast<float>(settings.radius * scene.frame.scale);
    case RadiusMode::footprint:
      throw Failure("", "--radius footprint", "classic photon mapping has no first radius",
                    "give the largest one, or auto");
    case RadiusMode::automatic:
      break;
  }
  return kLargestRadius * buffers.constants().bounding_radius;
}

// R^2 that holds `nearest` of so many photons spread over the box's faces.
float likely_radius2(const SceneTraits& traits, double nearest, double photons) {
  const glm::dvec3 e = glm::dvec3(traits.bounds_max) - glm::dvec3(traits.bounds_min);
  const double area = 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x);
  return static_cast<float>(std::min(nearest / photons, 1.0) * area / std::numbers::pi);
}

float median_radius2(std::span<const std::uint32_t> histogram) {
  const std::uint64_t all = std::accumulate(histogram.begin(), histogram.end(), std::uint64_t{0});
  std::uint64_t smaller = 0;
  std::size_t bin = 0;
  while (bin + 1 < histogram.size() && 2 * (smaller + histogram[bin]) < all) {
    smaller += histogram[bin++];
  }
  return static_cast<float>(std::exp2(0.5 * (static_cast<double>(bin) + 0.5) - 64.0));
}

PhotonMapShape announced(const PhotonMapShape& shape, std::uint64_t photons, const Log& log) {
  log.note("photon map: up to " + std::to_string(photons) + " photons, " +
           size_text(shape.bytes()));
  return shape;
}

}  // namespace

PhotonMapIntegrator::PhotonMapIntegrator(const Settings& settings, const scene::Scene& scene,
                                         gpu::Device& device, Log& log, unsigned threads)
    : settings_(settings),
      scene_(scene),
      device_(device),
      eye_kernels_(scene, settings, device),
      buffers_(scene, settings, device, threads),
      traits_(buffers_.traits_of(scene)),
      table_(buffers_.table()),
      capacities_(pass_capacities(settings, PassLimits::of(device))),
      tracer_(device, table_, traits_, capacities_.photons, capacities_.paths),
      chunks_(tracer_, static_cast<std::uint32_t>(
                           std::min(settings.photons_per_pass, tracer_.path_capacity()))),
      map_(device, scene.bounds_min, scene.bounds_max,
           announced(PhotonMapShape::of(settings, PassLimits::of(device)), settings.map_photons,
                     log)),
      estimator_(device, table_, traits_, tile_capacity(settings, device.max_storage_bytes())),
      tiles_(device, table_, settings, log),
      largest_radius_(largest_radius(settings, scene, buffers_)) {
  statistics_.seconds["bvh"] = buffers_.bvh_seconds();
  statistics_.seconds["upload"] = buffers_.upload_seconds();
  statistics_.triangles = scene.triangles.size();
  statistics_.lights = buffers_.light_count();
  tracer_.bind_photons(photons_);
  check_paths(settings);
}

bool PhotonMapIntegrator::prepare(const std::function<bool()>& interrupted) {
  const Stopwatch stopwatch(statistics_.seconds["eye"]);
  if (!tiles_.trace(eye_kernels_.get(traits_), interrupted, statistics_)) return false;
  try {
    prepare_searches();
  } catch (const gpu::MemoryShortage& shortage) {
    tiles_.trace_anew(shortage);
    prepare_searches();
  }
  return true;
}

void PhotonMapIntegrator::look_from(const scene::Camera& camera) {
  settings_.camera = camera;
  buffers_.look_from(settings_, traits_, device_);
  tiles_.clear();
  nearest_.reset();
  map_.clear();
  cell_ = 0.0f;
  complete_ = false;
  estimated_ = 0;
  rejected_ = {};
  statistics_ = statistics_.of_scene();
}

void PhotonMapIntegrator::prepare_searches() {
  nearest_.reset();
  nearest_.emplace(device_, traits_, tiles_.most_hits());
  for (HitTile& tile : tiles_.all()) {
    estimator_.reserve_pixels(tile.pixels);
    order_searches(tile);
  }
}

// In cells of likely radii: neighbours in space search together.
void PhotonMapIntegrator::order_searches(HitTile& tile) {
  const float radius = std::sqrt(
      likely_radius2(traits_, settings_.nearest, static_cast<double>(settings_.map_photons)));
  estimator_.order_searches(tile, kOrderCell * radius);
}

PhotonMapIntegrator::Added PhotonMapIntegrator::add_photons(
    std::uint32_t pass, std::uint32_t first, std::uint32_t paths,
    const std::function<bool()>& interrupted, Tally& tally) {
  const std::uint64_t before = map_.photons();
  Tally added;
  bool fits = true;
  const auto append = [&] {
    fits = map_.photons() + tracer_.photon_count() <= settings_.map_photons;
    if (!fits) return false;
    map_.append(photons_, tracer_.photon_count());
    added.photons_stored += tracer_.photon_count();
    added.add(tracer_.counters());
    return true;
  };
  if (chunks_.trace(PPM_STREAM_PHOTON, pass, first, paths, interrupted, append)) {
    tally += added;
    return Added::all;
  }
  map_.truncate(before);
  return fits ? Added::interrupted : Added::none;
}

bool PhotonMapIntegrator::advance(const std::function<bool()>& interrupted) {
  if (complete_) return true;
  const double start = clock_seconds();
  const std::uint64_t before = map_.photons();
  const auto pass = static_cast<std::uint32_t>(statistics_.passes);
  const auto paths = static_cast<std::uint32_t>(settings_.photons_per_pass);
  Tally tally;
  bool full = false;
  std::uint32_t done = 0;
  for (std::uint32_t step = paths; step > 0 && done < paths;) {
    step = std::min(step, paths - done);
    const Added added = add_photons(pass, done, step, interrupted, tally);
    if (added == Added::interrupted) {
      map_.truncate(before);
      return false;
    }
    if (added == Added::all) done += step;
    full = full || added == Added::none;
    if (full) {
      if (settings_.map_photons - map_.photons() <= settings_.map_photons / kFull) break;
      step /= 2;
    }
  }
  tally.add_to(statistics_);
  statistics_.passes += 1;
  statistics_.photons_emitted += done;
  statistics_.map_photons = map_.photons();
  complete_ = full || map_.photons() == settings_.map_photons ||
              (map_.photons() == 0 && statistics_.photons_emitted >= kHopeless);
  const double seconds = clock_seconds() - start;
  statistics_.pass_seconds.push_back(seconds);
  statistics_.seconds["photons"] += seconds;
  return true;
}

Picture PhotonMapIntegrator::resolve() {
  if (nearest_ && map_.photons() != estimated_) estimate();
  const Stopwatch stopwatch(statistics_.seconds["resolve"]);
  const double emitted =
      static_cast<double>(std::max<std::uint64_t>(statistics_.photons_emitted, 1));
  return estimator_.picture(tiles_, settings_,
                            static_cast<float>(buffers_.total_power() / emitted));
}

void PhotonMapIntegrator::estimate() {
  const NearestPhotons::Request request = next_request();
  map_.sort(cell_);
  nearest_->clear_histogram();
  Estimator::Rejected rejected;
  std::vector<float> radii2;
  const auto estimate = [&](HitTile& tile) {
    if (!tile.search_order) order_searches(tile);
    {
      const Stopwatch stopwatch(statistics_.seconds["nearest"]);
      nearest_->find(tile, map_.grids(), request);
    }
    const Stopwatch stopwatch(statistics_.seconds["update"]);
    Estimator::Rejected of_tile;
    for (const PhotonGrid& grid : map_.grids()) of_tile += estimator_.gather(tile, grid);
    // With alpha = 1 the update divides by the disc's area and leaves the radius.
    estimator_.update(std::span(&tile, 1), 1.0f);
    estimator_.add_radii(tile, radii2);
    rejected += of_tile;
    return true;
  };
  tiles_.for_each([] { return false; }, HitTiles::Keep::yes, estimate);
  learn_cell();
  statistics_.rejected["overflow"] += rejected.overflow - rejected_.overflow;
  statistics_.rejected["clamped"] += rejected.clamped - rejected_.clamped;
  rejected_ = rejected;
  estimated_ = map_.photons();
  record_radii(std::move(radii2));
}

NearestPhotons::Request PhotonMapIntegrator::next_request() {
  const Stopwatch stopwatch(statistics_.seconds["nearest"]);
  NearestPhotons::Request request;
  request.wanted = settings_.nearest;
  request.max_depth = settings_.max_depth;
  request.largest_radius = largest_radius_;
  const auto photons = static_cast<double>(map_.photons());
  if (estimated_ == 0) {
    const float likely = std::min(likely_radius2(traits_, settings_.nearest, photons),
                                  largest_radius_ * largest_radius_);
    request.guess2 = likely / 8.0f;
    request.spread = 8.0f;
    const std::uint64_t sample = std::max<std::uint64_t>(statistics_.hit_points / kSample, 1);
    request.stride = static_cast<std::uint32_t>(sample);
    cell_ = 0.5f * std::sqrt(likely);
    map_.sort(cell_);
    nearest_->clear_histogram();
    tiles_.for_each([] { return false; }, HitTiles::Keep::no,
                    [&](HitTile& tile) {
                      if (!tile.search_order) order_searches(tile);
                      nearest_->find(tile, map_.grids(), request);
                      return true;
                    });
    learn_cell();
    request.guess2 = median_radius2(nearest_->histogram());
    request.spread = 2.0f;
    request.stride = 1;
  } else {
    const double fewer = static_cast<double>(estimated_) / photons;
    request.guess2 = static_cast<float>(-fewer);
    request.spread = 1.25f;
    cell_ *= static_cast<float>(std::sqrt(fewer));
  }
  return request;
}

void PhotonMapIntegrator::learn_cell() {
  const double in_each =
      static_cast<double>(settings_.nearest) / static_cast<double>(map_.grids().size());
  const float cell = cell_from_radii(nearest_->histogram(), in_each);
  if (cell > 0.0f) cell_ = cell;
}

void PhotonMapIntegrator::record_radii(std::vector<float> radii2) {
  const RadiusSummary summary = summarize_radii(std::move(radii2), scene_.frame.scale);
  statistics_.nearest_radius_min = summary.min;
  statistics_.nearest_radius_median = summary.median;
  statistics_.nearest_radius_max = summary.max;
}

std::vector<image::Layer> PhotonMapIntegrator::layers(std::span<const LayerKind> kinds) {
  if (nearest_ && map_.photons() != estimated_) estimate();
  std::vector<image::Layer> layers =
      surface_layers(device_, table_, traits_, settings_, scene_.frame, kinds);
  for (image::Layer& layer : hit_layers(tiles_, settings_, 1.0, scene_.frame, kinds)) {
    layers.push_back(std::move(layer));
  }
  if (std::ranges::find(kinds, LayerKind::direct_emission) != kinds.end()) {
    layers.push_back(empty_layer(LayerKind::direct_emission, 0));
    layers.back().values = estimator_.picture(tiles_, settings_, 0.0f).rgb;
  }
  return layers;
}

const Statistics& PhotonMapIntegrator::statistics() {
  for (const auto& [kernel, time] : device_.times()) {
    statistics_.kernel_seconds[kernel] = time.seconds;
  }
  return statistics_;
}

}  // namespace ppm::render
