// What a comparison is asked to do, as plain values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "integrator.hpp"

namespace ppm::compare {

/// A method with all its settings but the seed.
struct Method {
  std::string label;  ///< as the user wrote it: "ppm", "ppm:alpha=0.8"
  render::Settings settings;
};

struct PixelPosition {
  std::uint32_t x = 0, y = 0;  ///< from the top left corner
  bool operator==(const PixelPosition&) const = default;
};

/// A part of the picture that the page shows enlarged.
struct Crop {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;  ///< pixels
};

struct ReferencePlan {
  std::filesystem::path file;  ///< of the user; empty: it is made
  double seconds = 0.0;        ///< rendering time in all, split evenly among the seeds
  unsigned seeds = 4;          ///< 1 or more
  /// Makes it without being asked twice (--reference-method).
  std::optional<Method> method;
  /// Else the first of these that finds the light makes it ...
  std::vector<Method> candidates;
  /// ... and this one where none does. It is the judge of whether they do, too.
  Method photons;
};

/// The paper's Figures 4 and 5: one rendering by ppm, a pass at a time.
struct FigurePlan {
  std::optional<Method> method;       ///< nothing: no figures are asked for
  std::vector<PixelPosition> probes;  ///< Figure 4: where hit points are watched
  std::vector<std::uint64_t> passes;  ///< Figure 5: after how many passes pictures are kept
  std::uint64_t last_pass = 0;        ///< passes in all
};

struct Plan {
  std::vector<Method> methods;  ///< one or more, of different directory_name
  std::uint32_t first_seed = 0;
  unsigned seeds = 1;
  double seconds = 60.0;  ///< of rendering, for each method and seed
  ReferencePlan reference;
  FigurePlan figures;
  std::vector<Crop> crops;         ///< empty: where methods differ most
  std::optional<double> exposure;  ///< of all that is shown, powers of two; nothing: what suits
};

/// Seconds after which pictures are kept: `seconds` and its halves, quarters ... down to a 128th,
/// ascending.
std::vector<double> moments_of(double seconds);

/// The paper's: 1, 16, 64, 256 and 1024 passes, those up to `last`, and `last`.
std::vector<std::uint64_t> figure5_passes(std::uint64_t last);

/// The same method with the settings that a reference by photons has, so that what it has in common
/// with a rendering by `settings` is as little as may be: another alpha, another first radius, four
/// times the eye paths where they do not get too many.
render::Settings reference_settings(render::Settings settings);

/// Seeds that no rendering of the comparison has.
std::uint32_t reference_seed(const Plan& plan, unsigned index);
std::uint32_t trial_seed(const Plan& plan, unsigned index);

/// What a label is called in file names and links: letters, digits, dots and hyphens alone.
std::string directory_name(const std::string& label);

/// Throws Failure where two methods have one directory_name, or where probes or crops lie outside
/// of the picture.
void check_plan(const Plan& plan);

}  // namespace ppm::compare
