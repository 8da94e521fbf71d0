#include "memory_budget.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

#include "failure.hpp"

namespace ppm::cli {
namespace {

constexpr double kMostBytes = 1e18;

/// What would help most beside more memory; empty: nothing, since photons are held in portions that
/// have become as small as they can.
std::string remedy_for(const render::MemoryPlan& plan) {
  const std::string largest = render::largest_part(plan).name;
  if (largest.starts_with("textures")) return "scale textures down";
  if (largest.find("environment") != std::string::npos) return "scale the environment down";
  if (largest.find("hit points") != std::string::npos || largest == "picture") {
    return "make the picture smaller or lower --spp";
  }
  if (largest == "checkpoint") return "make the picture smaller or do without --checkpoint";
  if (largest == "film") return "make the picture smaller";
  if (largest == "photons") return "";
  if (largest == "photon map") return "lower --map-photons";
  return "simplify meshes or use fewer instances";
}

/// "A, B or C".
std::string alternatives(const std::vector<std::string>& ways) {
  std::string text = ways.front();
  for (std::size_t i = 1; i < ways.size(); ++i) {
    text += (i + 1 < ways.size() ? ", " : " or ") + ways[i];
  }
  return text;
}

/// Of a picture that is known; nothing where no other one would fit.
std::string computed_remedy(const render::MemoryDemand& demand, const render::Settings& settings,
                            const MemoryLimits& limits) {
  std::vector<std::string> ways = render::what_would_fit(demand, settings, limits);
  if (ways.empty()) return "";
  if (limits.budget) {
    ways.push_back(
        fmt::format("--memory-budget {}M", render::least_budget(demand, settings) >> 20));
  }
  return alternatives(ways) + " would do";
}

}  // namespace

std::optional<std::uint64_t> parse_size(std::string_view text) {
  double unit = 1.0;
  if (!text.empty()) {
    const char last = text.back();
    const std::size_t power = std::string_view("KMGTkmgt").find(last);
    if (power != std::string_view::npos) {
      unit = std::exp2(10.0 * static_cast<double>(power % 4 + 1));
      text.remove_suffix(1);
    }
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  const double bytes = value * unit;
  if (!(bytes >= 1.0) || bytes > kMostBytes) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

render::MemoryFit fit_or_refuse(const std::string& file, const render::MemoryDemand& demand,
                                const render::Settings& settings, const MemoryLimits& limits,
                                Known known) {
  render::MemoryFit fit = render::fit_memory(demand, settings, limits);
  if (fit.fits) return fit;
  const render::MemoryPlan& plan = fit.plan;
  const auto refuse = [&](const char* place, std::uint64_t bytes, const std::string& limit,
                          const std::string& more_memory) {
    std::string remedy =
        known == Known::all ? computed_remedy(demand, settings, limits) : std::string();
    if (remedy.empty()) {
      remedy = remedy_for(plan);
      remedy += (remedy.empty() ? "" : ", or ") + more_memory;
    }
    throw Failure(
        file, place,
        fmt::format("a rendering takes {}{} ({}), but {}", known == Known::all ? "" : "at least ",
                    render::size_text(bytes), render::describe_peak(plan), limit),
        remedy);
  };
  if (limits.budget && plan.peak() > *limits.budget) {
    refuse(
        "--memory-budget", plan.peak(),
        fmt::format("may take {}", render::size_text(*limits.budget)),
        fmt::format("raise --memory-budget to {}M{}", render::least_budget(demand, settings) >> 20,
                    known == Known::all ? "" : " or more"));
  }
  const std::uint64_t on_host = limits.device ? plan.host_peak() : plan.peak();
  if (!limits.budget && on_host > limits.machine) {
    refuse("memory", on_host,
           fmt::format("the machine has {} left", render::size_text(limits.machine)),
           "go ahead with a --memory-budget");
  }
  refuse("device memory", plan.device_peak(),
         fmt::format("the device has {} left", render::size_text(*limits.device)),
         "choose another --device");
  return fit;
}

}  // namespace ppm::cli
