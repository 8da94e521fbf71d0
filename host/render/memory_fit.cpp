#include "memory_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "portions.hpp"

namespace ppm::render {
namespace {

// Smaller chunks would take hardly less beside what else there is.
constexpr std::uint64_t kFewestPhotons = 1u << 14;
// That a path leaves: with fewer in memory every pass is traced in chunks.
constexpr std::uint64_t kPhotonsAPath = 4;

/// What is beyond the limits, summed over all phases and limits: 0 where it fits.
std::uint64_t excess(const MemoryPlan& plan, const MemoryLimits& limits) {
  std::uint64_t sum = 0;
  const auto add = [&](std::uint64_t bytes, std::uint64_t most) {
    sum += bytes > most ? bytes - most : 0;
  };
  for (const Phase phase : kPhases) {
    const std::uint64_t host = plan.held(phase, false), device = plan.held(phase, true);
    if (limits.budget) {
      add(host + device, *limits.budget);
    } else {
      add(limits.device ? host : host + device, limits.machine);
    }
    if (limits.device) add(device, *limits.device);
  }
  return sum;
}

bool has_photons(const Settings& settings) {
  return method_named(settings.integrator).unit == PassUnit::photons;
}

Settings with(const Settings& settings, const Portions& portions) {
  Settings changed = settings;
  changed.tile_hits = portions.tile_hits;
  changed.photon_capacity = portions.photons;
  return changed;
}

class Search {
 public:
  Search(const MemoryDemand& demand, const MemoryLimits& limits)
      : demand_(demand), limits_(limits) {}

  std::uint64_t excess_of(const Settings& settings) const {
    return excess(demand_.plan(settings), limits_);
  }

  /// Halves portions, always that which helps most, down to `fewest`.
  Settings halved(const Settings& settings, const Portions& fewest) const {
    Portions now = method_portions(settings, demand_.limits);
    Settings best = settings;
    std::uint64_t left = excess_of(best);
    while (left > 0) {
      Portions choices[] = {now, now};
      choices[0].tile_hits /= 2;
      choices[1].photons /= 2;
      const std::uint64_t before = left;
      for (const Portions& choice : choices) {
        if (choice.tile_hits < fewest.tile_hits || choice.photons < fewest.photons) continue;
        const std::uint64_t more = excess_of(with(settings, choice));
        if (more >= left) continue;
        left = more;
        now = choice;
      }
      if (left == before) break;
      best = with(settings, now);
    }
    return best;
  }

  /// Of those that fit and differ in one number, in portions of 1024.
  Settings enlarged(Settings settings, std::uint64_t Settings::*portion, std::uint64_t most) const {
    constexpr std::uint64_t kUnit = 1024;
    const std::uint64_t least = settings.*portion / kUnit;
    const auto fits_with = [&](std::uint64_t units) {
      Settings larger = settings;
      larger.*portion = units * kUnit;
      return excess_of(larger) == 0;
    };
    const auto units = largest_where(least + 1, most / kUnit, fits_with);
    if (units) settings.*portion = *units * kUnit;
    return settings;
  }

 private:
  const MemoryDemand& demand_;
  const MemoryLimits& limits_;
};

/// What is left for the device.
std::uint64_t allowance(const MemoryPlan& plan, Phase phase, const MemoryLimits& limits) {
  const std::uint64_t host = plan.held(phase, false);
  const std::uint64_t all = limits.budget.value_or(limits.machine);
  const std::uint64_t shared = all > host ? all - host : 0;
  if (!limits.device) return shared;
  return limits.budget ? std::min(shared, *limits.device) : *limits.device;
}

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, " ");
  return text;
}

}  // namespace

MemoryPlan MemoryDemand::plan(const Settings& settings) const {
  MemoryPlan plan = memory_plan(scene, settings, limits);
  for (MemoryPart& part : layers_memory(settings, limits, layers)) {
    plan.parts.push_back(std::move(part));
  }
  if (checkpoint) plan.parts.push_back(checkpoint_memory(settings, limits));
  return plan;
}

bool fits(const MemoryPlan& plan, const MemoryLimits& limits) {
  return excess(plan, limits) == 0;
}

