#include "bench_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "bench_options.hpp"
#include "builtin_scenes.hpp"
#include "comparison.hpp"
#include "driver.hpp"
#include "exit_code.hpp"
#include "failure.hpp"
#include "load_gltf.hpp"
#include "machine.hpp"
#include "measure.hpp"
#include "output_file.hpp"
#include "report.hpp"
#include "results_json.hpp"
#include "scaling.hpp"
#include "scene_settings.hpp"
#include "table.hpp"

namespace ppm::cli {
namespace {

std::function<render::Settings(const scene::Scene&, Log&)> settings_from(
    const RenderOptions& render) {
  return [&render, limits = memory_limits_for(render)](const scene::Scene& scene, Log& log) {
    return fitting_settings(scene, settings_for(render, scene, log), render, limits, nullptr, log);
  };
}

bench::Case case_of(const std::string& name, const RenderOptions& render,
                    std::function<scene::Scene(Log&)> load) {
  return {name, std::move(load), settings_from(render)};
}

bench::Case case_of(const bench::BuiltinScene& builtin, const RenderOptions& render) {
  return case_of(std::string(builtin.name), render, [make = builtin.make](Log&) { return make(); });
}

std::vector<bench::Case> cases_for(const std::vector<std::string>& scenes,
                                   const RenderOptions& render) {
  std::vector<bench::Case> cases;
  const auto add = [&](bench::Case subject) {
    const bool known = std::any_of(cases.begin(), cases.end(),
                                   [&](const auto& other) { return other.name == subject.name; });
    if (!known) cases.push_back(std::move(subject));
  };
  for (const std::string& scene : scenes) {
    const auto builtin = bench::find_builtin_scenes(scene);
    for (const bench::BuiltinScene& one : builtin) add(case_of(one, render));
    if (builtin.empty()) {
      RenderOptions named = render;
      named.scene = scene;
      const scene::LoadOptions load = load_options_for(named, memory_limits_for(named));
      add(case_of(scene, render,
                  [scene, load](Log& log) { return scene::load_gltf(scene, log, load); }));
    }
  }
  return cases;
}

/// The scenes of earlier results; `file` is theirs.
std::vector<std::string> scenes_of(const bench::Results& results, const std::string& file) {
  std::vector<std::string> scenes;
  for (const bench::Row& row : results.rows) {
    constexpr std::string_view kEnd = "/start";
    if (!row.name.ends_with(kEnd)) continue;
    const std::string scene = row.name.substr(0, row.name.size() - kEnd.size());
    if (!is_scene(scene)) {
      throw Failure(file, scene, "is no scene", "name SCENEs, or give --scaling as it was then");
    }
    scenes.push_back(scene);
  }
  return scenes;
}

std::vector<std::string> scenes_for(const BenchOptions& options,
                                    const std::optional<bench::Results>& old) {
  if (!options.scenes.empty()) return options.scenes;
  if (old) return scenes_of(*old, options.compare.string());
  std::vector<std::string> scenes;
  for (const bench::BuiltinScene& scene : bench::builtin_scenes()) {
    scenes.emplace_back(scene.name);
  }
  return scenes;
}

std::string settings_text(const BenchOptions& options) {
  const RenderOptions& render = options.render;
  const render::Settings& settings = render.settings;
  const auto side = [](std::optional<std::uint32_t> value, std::uint32_t otherwise) {
    return value ? std::to_string(*value) : std::to_string(otherwise);
  };
  std::string size = "width " + side(render.width, settings.width);
  if (!render.load.scene.empty()) size = "scene " + render.load.scene + ", " + size;
  if (!render.load.environment.empty()) {
    size = fmt::format("environment {} x {} at {}, ", render.load.environment.string(),
                       render.load.environment_strength, render.load.environment_rotation) +
           size;
  }
  if (render.load.luminous_efficacy != 1.0) {
    size = fmt::format("luminous efficacy {}, ", render.load.luminous_efficacy) + size;
  }
  if (render.height) size += fmt::format(", height {}", *render.height);
  return fmt::format(
      "{}, {}, {} eye paths a pixel, {} photons a pass, alpha {}, radius {}, seed {}, max depth "
      "{}; "
      "{} passes after {}, {} repetitions{}",
      settings.integrator, size, settings.samples_per_pixel, settings.photons_per_pass,
      settings.alpha, render::radius_text(settings), settings.seed, settings.max_depth,
      render.passes_or_usual(), options.warmup, options.repetitions,
      options.scaling ? ", scaling" : "");
}

/// Opens the device that all will run on, to tell of it and to fail early.
bench::Context context_for(const BenchOptions& options) {
  const gpu::Device device(options.render.device);
  return {{"program", "ppm-vk " PPM_VERSION},
          {"device", device.description().name},
          {"driver", device.description().driver},
          {"settings", settings_text(options)},
          {"host_name", bench::describe_machine().host_name},
          {"host_threads", std::to_string(thread_count(options.render.threads))}};
}

std::optional<bench::Results> measure(const BenchOptions& options,
                                      const std::vector<bench::Case>& cases,
                                      const render::Interruption& interruption, Log& log) {
  bench::Plan plan;
  plan.repetitions = options.repetitions;
  plan.warmup = options.warmup;
  plan.passes = options.render.passes_or_usual();
  plan.aged = options.aged;
  plan.device = options.render.device;
  plan.threads = thread_count(options.render.threads);
  bench::Results results;
  results.context = context_for(options);
  const auto tell = [&](const std::string& line) {
    if (options.render.verbosity != Verbosity::quiet) {
      std::fprintf(stderr, "ppm-vk: %s\n", line.c_str());
    }
  };
  auto rows = bench::measure(
      cases, plan, [&] { return interruption.requested(); }, log, tell);
  if (!rows) return std::nullopt;
  results.rows = std::move(*rows);
  return results;
}

void write_json(const std::string& file, const bench::Results& results) {
  const std::string text = bench::results_json(results, bench::describe_machine());
  if (file == "-") {
    std::fputs(text.c_str(), stdout);
  } else {
    write_whole(file, text);
  }
}

/// Throws Failure where a figure is worse.
void report_comparison(const BenchOptions& options, const bench::Results& before,
                       const bench::Results& after, std::FILE* out, Log& log) {
  const bench::Comparison comparison = bench::compare(before, after, options.tolerance);
  for (const std::string& line : comparison.different_context) log.warn(line);
  for (const std::string& name : comparison.only_before)
    log.warn(name + ": only in the old results");
  for (const std::string& name : comparison.only_after)
    log.warn(name + ": only in the new results");
  if (comparison.differences.empty()) {
    throw Failure(options.compare.string(), "", "no figure is in both results",
                  "compare the same scenes");
  }
  std::fputs(("\n" + bench::comparison_table(comparison)).c_str(), out);
  std::string worse;
  std::size_t count = 0;
  for (const bench::Difference& difference : comparison.differences) {
    if (difference.verdict != bench::Verdict::worse) continue;
    if (count++ == 0) worse = difference.after.name;
  }
  if (count == 0) return;
  if (count > 1) worse += fmt::format(" and {} more figures", count - 1);
  throw Failure(options.compare.string(), worse,
                fmt::format("worse by more than {:.4g} %", 100.0 * options.tolerance),
                "see the table, or raise --tolerance");
}

}  // namespace

int bench_command(const BenchOptions& options) {
  const render::Interruption interruption;
  Log log(options.render.verbosity);
  std::optional<bench::Results> old;
  if (!options.compare.empty()) old = bench::read_results(options.compare);
  if (!options.with.empty()) {
    report_comparison(options, *old, bench::read_results(options.with), stdout, log);
    return kDone;
  }
  const bool json_on_stdout = options.json == "-";
  if (!options.json.empty() && !json_on_stdout) check_creatable(options.json);
  const std::vector<bench::Case> cases = options.scaling
                                             ? bench::scaling_cases(settings_from(options.render))
                                             : cases_for(scenes_for(options, old), options.render);
  const std::optional<bench::Results> results = measure(options, cases, interruption, log);
  if (!results) {
    log.warn("interrupted; nothing is written");
    return kInterrupted;
  }
  std::FILE* const out = json_on_stdout ? stderr : stdout;
  std::fputs(bench::results_table(*results).c_str(), out);
  if (options.scaling) std::fputs(bench::scaling_table(*results).c_str(), out);
  if (!options.json.empty()) write_json(options.json, *results);
  if (old) report_comparison(options, *old, *results, out, log);
  return kDone;
}

}  // namespace ppm::cli
