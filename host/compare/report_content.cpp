#include "report_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page_text.hpp"
#include "progress.hpp"
#include "tables.hpp"

namespace ppm::compare {
namespace {

constexpr const char* kNone = "\xe2\x80\x93";  // an en dash

std::string count_or_none(std::uint64_t count) {
  return count == 0 ? kNone : render::short_count(static_cast<double>(count));
}

std::string optional_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : kNone;
}

std::string number_or_none(const std::optional<double>& value) {
  return value ? short_number(*value) : kNone;
}

std::vector<std::string> table_line(const MethodResult& result, double against) {
  if (result.seeds.empty()) {
    std::vector<std::string> cells(15, kNone);
    cells[0] = result.label + " (failed)";
    return cells;
  }
  const KeptPicture& last = result.seeds.front().record.last();
  return {result.label,
          count_or_none(last.samples),
          count_or_none(last.mutations),
          count_or_none(last.passes),
          count_or_none(last.photons_emitted),
          count_or_none(last.rays),
          fmt::format("{:.4g} s", last.seconds),
          short_number(result.rmse),
          against > 0.0 ? fmt::format("{:.2f}", result.rmse / against) : kNone,
          optional_text(result.rmse_slope),
          short_number(result.relative_mse),
          optional_text(result.relative_slope),
          short_number(result.trimmed_relative_mse),
          number_or_none(result.noise),
          number_or_none(result.bias)};
}

std::string mean_sentence(const MethodResult& result) {
  std::string text = result.label + ": mean minus the reference's";
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const Estimate& difference = result.mean_difference[channel];
    text += fmt::format("{} {} {:.3g}", channel == 0 ? "" : ",", "RGB"[channel], difference.mean);
    if (result.seeds.size() > 1) text += fmt::format(" \xc2\xb1 {:.2g}", difference.standard_error);
  }
  const double mean = (result.mean[0].mean + result.mean[1].mean + result.mean[2].mean) / 3.0;
  text += fmt::format(" (its mean is {:.3g}).", mean);
  if (const double share = share_of_light(result); share < kEnoughLight) {
    text += fmt::format(
        " It found {:.3g} % of the light: the rest it cannot see, or met too seldom for a mean.",
        100.0 * share);
  }
  return text;
}

/// "As multiples of ppm's ..."
std::string ratios_to_ppm(const std::vector<MethodResult>& results) {
  const auto ppm = std::find_if(results.begin(), results.end(), [](const MethodResult& result) {
    return result.integrator == "ppm" && !result.seeds.empty();
  });
  if (ppm == results.end()) return "";
  std::string text = "At the end, as multiples of ppm's:";
  const std::pair<const char*, double MethodResult::*> kMeasures[] = {
      {"RMSE", &MethodResult::rmse},
      {"relative MSE", &MethodResult::relative_mse},
      {"trimmed relative MSE", &MethodResult::trimmed_relative_mse}};
  for (const auto& [name, measure] : kMeasures) {
    text += fmt::format("{} {}", name == kMeasures[0].first ? "" : ";", name);
    for (const MethodResult& result : results) {
      if (result.seeds.empty() || &result == &*ppm || !((*ppm).*measure > 0.0)) continue;
      text += fmt::format(" {} {:.3g},", result.label, result.*measure / (*ppm).*measure);
    }
    if (text.ends_with(',')) text.pop_back();
  }
  return text + ".";
}

Plot curves_of(const std::vector<MethodResult>& results, const char* title, const char* label,
               std::vector<Sample> MethodResult::*median_points,
               std::optional<double> MethodResult::*slope,
               std::vector<Sample> (*points)(const SeedResult&)) {
  Plot plot;
  plot.title = title;
  plot.x_label = "rendering time, s";
  plot.y_label = label;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const MethodResult& result = results[i];
    if (result.seeds.empty()) continue;
    if (result.seeds.size() > 1) {
      for (const SeedResult& seed : result.seeds) {
        plot.curves.push_back({"", "", i, true, points(seed)});
      }
    }
    const auto& fitted = result.*slope;
    plot.curves.push_back({result.label, fitted ? fmt::format("(slope {:.2f})", *fitted) : "", i,
                           false, result.*median_points});
  }
  return plot;
}

double luminance(const std::array<double, 3>& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

}  // namespace

std::vector<std::string> summary_of(const Plan& plan, const std::vector<MethodResult>& results,
                                    const Reference& reference) {
  std::vector<std::string> paragraphs;
  paragraphs.push_back(fmt::format(
      "Each method rendered for {:.4g} s, {} seed{}. The clock runs from the first eye path or "
      "photon to the picture, its readback included; reading the scene, building its tree and "
      "making and warming up pipelines came before, and keeping pictures along the way was left "
      "out. A pass in hand is finished.",
      plan.seconds, plan.seeds, plan.seeds == 1 ? "" : "s"));
  std::string text = "Reference: " + reference.account;
  if (reference.rmse > 0.0) {
    text += fmt::format(" Its standard error is {} (root mean square), a relative MSE of {}.",
                        short_number(reference.rmse), short_number(reference.relative_mse));
  }
  paragraphs.push_back(text);

  double best = 0.0;
  for (const MethodResult& result : results) {
    if (!result.seeds.empty() && (best == 0.0 || result.rmse < best)) best = result.rmse;
  }
  if (best > 0.0 && reference.rmse > 0.5 * best) {
    paragraphs.push_back(
        "The reference is hardly better than the best of these pictures: its own error is a large "
        "part of theirs. Give it more time (--reference-time) before reading anything into ratios "
        "of small errors.");
  }
  if (rmse_of_ppm(results) > 0.0 && results.size() > 1) {
    paragraphs.push_back(ratios_to_ppm(results));
  }
  return paragraphs;
}

