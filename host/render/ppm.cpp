#include "ppm.hpp"

#include <algorithm>
#include <cmath>

#include "hit_layers.hpp"
#include "memory_shortage.hpp"
#include "radius_summary.hpp"
#include "region.hpp"
#include "shared/random.h"
#include "stopwatch.hpp"
#include "surface_layers.hpp"

namespace ppm::render {
namespace {

// The paper's other choice of the first radius: this many footprints of the pixel.
constexpr float kFootprints = 3.0f;
// The pilot never looks further than this share of the scene's bounding radius ...
constexpr float kLargestRadius = 0.02f;
// ... and halves its radius at most this often.
constexpr std::uint32_t kPilotRounds = 12;
// Searches of later rounds that cost about as much as sorting as many photons, times this.
constexpr std::uint64_t kSearchesWorthSorting = 8;

}  // namespace

PpmIntegrator::PpmIntegrator(const Settings& settings, const scene::Scene& scene,
                             gpu::Device& device, Log& log, unsigned threads)
    : settings_(settings),
      scene_(scene),
      device_(device),
      log_(log),
      eye_kernels_(scene, settings, device),
      buffers_(scene, settings, device, threads),
      traits_(buffers_.traits_of(scene)),
      table_(buffers_.table()),
      pipelines_begin_(clock_seconds()),
      capacities_(pass_capacities(settings, PassLimits::of(device))),
      tracer_(device, table_, traits_, capacities_.photons, capacities_.paths),
      grid_(device, scene.bounds_min, scene.bounds_max, capacities_.photons, 0,
            capacities_.grid_entries),
      estimator_(device, table_, traits_, tile_capacity(settings, device.max_storage_bytes())),
      batch_(device, tracer_, grid_, estimator_),
      tiles_(device, table_, settings, log),
      chunks_(tracer_, static_cast<std::uint32_t>(
                           std::min(settings.photons_per_pass, tracer_.path_capacity()))),
      batch_limit_(capacities_.passes) {
  statistics_.seconds["pipelines"] = clock_seconds() - pipelines_begin_;
  statistics_.seconds["bvh"] = buffers_.bvh_seconds();
  statistics_.seconds["upload"] = buffers_.upload_seconds();
  statistics_.triangles = scene.triangles.size();
  statistics_.lights = buffers_.light_count();
  tracer_.bind_photons(photons_);
  check_paths(settings);
}

bool PpmIntegrator::prepare(const std::function<bool()>& interrupted) {
  return trace_eye_paths(interrupted) && find_initial_radii(interrupted);
}

void PpmIntegrator::look_from(const scene::Camera& camera) {
  settings_.camera = camera;
  buffers_.look_from(settings_, traits_, device_);
  tiles_.clear();
  probes_.clear();
  in_steps_ = pilot_is_held_ = false;
  statistics_ = statistics_.of_scene();
}

bool PpmIntegrator::trace_eye_paths(const std::function<bool()>& interrupted) {
  const Stopwatch stopwatch(statistics_.seconds["eye"]);
  return tiles_.trace(eye_kernels_.get(traits_), interrupted, statistics_);
}

bool PpmIntegrator::find_initial_radii(const std::function<bool()>& interrupted) {
  const gpu::Region region(device_, "pilot");
  const double start = clock_seconds();
  std::vector<float> radii2;
  try {
    if (!tiles_.are_traced_anew()) {
      if (!find_radii_of(tiles_.all(), interrupted)) return false;
      radii2 = estimator_.prepare_searches(tiles_.all());
      for (const HitTile& tile : tiles_.all()) estimator_.reserve_pixels(tile.pixels);
    }
  } catch (const gpu::MemoryShortage& shortage) {
    tiles_.trace_anew(shortage);
  }
  if (tiles_.are_traced_anew()) {
    radii2.clear();
    estimator_.clear_radii();
    const auto find = [&](HitTile& tile) {
      if (!find_radii_of(std::span(&tile, 1), interrupted)) return false;
      estimator_.add_radii(tile, radii2);
      return true;
    };
    if (!tiles_.for_each(interrupted, HitTiles::Keep::yes, find)) return false;
    pilot_is_held_ = false;
  }
  record_initial_radii(std::move(radii2));
  statistics_.seconds["pilot"] = clock_seconds() - start;
  return true;
}

bool PpmIntegrator::find_radii_of(std::span<const HitTile> tiles,
                                  const std::function<bool()>& interrupted) {
  const bool automatic = settings_.radius_mode == RadiusMode::automatic;
  const float fixed = settings_.radius_mode == RadiusMode::fixed
                          ? static_cast<float>(settings_.radius * scene_.frame.scale)
                          : 0.0f;
  const float footprints = settings_.radius_mode == RadiusMode::footprint ? kFootprints : 0.0f;
  for (const HitTile& tile : tiles) estimator_.set_radii(tile, fixed, footprints);
  return !automatic || run_pilot(tiles, interrupted);
}

bool PpmIntegrator::run_pilot(std::span<const HitTile> tiles,
                              const std::function<bool()>& interrupted) {
  // The pilot's photons are a set of their own: radii must not depend on the photons that are
  // estimated with them. All rounds see the same ones, as many as a pass has.
  Pilot pilot(device_, traits_of(scene_), tiles);
  float radius = kLargestRadius * buffers_.constants().bounding_radius;
  std::uint64_t undecided = 0;
  bool whole = pilot_is_held_;  // all photons are in the grid
  for (std::uint32_t index = 0; index < kPilotRounds; ++index, radius *= 0.5f) {
    const Pilot::Round round{index, index + 1 == kPilotRounds, radius};
    if (whole) {
      if (interrupted()) return false;
      // The grid's cells may be smaller than the first round's.
      const std::uint64_t searches = index > 0 ? undecided : tracer_.photon_count();
      undecided = decide_again(pilot, round, searches);
    } else {
      const auto use = [&] {
        if (interrupted()) return false;
        whole = chunks_.paths() >= settings_.photons_per_pass;
        if (whole) {
          pilot_is_held_ = true;
          undecided = *pilot.decide(grid_, round, false);
        } else {
          pilot.count(grid_, round);
        }
        return true;
      };
      if (buffers_.light_count() > 0 &&
          !for_each_chunk(PPM_STREAM_PILOT, 0, radius, interrupted, use))
        return false;
      if (!whole) undecided = pilot.decide(round);
    }
    if (undecided == 0) break;
  }
  return true;
}

std::uint64_t PpmIntegrator::decide_again(Pilot& pilot, const Pilot::Round& round,
                                          std::uint64_t searches) {
  // For a few searches the photons need not be sorted again into smaller cells.
  if (kSearchesWorthSorting * searches < tracer_.photon_count()) {
    if (const auto undecided = pilot.decide(grid_, round, true)) return *undecided;
  }
  grid_.build(device_, photons_, tracer_.photon_count(), round.radius);
  return *pilot.decide(grid_, round, false);
}

Picture PpmIntegrator::resolve() {
  const Stopwatch stopwatch(statistics_.seconds["resolve"]);
  const double emitted =
      static_cast<double>(std::max<std::uint64_t>(statistics_.photons_emitted, 1));
  return estimator_.picture(tiles_, settings_,
                            static_cast<float>(buffers_.total_power() / emitted));
}

void PpmIntegrator::record_initial_radii(std::vector<float> radii2) {
  const RadiusSummary summary = summarize_radii(std::move(radii2), scene_.frame.scale);
  statistics_.initial_radius_min = summary.min;
  statistics_.initial_radius_median = summary.median;
  statistics_.initial_radius_max = summary.max;
}

std::vector<image::Layer> PpmIntegrator::layers(std::span<const LayerKind> kinds) {
  std::vector<image::Layer> layers =
      surface_layers(device_, table_, traits_, settings_, scene_.frame, kinds);
  for (image::Layer& layer : hit_layers(tiles_, settings_, settings_.alpha, scene_.frame, kinds)) {
    layers.push_back(std::move(layer));
  }
  if (std::ranges::find(kinds, LayerKind::direct_emission) != kinds.end()) {
    layers.push_back(empty_layer(LayerKind::direct_emission, 0));
    layers.back().values = estimator_.picture(tiles_, settings_, 0.0f).rgb;
  }
  return layers;
}

const Statistics& PpmIntegrator::statistics() {
  for (const auto& [kernel, time] : device_.times()) {
    statistics_.kernel_seconds[kernel] = time.seconds;
  }
  return statistics_;
}

}  // namespace ppm::render
