#include "memory_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "binary_tree.hpp"
#include "cell_table.hpp"
#include "eye_shape.hpp"
#include "film.hpp"
#include "hit_tiles.hpp"
#include "layers.hpp"
#include "nearest_photons.hpp"
#include "photon_map.hpp"
#include "shared/layout.h"

namespace ppm::render {
namespace {

constexpr double kNodesATriangle = 0.4;
// Parts that are less than this part of all are told of together.
constexpr std::uint64_t kSmallPart = 50;
// Program, libraries, compiled kernels; measured with lavapipe.
constexpr const char* kProgramName = "program and driver";
constexpr std::uint64_t kProgram = std::uint64_t{160} << 20;

constexpr std::uint64_t kPhotonBytes = 4 * sizeof(glm::uvec4);  // as found and in cell order

// Of an entry of an alias table while it is made: its weight, also scaled, threshold, alias and its
// place in one of two lists.
constexpr std::uint64_t kAliasBytes = 2 * sizeof(double) + 3 * sizeof(std::uint32_t);

std::uint64_t share(double factor, std::uint64_t count) {
  return static_cast<std::uint64_t>(factor * static_cast<double>(count));
}

// Two lists of a hit point's, while the pilot runs.
constexpr std::uint64_t kPilotBytes = 2 * sizeof(std::uint32_t);

/// Of methods with hit points. `pilot`: bytes that each needs before it is in search order.
std::vector<MemoryPart> hit_memory(const Settings& settings, const PassLimits& limits,
                                   std::uint64_t pilot) {
  const EyeShape eye = EyeShape::of(settings, limits);
  const bool anew = settings.traces_anew;
  const std::uint64_t hits = anew ? eye.tile_hits : eye.hits;
  const std::uint64_t searched =
      hits * std::max<std::uint64_t>(pilot, sizeof(std::uint32_t)) + eye.tile_pixels * 16;
  const std::uint64_t search_table = max_entries(hashed_entries_for(eye.capacity));
  std::vector<MemoryPart> parts = {
      {"hit points", anew ? eye.tile_bytes() : eye.all_tiles_bytes(), true, Phase::eye,
       Phase::render},
      {"eye paths", eye.making_bytes(), true, Phase::eye, anew ? Phase::render : Phase::eye},
      {"searches", eye.capacity * 2 * sizeof(shared::GatherCursor) + table_bytes(search_table),
       true, Phase::upload, Phase::render},
      {"order of searches", searched, true, Phase::render, Phase::render},
      // Their median is told.
      {"radii", eye.hits * sizeof(float), false, Phase::render, Phase::render},
      {"statistics on their way", eye.tile_hits * (sizeof(glm::vec4) + 2 * sizeof(std::uint32_t)),
       false, Phase::eye, Phase::render},
  };
  if (anew) {
    parts.push_back(
        {"statistics of hit points", eye.hits * sizeof(KeptHit), false, Phase::eye, Phase::render});
  }
  return parts;
}

std::uint64_t held(const MemoryPlan& plan, Phase phase,
                   const std::function<bool(const MemoryPart&)>& counts) {
  std::uint64_t bytes = 0;
  for (const MemoryPart& part : plan.parts) {
    if (part.first <= phase && phase <= part.last && counts(part)) bytes += part.bytes;
  }
  return bytes;
}

std::uint64_t most_held(const MemoryPlan& plan,
                        const std::function<bool(const MemoryPart&)>& counts) {
  std::uint64_t most = 0;
  for (const Phase phase : kPhases) most = std::max(most, held(plan, phase, counts));
  return most;
}

bool all(const MemoryPart&) {
  return true;
}

/// The largest first; never none, for the program itself is one.
std::vector<const MemoryPart*> parts_at_peak(const MemoryPlan& plan) {
  const Phase* const worst =
      std::ranges::max_element(kPhases, {}, [&](Phase phase) { return held(plan, phase, all); });
  std::vector<const MemoryPart*> parts;
  for (const MemoryPart& part : plan.parts) {
    if (part.first <= *worst && *worst <= part.last && part.bytes > 0) parts.push_back(&part);
  }
  std::ranges::sort(parts, std::greater{}, &MemoryPart::bytes);
  return parts;
}

}  // namespace

std::uint64_t MemoryPlan::peak() const {
  return most_held(*this, all);
}
std::uint64_t MemoryPlan::host_peak() const {
  return most_held(*this, [](const MemoryPart& part) { return !part.on_device; });
}
std::uint64_t MemoryPlan::held(Phase phase, bool on_device) const {
  return render::held(*this, phase,
                      [=](const MemoryPart& part) { return part.on_device == on_device; });
}
std::uint64_t MemoryPlan::device_peak() const {
  return most_held(*this, [](const MemoryPart& part) { return part.on_device; });
}

std::vector<MemoryPart> ppm_memory(const Settings& settings, const PassLimits& limits) {
  const PassCapacities capacities = pass_capacities(settings, limits);
  const std::uint64_t table =
      std::max(max_entries(hashed_entries_for(capacities.photons)), capacities.grid_entries);
  std::vector<MemoryPart> parts = hit_memory(settings, limits, kPilotBytes);
  parts.push_back({"photons",
                   capacities.photons * kPhotonBytes +
                       capacities.paths * 2 * sizeof(shared::PhotonPath) + table_bytes(table),
                   true, Phase::upload, Phase::render});
  return parts;
}

std::vector<MemoryPart> photon_map_memory(const Settings& settings, const PassLimits& limits) {
  const PassCapacities capacities = pass_capacities(settings, limits);
  const EyeShape eye = EyeShape::of(settings, limits);
  const std::uint64_t tile_hits = settings.traces_anew ? eye.tile_room : eye.tile_hits;
  std::vector<MemoryPart> parts = hit_memory(settings, limits, 0);
  parts.push_back({"nearest photons", std::min(eye.hits, tile_hits) * NearestPhotons::kHitBytes,
                   true, Phase::render, Phase::render});
  // As found; they are sorted in the map.
  parts.push_back(
      {"photons",
       capacities.photons * kPhotonBytes / 2 + capacities.paths * 2 * sizeof(shared::PhotonPath),
       true, Phase::upload, Phase::render});
  parts.push_back({"photon map", PhotonMapShape::of(settings, limits).bytes(), true, Phase::upload,
                   Phase::render});
  return parts;
}

std::vector<MemoryPart> path_tracer_memory(const Settings& settings, const PassLimits& limits) {
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  const std::uint64_t paths = pass_capacities(settings, limits).camera_paths;
  const bool keeps = settings.keeps_film && paths < pixels;
  return {{"paths", paths * 2 * sizeof(shared::CameraPath), true, Phase::upload, Phase::render},
          film_memory(pixels, keeps)};
}

MemoryPart film_memory(std::uint64_t pixels, bool keeps) {
  return {"film", (keeps ? 2 : 1) * Film::bytes(pixels), true, Phase::upload, Phase::render};
}

std::vector<MemoryPart> layers_memory(const Settings& settings, const PassLimits& limits,
                                      std::span<const LayerKind> kinds) {
  if (kinds.empty()) return {};
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  std::uint64_t channels = 0;
  for (const LayerKind kind : kinds) channels += facts_of(kind).channels.size();
  Settings own = settings;
  own.samples_per_pixel = layer_samples(settings);
  PassLimits layered = limits;
  layered.layered_hits = true;
  const EyeShape eye = EyeShape::of(own, layered);
  // Once more while a file is made.
  return {{"layers", 2 * channels * pixels * sizeof(float), false, Phase::render, Phase::render},
          {"eye paths of layers",
           eye.tile_bytes() + eye.making_bytes() + eye.tile_pixels * 4 * sizeof(glm::vec4), true,
           Phase::render, Phase::render}};
}

MemoryPlan memory_plan(const scene::SceneSize& size, const Settings& settings,
                       const PassLimits& limits) {
  const std::uint64_t n = size.triangles, details = size.details ? n : 0;
  const std::uint64_t nodes = share(kNodesATriangle, n) * sizeof(shared::BvhNode);
  const std::uint64_t tree = n * (sizeof(bvh::Primitive) + sizeof(bvh::BinaryNode));
  const std::uint64_t records =
      n * (sizeof(shared::TrianglePositions) + sizeof(shared::TriangleShading)) +
      details * sizeof(shared::TriangleDetail) + nodes;
  const std::uint64_t surroundings =
      size.materials * (sizeof(shared::MaterialRecord) + sizeof(shared::MediumRecord)) +
      size.lights * (sizeof(shared::LightRecord) + sizeof(std::uint32_t));
  const std::uint64_t sky = size.environment_texels;
  MemoryPlan plan;
  plan.parts = {
      // A container is held twice while it is taken apart.
      {"file", 2 * size.file_bytes, false, Phase::load, Phase::load},
      {"unpacked geometry", size.decoded_bytes + size.decoder_bytes, false, Phase::load,
       Phase::load},
      {"triangles", n * sizeof(scene::Triangle) + details * sizeof(scene::TriangleDetail), false,
       Phase::load, Phase::upload},
      {"textures", size.texture_bytes, false, Phase::load, Phase::upload},
      {"tree while it is built", tree + nodes, false, Phase::build, Phase::build},
      {"tree and triangles on the device", records, true, Phase::upload, Phase::render},
      {"environment", sky * sizeof(glm::vec3), false, Phase::load, Phase::render},
      {"environment as it is read", sky * sizeof(glm::vec3), false, Phase::load, Phase::load},
      {"tables of environment and lights",
       sky * (sizeof(glm::uvec4) + kAliasBytes) +
           size.lights * (sizeof(shared::LightRecord) + kAliasBytes),
       false, Phase::upload, Phase::upload},
      {"environment on the device", sky * sizeof(glm::uvec4), true, Phase::upload, Phase::render},
      {"materials, media and lights on the device", surroundings, true, Phase::upload,
       Phase::render},
      {"textures on the device", size.texture_bytes, true, Phase::upload, Phase::render},
      {"transfers", limits.transfer_bytes, true, Phase::upload, Phase::render},
      {"picture", std::uint64_t{settings.width} * settings.height * 2 * 3 * sizeof(float), false,
       Phase::render, Phase::render},
      {kProgramName, kProgram, false, Phase::load, Phase::render},
  };
  for (MemoryPart& part : method_memory(settings, limits)) plan.parts.push_back(std::move(part));
  return plan;
}

MemoryPart checkpoint_memory(const Settings& settings, const PassLimits& limits) {
  std::uint64_t state = 0;
  for (const MemoryPart& part : method_memory(settings, limits)) {
    if (part.name == "chains") state += part.bytes;
  }
  const Method method = method_named(settings.integrator);
  if (method.unit != PassUnit::photons) {
    state += Film::bytes(std::uint64_t{settings.width} * settings.height);
  }
  if (method.has_option("--alpha")) {
    state += sizeof(KeptHit) * EyeShape::of(settings, limits).hits;
  }
  return {"checkpoint", 2 * state, false, Phase::render, Phase::render};
}

const MemoryPart& largest_part(const MemoryPlan& plan) {
  const std::vector<const MemoryPart*> parts = parts_at_peak(plan);
  const bool is_program = parts.front()->name == kProgramName && parts.size() > 1;
  return *parts[is_program ? 1 : 0];
}

std::string describe_peak(const MemoryPlan& plan) {
  std::string text;
  std::uint64_t rest = 0;
  for (const MemoryPart* part : parts_at_peak(plan)) {
    if (part->bytes < plan.peak() / kSmallPart) {
      rest += part->bytes;
    } else {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", part->name, size_text(part->bytes));
    }
  }
  return text + (rest > 0 ? ", others " + size_text(rest) : "");
}

std::string size_text(std::uint64_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (value >= 999.5 * (1u << 20)) return fmt::format("{:.3g} GiB", value / (1u << 30));
  if (value >= 999.5 * (1u << 10)) return fmt::format("{:.3g} MiB", value / (1u << 20));
  return fmt::format("{:.3g} KiB", value / (1u << 10));
}

}  // namespace ppm::render
