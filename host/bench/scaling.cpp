#include "scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dark_room.hpp"
#include "room.hpp"
#include "statistics.hpp"
#include "uneven_room.hpp"

namespace ppm::bench {
namespace {

constexpr std::size_t kManyTriangles = 700000;
constexpr std::uint64_t kPhotonFactor = 10;
constexpr double kHitFactor = 10.0 / 3.0;

/// Times of a case, added up, against those of the room.
struct Ratio {
  const char* what;
  const char* subject;
  std::vector<const char*> rows;
  double goal;
};

const std::vector<Ratio> kRatios = {
    {"700k triangles instead of 73k: pass", "room-700k", {"/pass"}, 1.5},
    {"10/3 the hit points: update", "room-hits", {"/kernel:update"}, 3.0},
    {"10/3 the hit points: search and update",
     "room-hits",
     {"/kernel:gather", "/kernel:gather_slices", "/kernel:update"},
     3.0},
    {"10 times the photons: pass", "room-photons", {"/pass"}, 9.0},
    {"dark instead of lit: pass", "dark", {"/pass"}, 1.5},
    {"uneven instead of even: pass", "uneven", {"/pass"}, 1.5},
};

/// Seconds of the rows added up by repetition; a row that is not there takes no time.
std::vector<double> sums_of(const Results& results, const std::string& subject,
                            const std::vector<const char*>& names) {
  std::vector<double> sums;
  for (const char* name : names) {
    const Row* const row = results.find(subject + name);
    if (!row) continue;
    if (sums.empty()) sums.resize(row->seconds.size());
    for (std::size_t i = 0; i < std::min(sums.size(), row->seconds.size()); ++i) {
      sums[i] += row->seconds[i];
    }
  }
  return sums;
}

std::vector<double> ratios_of(const Results& results, const Ratio& ratio) {
  const std::vector<double> part = sums_of(results, ratio.subject, ratio.rows);
  const std::vector<double> whole = sums_of(results, "room", ratio.rows);
  std::vector<double> values;
  for (std::size_t i = 0; i < std::min(part.size(), whole.size()); ++i) {
    values.push_back(part[i] / whole[i]);
  }
  return values;
}

}  // namespace

std::vector<Case> scaling_cases(
    const std::function<render::Settings(const scene::Scene&, Log&)>& settings) {
  const auto room = [](Log&) { return make_room(); };
  const auto more_hits = [settings](const scene::Scene& scene, Log& log) {
    render::Settings changed = settings(scene, log);
    for (std::uint32_t* side : {&changed.width, &changed.height}) {
      *side = static_cast<std::uint32_t>(std::lround(*side * std::sqrt(kHitFactor)));
    }
    return changed;
  };
  const auto more_photons = [settings](const scene::Scene& scene, Log& log) {
    render::Settings changed = settings(scene, log);
    changed.photons_per_pass *= kPhotonFactor;
    return changed;
  };
  return {{"room", room, settings},
          {"room-700k", [](Log&) { return make_room(kManyTriangles); }, settings},
          {"room-hits", room, more_hits},
          {"room-photons", room, more_photons},
          {"dark", [](Log&) { return make_dark_room(); }, settings},
          {"uneven", [](Log&) { return make_uneven_room(); }, settings}};
}

std::string scaling_table(const Results& results) {
  std::string text = fmt::format("\n{:<42} {:>7} {:>7} {:>7} {:>9}\n",
                                 "as a multiple of the room's", "median", "least", "most", "goal");
  for (const Ratio& ratio : kRatios) {
    const std::vector<double> values = ratios_of(results, ratio);
    if (values.empty()) continue;
    const double middle = median(values);
    text += fmt::format("{:<42} {:>7.2f} {:>7.2f} {:>7.2f} {:>9} {}\n", ratio.what, middle,
                        least(values), most(values), fmt::format("<= {:.1f}", ratio.goal),
                        middle <= ratio.goal ? "met" : "MISSED");
  }
  return text;
}

}  // namespace ppm::bench
