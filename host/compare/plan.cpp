#include "plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "failure.hpp"

namespace ppm::compare {
namespace {

constexpr int kHalvings = 7;
constexpr std::uint64_t kPaperPasses[] = {1, 16, 64, 256, 1024};
// Less than any alpha in use: the reference's radii shrink faster, so that what it lacks shows in
// its error bars rather than hides in its bias.
constexpr double kReferenceAlpha = 0.6, kOtherAlpha = 0.55;
constexpr std::uint64_t kMostEyePaths = 4u << 20;
constexpr std::uint32_t kReferenceSeeds = 0x40000000u, kTrialSeeds = 0x50000000u;

}  // namespace

std::vector<double> moments_of(double seconds) {
  std::vector<double> moments;
  for (int halvings = kHalvings; halvings >= 0; --halvings) {
    moments.push_back(seconds / static_cast<double>(1 << halvings));
  }
  return moments;
}

std::vector<std::uint64_t> figure5_passes(std::uint64_t last) {
  std::vector<std::uint64_t> passes;
  for (const std::uint64_t count : kPaperPasses) {
    if (count < last) passes.push_back(count);
  }
  passes.push_back(last);
  return passes;
}

render::Settings reference_settings(render::Settings settings) {
  using render::RadiusMode;
  settings.alpha = settings.alpha == kReferenceAlpha ? kOtherAlpha : kReferenceAlpha;
  settings.radius_mode =
      settings.radius_mode == RadiusMode::footprint ? RadiusMode::automatic : RadiusMode::footprint;
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  if (4 * pixels * settings.samples_per_pixel <= kMostEyePaths) settings.samples_per_pixel *= 4;
  return settings;
}

std::uint32_t reference_seed(const Plan& plan, unsigned index) {
  return plan.first_seed + kReferenceSeeds + index;
}

std::uint32_t trial_seed(const Plan& plan, unsigned index) {
  return plan.first_seed + kTrialSeeds + index;
}

std::string directory_name(const std::string& label) {
  std::string name = label;
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return !std::isalnum(c) && c != '.' && c != '-'; }, '_');
  return name.starts_with('.') ? "_" + name : name;
}

void check_plan(const Plan& plan) {
  PPM_ASSERT(!plan.methods.empty(), "nothing to compare");
  std::set<std::string> names;
  for (const Method& method : plan.methods) {
    if (!names.insert(directory_name(method.label)).second) {
      throw Failure("", "--methods", method.label + " is there twice", "name each method once");
    }
  }
  const render::Settings& settings = plan.methods.front().settings;
  const std::string size = fmt::format("{} x {} pixels", settings.width, settings.height);
  for (const PixelPosition& probe : plan.figures.probes) {
    if (probe.x >= settings.width || probe.y >= settings.height) {
      throw Failure("", "--probe", fmt::format("{},{} is outside of the picture", probe.x, probe.y),
                    "it has " + size);
    }
  }
  for (const Crop& crop : plan.crops) {
    if (std::uint64_t{crop.x} + crop.width > settings.width ||
        std::uint64_t{crop.y} + crop.height > settings.height) {
      throw Failure("", "--crop",
                    fmt::format("{},{},{},{} reaches out of the picture", crop.x, crop.y,
                                crop.width, crop.height),
                    "it has " + size);
    }
  }
}

}  // namespace ppm::compare
