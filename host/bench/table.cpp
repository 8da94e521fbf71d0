#include "table.hpp"

#include <fmt/format.h>

#include "progress.hpp"
#include "statistics.hpp"

namespace ppm::bench {
namespace {

/// Parts below this share of their whole are left out; the JSON has them.
constexpr double kShownShare = 0.005;

std::string time_text(double seconds) {
  if (seconds >= 10.0) return fmt::format("{:.2f} s", seconds);
  return fmt::format("{:.{}f} ms", 1e3 * seconds, seconds >= 1e-2 ? 1 : 2);
}

std::string memory_text(double bytes) {
  return fmt::format("{:.{}f} MiB", bytes / (1u << 20), bytes < (10u << 20) ? 1 : 0);
}

std::string rate_text(const std::string& name, double rate) {
  return render::short_count(rate) + (name.ends_with("bytes_per_second") ? "B/s" : "/s");
}

double median_of(const Row& row, const char* counter) {
  const auto entry = row.counters.find(counter);
  return entry == row.counters.end() ? 0.0 : median(entry->second);
}

bool has_share(const Row& row) {
  return row.counters.contains("share");
}

/// Of what stands above it.
bool is_part(const Row& row) {
  return has_share(row) && row.name != "compile";
}

/// Rates and memory.
std::string beside(const Row& row) {
  std::string text;
  for (const auto& [counter, values] : row.counters) {
    constexpr std::string_view kRate = "_per_second", kMemory = "_bytes";
    const bool is_rate = counter.ends_with(kRate);
    if (!is_rate && !counter.ends_with("_memory_bytes")) continue;
    const double value = median(values);
    std::string name = counter.substr(0, counter.size() - (is_rate ? kRate : kMemory).size());
    for (char& c : name) c = c == '_' ? ' ' : c;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name,
                        is_rate ? rate_text(counter, value) : memory_text(value));
  }
  return text;
}

std::string line_of(const Row& row) {
  const std::string share =
      has_share(row) ? fmt::format("{:.1f} %", 100.0 * median_of(row, "share")) : "";
  std::string line = fmt::format(
      "{:<36} {:>10} {:>10} {:>10} {:>9} {:>7}  {}", (is_part(row) ? "  " : "") + row.name,
      time_text(median(row.seconds)), time_text(least(row.seconds)), time_text(most(row.seconds)),
      time_text(median_absolute_deviation(row.seconds)), share, beside(row));
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

/// What a scene is, above its first row.
std::string heading_of(const Row& start) {
  return fmt::format(
      "{}: {:.0f} triangles, {:.0f} hit points, {} eye rays, initial radii {:.3g} to {:.3g}\n",
      start.name.substr(0, start.name.rfind('/')), median_of(start, "triangles"),
      median_of(start, "hit_points"), render::short_count(median_of(start, "eye_rays")),
      median_of(start, "initial_radius_least"), median_of(start, "initial_radius_most"));
}

}  // namespace

std::string value_text(const Figure& figure) {
  switch (figure.quantity) {
    case Quantity::time:
      return time_text(figure.value);
    case Quantity::rate:
      return rate_text(figure.name, figure.value);
    case Quantity::memory:
      return memory_text(figure.value);
  }
  return "";
}

std::string results_table(const Results& results) {
  std::string text;
  for (const char* key : {"device", "driver", "settings"}) {
    const auto entry = results.context.find(key);
    if (entry != results.context.end()) text += fmt::format("{}: {}\n", key, entry->second);
  }
  text += fmt::format("\n{:<36} {:>10} {:>10} {:>10} {:>9} {:>7}\n", "", "median", "least", "most",
                      "deviation", "share");
  for (const Row& row : results.rows) {
    if (is_part(row) && median_of(row, "share") < kShownShare) continue;
    if (!is_part(row)) text += "\n";
    if (row.name.ends_with("/start")) text += heading_of(row);
    text += line_of(row);
  }
  return text;
}

}  // namespace ppm::bench
