// How renderings are fitted into the memory there is: reckoned alone, nothing is rendered.
#include "memory_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "portions.hpp"

namespace ppm::tests {
namespace {

using render::MemoryDemand;
using render::MemoryFit;
using render::MemoryLimits;

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20, kGiB = std::uint64_t{1} << 30;

render::PassLimits limits_of_gpu() {
  return {gpu::device_profile(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU), std::uint64_t{1} << 32,
          18 * kMiB};
}

MemoryDemand demand_of(const render::PassLimits& limits) {
  return {{.triangles = 100000}, limits, {}, false};
}

MemoryLimits budget_of(std::uint64_t bytes) {
  return {bytes, 0, std::nullopt};
}

bool same_portions(const render::Settings& a, const render::Settings& b) {
  return a.tile_hits == b.tile_hits && a.photon_capacity == b.photon_capacity &&
         a.traces_anew == b.traces_anew && a.keeps_film == b.keeps_film;
}

std::uint64_t bytes_of(const render::MemoryPlan& plan, const std::string& name) {
  const auto part = std::ranges::find(plan.parts, name, &render::MemoryPart::name);
  return part == plan.parts.end() ? 0 : part->bytes;
}

// What is cut into portions is as large with the whole ones as with the settings, and smaller with
// smaller ones. Small passes, for a map that is many times as large as one.
TEST(MemoryFit, WholePortionsAreThoseOfTheSettings) {
  for (const render::PassLimits& limits : {render::PassLimits::of_cpu(), limits_of_gpu()}) {
    const MemoryDemand demand = demand_of(limits);
    for (const render::Method& method : render::methods()) {
      render::Settings settings;
      settings.integrator = method.name;
      settings.photons_per_pass = 1000;
      const render::Portions whole = render::method_portions(settings, limits);
      render::Settings portioned = settings;
      portioned.tile_hits = whole.tile_hits;
      portioned.photon_capacity = whole.photons;
      const render::MemoryPlan plan = demand.plan(settings), same = demand.plan(portioned);
      for (const char* const name : {"hit points", "photon map", "paths", "sub-paths", "chains"}) {
        EXPECT_EQ(bytes_of(same, name), bytes_of(plan, name)) << method.name << ' ' << name;
      }
      portioned.tile_hits = whole.tile_hits * 3 / 4;
      EXPECT_LT(demand.plan(portioned).peak(), same.peak()) << method.name;
    }
  }
}

// Chains are stepped together.
TEST(MemoryFit, FewestPathsAreThoseOfAllChains) {
  render::Settings settings;
  settings.integrator = "mlt";
  settings.mlt_chains = 5000;
  EXPECT_EQ(render::method_portions(settings, limits_of_gpu()).fewest_tile_hits, 5000u);
}

TEST(MemoryFit, ChangesNothingWhereAllFits) {
  for (const render::PassLimits& limits : {render::PassLimits::of_cpu(), limits_of_gpu()}) {
    const MemoryDemand demand = demand_of(limits);
    for (const render::Method& method : render::methods()) {
      render::Settings settings;
      settings.integrator = method.name;
      const std::uint64_t peak = demand.plan(settings).peak();
      const MemoryFit fit = render::fit_memory(demand, settings, budget_of(peak));
      EXPECT_TRUE(fit.fits);
      EXPECT_TRUE(same_portions(fit.settings, settings)) << method.name;
      EXPECT_EQ(render::describe_change(demand, settings, fit.settings), "");
      EXPECT_FALSE(same_portions(render::fit_memory(demand, settings, budget_of(peak - 1)).settings,
                                 settings))
          << method.name;
    }
  }
}

// Of every method, on small and large devices, at every budget from what is usual down: it fits or
// is refused, less memory never makes tiles larger, and nothing that fits could have tiles of
// 2048 more.
TEST(MemoryFit, TakesTheLargestTilesThatFit) {
  for (const render::PassLimits& limits : {render::PassLimits::of_cpu(), limits_of_gpu()}) {
    const MemoryDemand demand = demand_of(limits);
    for (const render::Method& method : render::methods()) {
      SCOPED_TRACE(method.name);
      render::Settings settings;
      settings.integrator = method.name;
      settings.width = 1920;
      settings.height = 1080;
      const std::uint64_t usual = demand.plan(settings).peak();
      unsigned fitted = 0;
      for (std::uint64_t budget = usual; budget > usual / 16; budget = budget / 10 * 9) {
        const MemoryFit fit = render::fit_memory(demand, settings, budget_of(budget));
        EXPECT_EQ(fit.fits, fit.plan.peak() <= budget);
        EXPECT_EQ(fit.plan.peak(), demand.plan(fit.settings).peak());
        if (!fit.fits) continue;
        ++fitted;
        if (fit.settings.tile_hits >= settings.tile_hits || method.name == "mlt") continue;
        render::Settings larger = fit.settings;
        larger.tile_hits += 2048;
        const bool would_fit = render::fits(demand.plan(larger), budget_of(budget));
        // A picture that is smaller than a tile leaves larger tiles as they are.
        EXPECT_TRUE(!would_fit || demand.plan(larger).peak() == fit.plan.peak()) << budget;
      }
      EXPECT_GT(fitted, 1u);
    }
  }
}

// By hand: of 4 eye paths and 1.25 hit points to each of 33 million paths all would take 41.5
// million times 128 bytes and more; kept are 20 each.
TEST(MemoryFit, HitPointsThatDoNotFitAreTracedAnew) {
  const MemoryDemand demand = demand_of(limits_of_gpu());
  render::Settings settings;
  settings.width = 3840;
  settings.height = 2160;
  const double hits = 1.25 * 4 * 3840 * 2160;
  const MemoryFit roomy =
      render::fit_memory(demand, settings, {std::nullopt, 64 * kGiB, 24 * kGiB});
  EXPECT_TRUE(roomy.fits);
  EXPECT_FALSE(roomy.settings.traces_anew);
  EXPECT_GT(static_cast<double>(roomy.plan.device_peak()), 128 * hits);
  const MemoryFit small = render::fit_memory(demand, settings, {std::nullopt, 64 * kGiB, 2 * kGiB});
  EXPECT_TRUE(small.fits);
  EXPECT_TRUE(small.settings.traces_anew);
  EXPECT_LE(small.plan.device_peak(), 2 * kGiB);
  EXPECT_GT(static_cast<double>(small.plan.host_peak()), 20 * hits);
  EXPECT_LE(small.settings.eye_allowance, 2 * kGiB);
  // Photons of a pass are still traced in one go.
  EXPECT_GE(render::pass_capacities(small.settings, demand.limits).photons, 400000u);
}

TEST(MemoryFit, WhatIsTooMuchForTheHostIsNotHelpedByTheDevice) {
  const MemoryDemand demand = demand_of(limits_of_gpu());
  const render::Settings settings;
  const std::uint64_t host = demand.plan(settings).host_peak();
  EXPECT_FALSE(render::fit_memory(demand, settings, {std::nullopt, host / 2, 64 * kGiB}).fits);
  EXPECT_TRUE(render::fit_memory(demand, settings, {std::nullopt, host, 64 * kGiB}).fits);
}

// A budget for all is none for the device, which has what it has.
TEST(MemoryFit, ABudgetDoesNotMakeADeviceLarger) {
  const MemoryDemand demand = demand_of(limits_of_gpu());
  const render::Settings settings;
  const std::uint64_t usual = demand.plan(settings).device_peak();
  const MemoryFit fit = render::fit_memory(demand, settings, {64 * kGiB, 0, usual - 1});
  EXPECT_TRUE(fit.fits);
  EXPECT_LT(fit.plan.device_peak(), usual);
  EXPECT_LT(fit.settings.eye_allowance, usual);
}

TEST(MemoryFit, SaysWhatItChanged) {
  const MemoryDemand demand = demand_of(render::PassLimits::of_cpu());
  render::Settings settings, fitted;
  fitted.tile_hits = 40000;
  fitted.traces_anew = true;
  EXPECT_EQ(render::describe_change(demand, settings, fitted),
            "tiles of 40 000 hit points instead of 1 048 576, eye paths traced anew for each pass");
  settings.integrator = fitted.integrator = "bdpt";
  fitted.keeps_film = fitted.traces_anew = false;
  EXPECT_EQ(render::describe_change(demand, settings, fitted),
            "tiles of 40 000 paths instead of 262 144, no copy of the film, so that a pass is "
            "finished when interrupted");
}

TEST(MemoryFit, LargestOfThoseThatAreGood) {
  for (const std::uint64_t limit : {1u, 2u, 7u, 8u, 100u}) {
    const auto good = [&](std::uint64_t value) { return value <= limit; };
    EXPECT_EQ(render::largest_where(1, 100, good), limit);
    EXPECT_EQ(render::largest_where(3, 2, good), std::nullopt);
    EXPECT_EQ(render::largest_where(101, 200, good), std::nullopt);
  }
}

/// The number behind `option` in a refusal.
std::uint64_t suggested(const std::vector<std::string>& ways, const std::string& option) {
  for (const std::string& way : ways) {
    if (way.starts_with(option + " ")) return std::stoull(way.substr(option.size() + 1));
  }
  ADD_FAILURE() << option;
  return 0;
}

// What is suggested fits, and one more does not.
TEST(MemoryFit, SuggestionsAreTheLargestThatFit) {
  const MemoryDemand demand = demand_of(render::PassLimits::of_cpu());
  const MemoryLimits limits = budget_of(300 * kMiB);
  render::Settings settings;
  settings.width = 4000;
  settings.height = 3000;
  settings.integrator = "pm";
  settings.map_photons = 500000;
  settings.samples_per_pixel = 16;
  ASSERT_FALSE(render::fit_memory(demand, settings, limits).fits);
  const auto fits_with = [&](std::uint64_t width) {
    render::Settings changed = settings;
    changed.width = static_cast<std::uint32_t>(width);
    changed.height = static_cast<std::uint32_t>(std::max(1.0, std::round(0.75 * changed.width)));
    return render::fit_memory(demand, changed, limits).fits;
  };
  const std::uint64_t width =
      suggested(render::what_would_fit(demand, settings, limits), "--width");
  EXPECT_TRUE(fits_with(width)) << width;
  EXPECT_FALSE(fits_with(width + 1)) << width;
  const std::uint64_t budget = render::least_budget(demand, settings);
  EXPECT_TRUE(render::fit_memory(demand, settings, budget_of(budget)).fits);
  EXPECT_FALSE(render::fit_memory(demand, settings, budget_of(budget - kMiB)).fits);
  // No picture of a scene like this one fits.
  MemoryDemand large = demand;
  large.scene.triangles = 50000000;
  EXPECT_TRUE(render::what_would_fit(large, settings, limits).empty());
}

}  // namespace
}  // namespace ppm::tests