MemoryFit fit_memory(const MemoryDemand& demand, const Settings& settings,
                     const MemoryLimits& limits) {
  const Search search(demand, limits);
  const auto finished = [&](Settings fitted) {
    MemoryFit fit{std::move(fitted), {}, false};
    fit.plan = demand.plan(fit.settings);
    fit.fits = fits(fit.plan, limits);
    fit.settings.eye_allowance = allowance(fit.plan, Phase::eye, limits);
    fit.settings.pass_allowance = allowance(fit.plan, Phase::render, limits);
    return fit;
  };
  if (search.excess_of(settings) == 0) return finished(settings);

  const Portions most = method_portions(settings, demand.limits);
  Portions fewest = most;
  fewest.tile_hits = std::min(most.tile_hits, most.fewest_tile_hits);
  const std::uint64_t few = has_photons(settings) ? kFewestPhotons : most.photons;
  // Chunks of a pass cost less than tracing hit points anew, for which they would be traced anew.
  const std::uint64_t of_a_pass = std::max(few, kPhotonsAPath * settings.photons_per_pass);
  Settings best = settings;
  for (const bool thrifty : {false, true}) {
    for (const std::uint64_t photons : {of_a_pass, few}) {
      Settings start = settings;
      start.traces_anew = settings.traces_anew || (thrifty && has_photons(settings));
      start.keeps_film = settings.keeps_film && (!thrifty || has_photons(settings));
      fewest.photons = std::min(photons, most.photons);
      best = search.halved(start, fewest);
      if (search.excess_of(best) > 0) continue;
      if (best.tile_hits < most.tile_hits) {
        best = search.enlarged(best, &Settings::tile_hits, most.tile_hits);
      }
      if (has_photons(best) && best.photon_capacity < most.photons && best.photon_capacity > 0) {
        best = search.enlarged(best, &Settings::photon_capacity, most.photons);
      }
      return finished(best);
    }
  }
  return finished(best);
}

std::string describe_change(const MemoryDemand& demand, const Settings& asked,
                            const Settings& fitted) {
  std::vector<std::string> changes;
  const Portions before = method_portions(asked, demand.limits),
                 after = method_portions(fitted, demand.limits);
  const char* const what = has_photons(asked) ? "hit points" : "paths";
  if (after.tile_hits < before.tile_hits) {
    changes.push_back(fmt::format("tiles of {} {} instead of {}", grouped(after.tile_hits), what,
                                  grouped(before.tile_hits)));
  }
  if (after.photons < before.photons) {
    changes.push_back(fmt::format("{} photons at a time instead of {}", grouped(after.photons),
                                  grouped(before.photons)));
  }
  if (fitted.traces_anew && !asked.traces_anew) {
    changes.push_back("eye paths traced anew for each pass");
  }
  if (!fitted.keeps_film && asked.keeps_film) {
    changes.push_back("no copy of the film, so that a pass is finished when interrupted");
  }
  return fmt::format("{}", fmt::join(changes, ", "));
}

std::optional<std::uint64_t> largest_where(std::uint64_t least, std::uint64_t most,
                                           const std::function<bool(std::uint64_t)>& good) {
  if (least > most || !good(least)) return std::nullopt;
  while (least < most) {
    const std::uint64_t middle = most - (most - least) / 2;
    if (good(middle)) {
      least = middle;
    } else {
      most = middle - 1;
    }
  }
  return least;
}

std::vector<std::string> what_would_fit(const MemoryDemand& demand, const Settings& settings,
                                        const MemoryLimits& limits) {
  std::vector<std::string> ways;
  const auto add = [&](const char* option, std::uint64_t now,
                       const std::function<void(Settings&, std::uint64_t)>& set) {
    const auto most = largest_where(1, now - 1, [&](std::uint64_t value) {
      Settings changed = settings;
      set(changed, value);
      return fit_memory(demand, changed, limits).fits;
    });
    if (most) ways.push_back(fmt::format("{} {}", option, *most));
  };
  const double aspect = static_cast<double>(settings.height) / settings.width;
  add("--width", settings.width, [&](Settings& changed, std::uint64_t width) {
    changed.width = static_cast<std::uint32_t>(width);
    changed.height =
        static_cast<std::uint32_t>(std::max(1.0, std::round(aspect * static_cast<double>(width))));
  });
  if (has_photons(settings)) {
    add("--spp", settings.samples_per_pixel, [](Settings& changed, std::uint64_t samples) {
      changed.samples_per_pixel = static_cast<std::uint32_t>(samples);
    });
  }
  if (method_named(settings.integrator).has_option("--map-photons")) {
    add("--map-photons", settings.map_photons,
        [](Settings& changed, std::uint64_t photons) { changed.map_photons = photons; });
  }
  return ways;
}

std::uint64_t least_budget(const MemoryDemand& demand, const Settings& settings) {
  constexpr std::uint64_t kUnit = std::uint64_t{1} << 20;
  const std::uint64_t enough = demand.plan(settings).peak() / kUnit + 1;
  const auto too_little = [&](std::uint64_t units) {
    return !fit_memory(demand, settings, {units * kUnit, 0, std::nullopt}).fits;
  };
  return (largest_where(1, enough, too_little).value_or(0) + 1) * kUnit;
}

}  // namespace ppm::render
