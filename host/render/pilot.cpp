#include "pilot.hpp"

#include "ppm_shaders.hpp"
#include "shared/layout.h"

namespace ppm::render {
namespace {

// Photons wanted in a first disc: with some ten a pass the law of radii holds from the start.
constexpr std::uint32_t kPilotPhotons = 20;
// A first disc is never smaller than this many footprints of its pixel.
constexpr float kLeastFootprints = 0.5f;

constexpr std::uint32_t kDecide = 0;  // specialisation constant of pilot.comp

shared::PilotPush push_of(const Pilot::Round& round) {
  shared::PilotPush push{};
  push.round_index = round.index;
  push.last_round = round.last ? 1 : 0;
  push.radius = round.radius;
  push.footprints_min = kLeastFootprints;
  push.wanted = kPilotPhotons;
  return push;
}

}  // namespace

Pilot::Pilot(gpu::Device& device, const SceneTraits& traits, std::span<const HitTile> tiles)
    : device_(device),
      tiles_(tiles),
      traits_(traits),
      decide_at_once_(
          make_kernel(device, traits, shaders::pilot, shaders::pilot_plain, {{kDecide, 1}})),
      counters_(device) {
  const auto list = [&](const char* name, const HitTile& tile) {
    return gpu::Buffer(device, name, tile.hits * 4ull, gpu::Usage::storage);
  };
  for (const HitTile& tile : tiles) {
    undecided_.push_back({{list("undecided A", tile), list("undecided B", tile)}, tile.hits});
  }
}

gpu::BindingTable Pilot::table_for(const HitTile& tile) const {
  gpu::BindingTable table;
  tile.bind(table);
  counters_.bind(table);
  return table;
}

std::optional<std::uint64_t> Pilot::decide(const PhotonGrid& grid, const Round& round,
                                           bool coarse) {
  shared::PilotPush push = push_of(round);
  push.grid = grid.constants();
  push.from_list = round.index == 0 ? 0 : 1;
  push.coarse = coarse ? 1 : 0;
  std::vector<std::uint32_t> left(tiles_.size());
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    gpu::BindingTable table = table_for(tiles_[i]);
    grid.bind(table);
    table.set(PPM_BIND_CONTINUE_IN, undecided_[i].list[round.index % 2]);
    table.set(PPM_BIND_CONTINUE_OUT, undecided_[i].list[(round.index + 1) % 2]);
    device_.run([&](gpu::Recorder& recorder) {
      counters_.clear(recorder);
      recorder.dispatch(decide_at_once_, table, push, undecided_[i].count);
      counters_.read(recorder);
    });
    if (counters_[PPM_COUNTER_CROWDED] > 0) return std::nullopt;
    left[i] = counters_[PPM_COUNTER_UNDECIDED];
    sum += left[i];
  }
  for (std::size_t i = 0; i < tiles_.size(); ++i) undecided_[i].count = left[i];
  return sum;
}

void Pilot::count(const PhotonGrid& grid, const Round& round) {
  if (!count_) count_ = make_kernel(device_, traits_, shaders::pilot, shaders::pilot_plain);
  shared::PilotPush push = push_of(round);
  push.grid = grid.constants();
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    gpu::BindingTable table = table_for(tiles_[i]);
    grid.bind(table);
    table.set(PPM_BIND_CONTINUE_IN, undecided_[i].list[0]);
    table.set(PPM_BIND_CONTINUE_OUT, undecided_[i].list[1]);
    device_.run(
        [&](gpu::Recorder& recorder) { recorder.dispatch(*count_, table, push, tiles_[i].hits); });
  }
}

std::uint64_t Pilot::decide(const Round& round) {
  if (!decide_) decide_.emplace(device_, shaders::pilot_decide);
  std::uint64_t sum = 0;
  for (const HitTile& tile : tiles_) {
    device_.run([&](gpu::Recorder& recorder) {
      counters_.clear(recorder);
      recorder.dispatch(*decide_, table_for(tile), push_of(round), tile.hits);
      counters_.read(recorder);
    });
    sum += counters_[PPM_COUNTER_UNDECIDED];
  }
  return sum;
}

}  // namespace ppm::render
