#include "bench_options.hpp"

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>

#include "builtin_scenes.hpp"
#include "declarer.hpp"
#include "render_options.hpp"

namespace ppm::cli {
namespace {

constexpr std::uint64_t kManyPasses = std::numeric_limits<std::uint32_t>::max();

bool names_file(const std::string& scene) {
  return scene.ends_with(".glb") || scene.ends_with(".gltf");
}

/// "10%" or "10": ten hundredths.
std::optional<double> parse_percentage(std::string_view text) {
  if (text.ends_with('%')) text.remove_suffix(1);
  const std::optional<double> value = parse_finite(text);
  if (!value || *value < 0.0 || *value > 1e6) return std::nullopt;
  return *value / 100.0;
}

void declare_measuring(CLI::App& app, Declarer& declare, BenchOptions& options) {
  app.add_option("SCENE", options.scenes,
                 fmt::format("{}, or glTF 2.0 files (default all\n"
                             "built-in ones)",
                             bench::builtin_scene_names()))
      ->type_name("")
      ->group("Options");
  declare.group("Measuring");
  declare.whole<unsigned>(
      "--repeat", options.repetitions, 1, 10000,
      fmt::format("repetitions, each from nothing (default {})", options.repetitions));
  declare.whole<std::uint64_t>(
      "--warmup", options.warmup, 1, kManyPasses,
      fmt::format("passes a repetition that are left out (default {})", options.warmup));
  declare.flag("--aged", "also measure passes once radii have halved",
               [&] { options.aged = true; });
  declare.flag("--scaling",
               "how passes scale with triangles, hit points, photons, darkness\n"
               "and unevenness, instead of SCENEs",
               [&] { options.scaling = true; });
}

void declare_results(Declarer& declare, BenchOptions& options) {
  declare.group("Results");
  declare.text("--json", "FILE|-",
               "write all figures in Google Benchmark's format, - to stdout\n"
               "(the table then goes to stderr)",
               [&](const std::string& value) { options.json = value; });
  declare.text("--compare", "OLD.json",
               "print old, new and ratio of every figure; exit with 1 where one\n"
               "is worse. Without SCENEs: those of OLD",
               [&](const std::string& value) { options.compare = value; });
  declare.text("--with", "NEW.json", "compare OLD with this instead of measuring",
               [&](const std::string& value) { options.with = value; });
  declare.text("--tolerance", "PERCENT", "what a figure may be worse by (default 10%)",
               [&](const std::string& value) {
                 const std::optional<double> tolerance = parse_percentage(value);
                 if (!tolerance) refuse("--tolerance", value, "a percentage such as 10%");
                 options.tolerance = *tolerance;
               });
}

}  // namespace

bool is_scene(const std::string& name) {
  return names_file(name) || !bench::find_builtin_scenes(name).empty();
}

void declare_bench(CLI::App& app, BenchOptions& options) {
  set_usage(app,
            "Usage: ppm-vk bench [SCENE...] [OPTIONS]\n"
            "       ppm-vk bench --compare OLD.json --with NEW.json\n");
  app.allow_extras();
  Declarer declare(app);
  declare_measuring(app, declare, options);
  declare_results(declare, options);
  declare_method(declare, options.render, "photon passes that are timed, a repetition");
  declare_camera(declare, options.render);
  declare_lights(declare, options.render);
  declare_machine(declare, options.render);
  declare_testing(declare, options.render);
}

void check_bench(const CLI::App& app, BenchOptions& options) {
  check_extras(app);
  take_method(app, options.render);
  for (std::size_t i = 0; i < options.scenes.size(); ++i) {
    const std::string& scene = options.scenes[i];
    if (scene.starts_with('-')) throw CLI::ValidationError(scene, "no such option");
    if (!is_scene(scene)) {
      refuse("SCENE", scene,
             fmt::format("a .glb or .gltf file or one of {}", bench::builtin_scene_names()));
    }
    if (!options.json.empty() && names_file(scene) && same_file(options.json, scene)) {
      refuse("--json", options.json, "a file of its own");
    }
  }
  for (const char* option : {"--json", "--compare", "--with"}) {
    if (app.count(option) > 0 && app.get_option(option)->as<std::string>().empty()) {
      refuse(option, "", "a file name");
    }
  }
  if (app.count("--with") > 0 && app.count("--compare") == 0) {
    throw CLI::ValidationError("--with", "needs --compare");
  }
  if (app.count("--tolerance") > 0 && app.count("--compare") == 0) {
    throw CLI::ValidationError("--tolerance", "needs --compare");
  }
  if (app.count("--with") > 0 &&
      (!options.scenes.empty() || options.scaling || !options.json.empty())) {
    throw CLI::ValidationError("--with",
                               "measures nothing: leave SCENEs, --scaling and --json out");
  }
  if (options.scaling && !options.scenes.empty()) {
    throw CLI::ValidationError("--scaling", "has scenes of its own: leave SCENEs out");
  }
  check_shared(app, options.render);
}

}  // namespace ppm::cli
