// How much of the work is held at a time, so that a rendering fits the memory there is.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "layers.hpp"
#include "memory_plan.hpp"

namespace ppm::render {

/// What a rendering may take.
struct MemoryLimits {
  std::optional<std::uint64_t> budget;  ///< --memory-budget: in all, instead of the machine's
  std::uint64_t machine = 0;            ///< what the machine has left
  /// Of a device with memory of its own; nothing: it shares the machine's, or is not known yet.
  std::optional<std::uint64_t> device;
};

/// All that decides what a rendering takes, but for the settings.
struct MemoryDemand {
  scene::SceneSize scene;
  PassLimits limits;
  std::span<const LayerKind> layers;
  bool checkpoint = false;

  MemoryPlan plan(const Settings& settings) const;
};

bool fits(const MemoryPlan& plan, const MemoryLimits& limits);

/// The settings as they are where that fits. Else with smaller tiles and portions of photons, as
/// large as they may be; and where that does not suffice with hit points that are traced anew and
/// films that are not kept. The picture is the same to the byte. The allowances say what is left
/// for the device. Where nothing helps it is the least that can be had, and does not fit.
struct MemoryFit {
  Settings settings;
  MemoryPlan plan;
  bool fits = false;
};
MemoryFit fit_memory(const MemoryDemand& demand, const Settings& settings,
                     const MemoryLimits& limits);

/// "tiles of 40 000 hit points instead of 1 200 000": what fit_memory has changed; empty: nothing.
std::string describe_change(const MemoryDemand& demand, const Settings& asked,
                            const Settings& fitted);

/// The largest number in [least, most] that `good` holds for, if it does for all below; nothing
/// where it does for none.
std::optional<std::uint64_t> largest_where(std::uint64_t least, std::uint64_t most,
                                           const std::function<bool(std::uint64_t)>& good);

/// What of the picture would have to change for it to fit after all, each by itself: "--width 300",
/// "--spp 1", "--map-photons 400000". As large as it may be; none where the scene is too large.
std::vector<std::string> what_would_fit(const MemoryDemand& demand, const Settings& settings,
                                        const MemoryLimits& limits);
/// The least budget that suffices.
std::uint64_t least_budget(const MemoryDemand& demand, const Settings& settings);

}  // namespace ppm::render
