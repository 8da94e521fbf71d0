#include "comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "table.hpp"

namespace ppm::bench {
namespace {

/// What differs from run to run without making them different benchmarks.
const std::set<std::string> kMomentary = {"date", "executable"};

double ratio_of(double before, double after) {
  if (before == after) return 1.0;
  return before == 0.0 ? std::numeric_limits<double>::infinity() : after / before;
}

Verdict judge(const Figure& before, const Figure& after, double tolerance) {
  if (std::max(before.share, after.share) < kLeastShare) return Verdict::too_small;
  const bool more_is_better = before.quantity == Quantity::rate;
  const double limit = 1.0 + tolerance;
  if (after.value > before.value * limit) return more_is_better ? Verdict::better : Verdict::worse;
  if (after.value * limit < before.value) return more_is_better ? Verdict::worse : Verdict::better;
  return Verdict::alike;
}

const char* text_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::alike:
      return "";
    case Verdict::better:
      return "better";
    case Verdict::worse:
      return "WORSE";
    case Verdict::too_small:
      return "(too small to judge)";
  }
  return "";
}

/// Of what both tell.
std::vector<std::string> different_context(const Context& before, const Context& after) {
  std::vector<std::string> lines;
  for (const auto& [key, value] : before) {
    const auto now = after.find(key);
    if (now == after.end() || now->second == value || kMomentary.contains(key)) continue;
    lines.push_back(fmt::format("{}: was {}, is {}", key, value, now->second));
  }
  return lines;
}

}  // namespace

Comparison compare(const Results& before, const Results& after, double tolerance) {
  Comparison comparison;
  std::map<std::string, Figure> old_figures;
  for (const Figure& figure : figures(before)) old_figures.emplace(figure.name, figure);
  for (const Figure& figure : figures(after)) {
    const auto old_figure = old_figures.find(figure.name);
    if (old_figure == old_figures.end()) {
      comparison.only_after.push_back(figure.name);
      continue;
    }
    const Figure& was = old_figure->second;
    comparison.differences.push_back(
        {was, figure, ratio_of(was.value, figure.value), judge(was, figure, tolerance)});
    old_figures.erase(old_figure);
  }
  for (const auto& [name, figure] : old_figures) comparison.only_before.push_back(name);
  comparison.different_context = different_context(before.context, after.context);
  return comparison;
}

std::string comparison_table(const Comparison& comparison) {
  std::string text = fmt::format("{:<58} {:>10} {:>10} {:>7}\n", "", "old", "new", "ratio");
  for (const Difference& difference : comparison.differences) {
    const Figure& now = difference.after;
    std::string line =
        fmt::format("{:<58} {:>10} {:>10} {:>7.3f} {}", now.name, value_text(difference.before),
                    value_text(now), difference.ratio, text_of(difference.verdict));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace ppm::bench