void add_table(PageContent& content, const std::vector<MethodResult>& results) {
  content.table_heading = {"",         "Samples", "Mutations", "Passes",   "Photons",
                           "Rays",     "Time",    "RMSE",      "to ppm's", "slope",
                           "Rel. MSE", "slope",   "trimmed",   "Noise",    "Bias"};
  const double against = rmse_of_ppm(results);
  for (const MethodResult& result : results) content.table.push_back(table_line(result, against));
  content.table_notes.push_back(
      "Samples and mutations: on average, a pixel. Photons: paths emitted. Rays: as far as the "
      "method counts them. Effort is that of the first seed, errors are medians over seeds. Noise: "
      "what differs between seeds; bias: what is common to them, errors of the reference included "
      "(both root mean square, with two seeds or more).");
  const bool has_ppm = std::any_of(results.begin(), results.end(), [](const MethodResult& result) {
    return result.integrator == "ppm" || result.integrator == "pm";
  });
  if (has_ppm) {
    content.table_notes.push_back(
        "Methods of photon mapping trace their eye paths once (spp of them a pixel): what these "
        "say "
        "of small bright lights that are seen directly, in mirrors or through glass, and of edges, "
        "stays as it is however many photons follow. Such pixels may decide the RMSE and count for "
        "little in the trimmed error; more --spp makes them better.");
  }
  for (const MethodResult& result : results) {
    if (!result.seeds.empty()) content.table_notes.push_back(mean_sentence(result));
  }
}

std::vector<Plot> error_curves(const std::vector<MethodResult>& results,
                               const Reference& reference) {
  std::vector<Plot> plots = {
      curves_of(results, "RMSE", "RMSE, radiance", &MethodResult::rmse_curve,
                &MethodResult::rmse_slope, rmse_points),
      curves_of(results, "Relative MSE", "relative MSE", &MethodResult::relative_curve,
                &MethodResult::relative_slope, relative_points),
      curves_of(results, "Trimmed relative MSE", "relative MSE, worst thousandth left out",
                &MethodResult::trimmed_curve, &MethodResult::trimmed_slope, trimmed_points)};
  if (reference.rmse > 0.0) {
    plots[0].levels.push_back({"the reference's standard error", reference.rmse});
    plots[1].levels.push_back({"the reference's standard error", reference.relative_mse});
  }
  return plots;
}

std::vector<Plot> figure4_plots(const Figures& figures) {
  Plot photons, radius, radiance;
  photons.title = "N: photons that count";
  photons.y_label = "N(x)";
  radius.title = "R: radius";
  radius.y_label = "R(x), scene units";
  radiance.title = "L: radiance";
  radiance.y_label = "L(x), luminance";
  for (Plot* const plot : {&photons, &radius, &radiance}) plot->x_label = "passes";
  photons.x_logarithmic = photons.y_logarithmic = false;
  radiance.x_logarithmic = radiance.y_logarithmic = false;
  for (std::size_t i = 0; i < figures.probes.size(); ++i) {
    const ProbeCurve& probe = figures.probes[i];
    if (probe.samples.empty()) continue;
    const std::string name = fmt::format("{}, {}", probe.at.x, probe.at.y);
    Curve n{name, "", i, false, {}}, r = n, l = n;
    for (const auto& [passes, reading] : probe.samples) {
      const auto at = static_cast<double>(passes);
      n.points.push_back({at, reading.photons});
      r.points.push_back({at, reading.radius});
      l.points.push_back({at, luminance(reading.radiance)});
    }
    const auto slope = log_log_slope(r.points);
    if (slope) r.note = fmt::format("(slope {:.2f})", *slope);
    photons.curves.push_back(std::move(n));
    radius.curves.push_back(std::move(r));
    radiance.curves.push_back(std::move(l));
  }
  if (photons.curves.empty()) return {};
  return {photons, radius, radiance};
}

Facts parameters_of(const MethodResult& result) {
  Facts facts;
  if (result.seeds.empty()) return facts;
  const RunRecord& record = result.seeds.front().record;
  for (const auto& [name, value] : record.options) facts.emplace_back(name, value);
  const auto seconds = [](double value) { return fmt::format("{:.3g} s", value); };
  facts.emplace_back("before the clock", seconds(record.start_seconds));
  facts.emplace_back("before the first pass", seconds(record.prepare_seconds));
  facts.emplace_back("resolving the picture", seconds(record.last().resolve_seconds));
  if (record.complete) facts.emplace_back("ended", "the method had all that it can take");
  if (record.hit_points > 0) facts.emplace_back("hit points", std::to_string(record.hit_points));
  if (record.initial_radius > 0.0) {
    facts.emplace_back("first radius, median", short_number(record.initial_radius));
  }
  if (record.last().photons_stored > 0) {
    facts.emplace_back("photons stored", std::to_string(record.last().photons_stored));
  }
  if (record.paths_cut > 0) facts.emplace_back("paths cut", std::to_string(record.paths_cut));
  for (const auto& [reason, count] : record.rejected) {
    if (count > 0) facts.emplace_back("rejected: " + reason, std::to_string(count));
  }
  for (const std::string& warning : record.warnings) facts.emplace_back("warning", warning);
  return facts;
}

}  // namespace ppm::compare
