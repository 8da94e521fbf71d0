#include "memory_budget.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "failure.hpp"

namespace ppm::cli {
namespace {

constexpr double kMostBytes = 1e18;

/// What would help most.
std::string remedy_for(const render::MemoryPlan& plan) {
  const std::string largest = render::largest_part(plan).name;
  if (largest.starts_with("textures")) return "scale textures down";
  if (largest.find("environment") != std::string::npos) return "scale the environment down";
  if (largest.starts_with("hit points") || largest == "picture") {
    return "make the picture smaller or lower --spp";
  }
  if (largest == "checkpoint") return "make the picture smaller or do without --checkpoint";
  if (largest == "film") {
    return "make the picture smaller";
  }
  if (largest == "photons") return "lower --photons";
  if (largest == "photon map") return "lower --map-photons";
  return "simplify meshes or use fewer instances";
}

[[noreturn]] void refuse(const std::string& file, const render::MemoryPlan& plan, const char* place,
                         std::uint64_t bytes, const std::string& limit, const char* other_remedy) {
  throw Failure(
      file, place,
      fmt::format("a rendering takes {}{} ({}), but {}", plan.is_complete ? "" : "at least ",
                  render::size_text(bytes), render::describe_peak(plan), limit),
      remedy_for(plan) + other_remedy);
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

void check_memory(const std::string& file, const render::MemoryPlan& plan,
                  const MemoryLimits& limits) {
  if (limits.budget) {
    if (plan.peak() <= *limits.budget) return;
    refuse(file, plan, "--memory-budget", plan.peak(),
           fmt::format("may take {}", render::size_text(*limits.budget)),
           ", or raise --memory-budget");
  }
  const std::uint64_t on_host = limits.device ? plan.host_peak() : plan.peak();
  if (on_host > limits.machine) {
    refuse(file, plan, "memory", on_host,
           fmt::format("the machine has {} left", render::size_text(limits.machine)),
           ", or go ahead with a --memory-budget");
  }
  if (limits.device && plan.device_peak() > *limits.device) {
    refuse(file, plan, "device memory", plan.device_peak(),
           fmt::format("the device has {} left", render::size_text(*limits.device)),
           ", or choose another --device");
  }
}

}  // namespace ppm::cli
