#include "compare_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "declarer.hpp"
#include "render_options.hpp"

namespace ppm::cli {
namespace {

constexpr double kUsualSeconds = 60.0;
constexpr unsigned kMostSeeds = 1000;
// Those of the paper; what is not built in is left out.
constexpr std::string_view kUsualMethods[] = {"ppm", "pt", "bdpt", "mlt", "pm"};

std::string known_methods() {
  std::string names;
  for (const render::Method& method : render::methods()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", method.name);
  }
  return names;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// "X,Y" or "X,Y,W,H": whole numbers that a picture may have.
template <int kCount>
std::optional<glm::vec<kCount, std::uint32_t>> parse_pixels(std::string_view text) {
  const std::vector<std::string> parts = split(text, ',');
  glm::vec<kCount, std::uint32_t> numbers{};
  if (parts.size() != kCount) return std::nullopt;
  for (int i = 0; i < kCount; ++i) {
    const auto number = parse_number<std::uint32_t>(parts[static_cast<std::size_t>(i)]);
    if (!number || *number > kLargestSide) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

/// "NAME" or "NAME:option=value:...": the options of render that say how it goes about it, on top
/// of what all methods have in common.
NamedMethod parse_method(const char* option, const std::string& text,
                         const CompareOptions& options) {
  const std::vector<std::string> parts = split(text, ':');
  if (!render::is_method(parts.front())) {
    refuse(option, parts.front(), "one of " + known_methods());
  }
  RenderOptions own = options.render;
  own.settings.integrator = parts.front();
  const render::Method method = render::method_named(parts.front());
  CLI::App app;
  Declarer declare(app);
  declare_method(declare, own, "");
  std::vector<std::string> words;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t equals = parts[i].find('=');
    const std::string name = "--" + parts[i].substr(0, equals);
    const bool is_its_own =
        method.has_option(name) || (name == "--spp" && method.unit == render::PassUnit::photons);
    if (equals == std::string::npos || !is_its_own) {
      refuse(option, text,
             fmt::format("a method with options of its own, such as ppm:alpha=0.8; those of "
                         "{} are: {}",
                         method.name, method.options.empty() ? "none" : method.options));
    }
    words.insert(words.begin(), {parts[i].substr(equals + 1), name});  // as CLI11 wants them
  }
  app.parse(words);
  if (method.unit != render::PassUnit::photons) own.settings.samples_per_pixel = 1;
  return {text, own.settings};
}

void declare_comparison(Declarer& declare, CompareOptions& options) {
  declare.text("SCENE", "", "glTF 2.0 file, .glb or .gltf",
               [&](const std::string& value) { options.render.scene = value; });
  declare.group("Comparison");
  declare.text("-o,--output", "REPORT/",
               "folder for the report, index.html, and all that it is made of; what\n"
               "it has of the same comparison already is kept",
               [&](const std::string& value) { options.report = value; });
  declare.text("--methods", "NAME,...",
               fmt::format("of {}, each with options of its own if\n"
                           "need be, such as ppm:alpha=0.8:radius=footprint (default {})",
                           known_methods(),
                           [] {
                             std::string names;
                             for (const std::string_view name : kUsualMethods) {
                               if (!render::is_method(name)) continue;
                               names += names.empty() ? "" : ",";
                               names += name;
                             }
                             return names;
                           }()),
               [](const std::string&) {});
  declare.whole<unsigned>("--seeds", options.seeds, 1, kMostSeeds,
                          fmt::format("renderings by each method, with seeds from --seed on "
                                      "(default {})",
                                      options.seeds));
  declare.text("--reference", "FILE.exr", "picture that all are measured against (default: made)",
               [&](const std::string& value) { options.reference = value; });
  declare.text("--reference-time", "10m|2h",
               "rendering time of the reference that is made (default 10 times --time)",
               [&](const std::string& value) {
                 options.reference_seconds = parse_duration(value);
                 if (!options.reference_seconds) {
                   refuse("--reference-time", value, "a time such as 30, 90s, 10m or 2h");
                 }
               });
  declare.text("--reference-method", "NAME",
               "who makes it (default an unbiased method outside of the comparison\n"
               "where a trial shows that it finds the light, else ppm)",
               [](const std::string&) {});
  declare.whole<unsigned>("--reference-seeds", options.reference_seeds, 1, kMostSeeds,
                          fmt::format("renderings that the reference is the mean of (default {})",
                                      options.reference_seeds));
}

/// Options that may be repeated.
template <class Vector, int kCount>
void declare_pixels(CLI::App& app, const char* name, const char* shape, const char* wanted,
                    std::vector<Vector>& target, const std::string& help) {
  app.add_option_function<std::vector<std::string>>(
         name,
         [=, &target](const std::vector<std::string>& values) {
           for (const std::string& value : values) {
             const auto numbers = parse_pixels<kCount>(value);
             if (!numbers) refuse(name, value, wanted);
             target.push_back(*numbers);
           }
         },
         help)
      ->type_name(shape)
      ->group("Report")
      ->allow_extra_args(false);
}

void declare_report(CLI::App& app, Declarer& declare, CompareOptions& options) {
  declare.group("Report");
  declare.text("--exposure", "EV",
               "pictures shown are radiance times 2^EV, clipped (default what suits\n"
               "the reference)",
               [&](const std::string& value) {
                 options.exposure = parse_finite(value);
                 if (!options.exposure || std::abs(*options.exposure) > 100.0) {
                   refuse("--exposure", value, "a number from -100 to 100");
                 }
               });
  declare_pixels<glm::uvec4, 4>(app, "--crop", "X,Y,W,H",
                                "four whole numbers X,Y,W,H, the last two above 0", options.crops,
                                "part to be shown enlarged, in pixels; may be repeated (default\n"
                                "three where methods differ most)");
  declare_pixels<glm::uvec2, 2>(app, "--probe", "X,Y", "two whole numbers X,Y", options.probes,
                                "Figure 4: N, R and L of the hit point at a pixel against ppm's\n"
                                "passes; may be repeated");
  declare.flag("--figure5", "Figure 5: pictures by ppm after 1, 16, 64, 256 ... passes",
               [&] { options.figure5 = true; });
  declare.whole<std::uint64_t>(
      "--figure-passes", options.figure_passes, 1, std::numeric_limits<std::uint32_t>::max(),
      fmt::format("passes of these two, in a rendering of their own (default {})",
                  options.figure_passes));
}

}  // namespace

void declare_compare(CLI::App& app, CompareOptions& options) {
  options.render.seconds = kUsualSeconds;
  set_usage(
      app,
      "Usage: ppm-vk compare SCENE.glb|.gltf -o REPORT/ [OPTIONS]\n"
      "\n"
      "Renders a scene by several methods for the same time (--time, default 60 s for each) and\n"
      "reports how near they came. Given again, the same command goes on where it was stopped.\n");
  app.allow_extras();
  Declarer declare(app);
  declare_comparison(declare, options);
  declare_time(declare, options.render);
  declare_report(app, declare, options);
  declare_method(declare, options.render, "passes: not here");
  declare_camera(declare, options.render);
  declare_lights(declare, options.render);
  declare_machine(declare, options.render);
  declare_testing(declare, options.render);
}

void check_compare(const CLI::App& app, CompareOptions& options) {
  check_extras(app);
  if (options.render.scene.empty()) throw CLI::ValidationError("SCENE", "no scene file is given");
  if (options.report.empty()) {
    throw CLI::ValidationError("-o", "no folder for the report is given, such as -o report/");
  }
  if (app.count("--integrator") > 0) {
    throw CLI::ValidationError("--integrator", "is --methods here");
  }
  if (app.count("--passes") > 0) {
    throw CLI::ValidationError("--passes", "is --time here: all methods get the same");
  }
  for (const char* option : {"--reference-time", "--reference-method", "--reference-seeds"}) {
    if (app.count("--reference") > 0 && app.count(option) > 0) {
      throw CLI::ValidationError(option, "is of no use with --reference");
    }
  }
  if (app.count("--reference") > 0 && options.reference.empty()) {
    refuse("--reference", "", "a file name");
  }
  if (app.count("--figure-passes") > 0 && !options.figure5 && options.probes.empty()) {
    throw CLI::ValidationError("--figure-passes", "needs --figure5 or --probe");
  }
  for (const glm::uvec4& crop : options.crops) {
    if (crop.z == 0 || crop.w == 0) {
      throw CLI::ValidationError("--crop", "a part of no pixels");
    }
  }
  if (app.count("--methods") > 0) {
    for (const std::string& name : split(app.get_option("--methods")->as<std::string>(), ',')) {
      options.methods.push_back(parse_method("--methods", name, options));
    }
  } else {
    for (const std::string_view name : kUsualMethods) {
      if (!render::is_method(name)) continue;
      options.methods.push_back(parse_method("--methods", std::string(name), options));
    }
  }
  if (app.count("--reference-method") > 0) {
    options.reference_method = parse_method(
        "--reference-method", app.get_option("--reference-method")->as<std::string>(), options);
  }
  check_shared(app, options.render);
}

}  // namespace ppm::cli
