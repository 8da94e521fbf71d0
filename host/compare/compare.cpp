#include "compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>
#include <set>

#include "analysis.hpp"
#include "failure.hpp"
#include "figures.hpp"
#include "picture_reader.hpp"
#include "reference.hpp"
#include "rendering.hpp"
#include "report_files.hpp"

namespace ppm::compare {
namespace {

Schedule schedule_of(const Plan& plan) {
  Schedule schedule;
  schedule.seconds = plan.seconds;
  schedule.moments = moments_of(plan.seconds);
  return schedule;
}

/// What must not come to light after hours: throws Failure for it.
void check_before(const Stage& stage, const Plan& plan, const ReportFolder& folder) {
  check_plan(plan);
  for (const Method& method : plan.methods) {
    for (unsigned i = 0; i < plan.seeds; ++i) {
      RunRecord wanted;
      wanted.options = options_of(stage, method);
      wanted.budget_seconds = plan.seconds;
      folder.find(run_name(method, plan.first_seed + i), wanted);
    }
  }
  const render::Settings& size = plan.methods.front().settings;
  if (!plan.reference.file.empty()) {
    image::read_rgb(plan.reference.file, size.width, size.height);
  }
}

using Failures = std::map<std::string, std::string>;  // by label

/// Does `deed`; a Failure is kept for the report. Whether it was done.
template <class Deed>
bool attempt(const std::string& label, Failures& failures, Log& log, Deed deed) {
  try {
    deed();
    return true;
  } catch (const Failure& failure) {
    failures[label] = failure.what();
  } catch (const std::bad_alloc&) {
    failures[label] = "out of memory";
  }
  log.warn(label + ": " + failures[label]);
  return false;
}

/// Renders what is missing. False: interrupted.
bool render_all(Stage& stage, const Plan& plan, const ReportFolder& folder, Failures& failures,
                Log& log) {
  const Schedule schedule = schedule_of(plan);
  // By turns, so that a machine that gets slower is so for all.
  for (unsigned i = 0; i < plan.seeds; ++i) {
    const std::uint32_t seed = plan.first_seed + i;
    for (const Method& method : plan.methods) {
      if (failures.contains(method.label)) continue;
      attempt(method.label, failures, log,
              [&] { rendering(stage, folder, run_name(method, seed), method, seed, schedule); });
      if (stage.interrupted()) return false;
    }
  }
  return true;
}

std::vector<MethodResult> measure_all(const Stage& stage, const Plan& plan,
                                      const ReportFolder& folder, const Reference& reference,
                                      const Failures& failures) {
  const double epsilon = relative_epsilon(reference.rgb);
  std::vector<MethodResult> results;
  for (const Method& method : plan.methods) {
    MethodResult result;
    result.label = method.label;
    result.integrator = method.settings.integrator;
    if (const auto entry = failures.find(method.label); entry != failures.end()) {
      result.failure = entry->second;
    }
    const auto [width, height] = std::pair(method.settings.width, method.settings.height);
    PictureMean last;
    RunRecord wanted;
    wanted.options = options_of(stage, method);
    wanted.budget_seconds = plan.seconds;
    for (unsigned i = 0; i < plan.seeds; ++i) {
      const std::string name = run_name(method, plan.first_seed + i);
      auto record = folder.find(name, wanted);
      if (!record) continue;
      last.add(image::read_rgb(folder.run_folder(name) / record->last().file, width, height));
      result.seeds.push_back(
          measure_seed(folder, name, std::move(*record), reference, epsilon, width, height));
    }
    summarise(result, last);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace

Outcome compare(Stage& stage, const Plan& plan, const std::filesystem::path& path,
                const Options& identity, const Facts& machine, Log& log) {
  check_plan(plan);
  const ReportFolder folder(path, identity);
  check_before(stage, plan, folder);
  Failures failures;
  if (!render_all(stage, plan, folder, failures, log)) return Outcome::interrupted;

  std::optional<Figures> figures;
  if (plan.figures.method) {
    attempt("Figures 4 and 5", failures, log, [&] { figures = make_figures(stage, folder, plan); });
    if (stage.interrupted()) return Outcome::interrupted;
  }
  const std::optional<Reference> reference = make_reference(stage, folder, plan);
  if (!reference) return Outcome::interrupted;

  const auto results = measure_all(stage, plan, folder, *reference, failures);
  for (const MethodResult& result : results) {
    const double share = share_of_light(result);
    if (result.seeds.empty() || share >= kEnoughLight) continue;
    log.warn(fmt::format("{}: its pictures hold {:.3g} % of the reference's light", result.label,
                         100.0 * share));
  }
  write_report(folder, plan, results, *reference, figures, machine, failures);
  return failures.empty() ? Outcome::complete : Outcome::method_failed;
}

}  // namespace ppm::compare
