#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>

#include "image.hpp"

namespace ppm::cli {
namespace {

constexpr std::uint32_t kLargestSide = 32768;

constexpr const char* kOverview =
    "ppm-vk renders glTF scenes by progressive photon mapping on Vulkan devices.\n"
    "\n"
    "  ppm-vk render SCENE.glb -o OUT.exr   render a scene\n"
    "  ppm-vk devices                       list the Vulkan devices and say which can serve\n"
    "  ppm-vk help [VERB]                   this text, or all options of a verb\n"
    "  ppm-vk --version                     the version\n"
    "\n"
    "Exit codes: 0 done, 1 scene, file or device, 2 usage, 130 interrupted.\n";

constexpr const char* kDevicesHelp =
    "Usage: ppm-vk devices\n"
    "\n"
    "Lists the Vulkan devices with the index that `ppm-vk render --device` takes, and says of "
    "each\n"
    "whether it can serve or what it lacks.\n";

/// A value that an option does not take; the message says what it would take.
CLI::ValidationError refusal(const char* option, const std::string& value,
                             const std::string& wanted) {
  return CLI::ValidationError(option, fmt::format("'{}' is not {}", value, wanted));
}

template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> parse_finite(std::string_view text) {
  const std::optional<double> value = parse_number<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<glm::dvec3> parse_vector(std::string_view text) {
  glm::dvec3 vector{};
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i == 2)) return std::nullopt;
    const std::optional<double> value = parse_finite(text.substr(0, comma));
    if (!value) return std::nullopt;
    vector[i] = *value;
    text.remove_prefix(i == 2 ? text.size() : comma + 1);
  }
  return vector;
}

struct HelpFormatter : CLI::Formatter {
  HelpFormatter() { column_width(36); }
  std::string make_usage(const CLI::App* /*app*/, std::string /*name*/) const override {
    return "Usage: ppm-vk render SCENE.glb|.gltf -o FILE.exr|.png|.hdr [-o ...] [OPTIONS]\n";
  }
};

/// Declares options whose values are checked here, so that all refusals read alike.
class Declarer {
 public:
  explicit Declarer(CLI::App& app) : app_(app) {}

  void group(const char* name) { group_ = name; }

  CLI::Option* text(const char* name, const char* value_name, const std::string& help,
                    std::function<void(const std::string&)> store) {
    return app_.add_option_function<std::string>(name, std::move(store), help)
        ->type_name(value_name)
        ->group(group_);
  }

  template <class T, class Target>
  void whole(const char* name, Target& target, T least, T most, const std::string& help) {
    text(name, "N", help, [=, &target](const std::string& value) {
      const std::optional<T> number = parse_number<T>(value);
      if (!number || *number < least || *number > most) {
        throw refusal(name, value, fmt::format("a whole number from {} to {}", least, most));
      }
      target = *number;
    });
  }

  template <class Target>
  void real(const char* name, const char* value_name, Target& target, const char* wanted,
            const std::string& help, std::function<bool(double)> allowed) {
    text(name, value_name, help, [=, &target](const std::string& value) {
      const std::optional<double> number = parse_finite(value);
      if (!number || !allowed(*number)) throw refusal(name, value, wanted);
      target = *number;
    });
  }

  void vector(const char* name, std::optional<glm::dvec3>& target, const std::string& help) {
    text(name, "X,Y,Z", help, [=, &target](const std::string& value) {
      target = parse_vector(value);
      if (!target) throw refusal(name, value, "three finite numbers X,Y,Z without spaces");
    });
  }

  void flag(const char* name, const std::string& help, std::function<void()> act) {
    app_.add_flag_callback(name, std::move(act), help)->group(group_)->disable_flag_override();
  }

 private:
  CLI::App& app_;
  std::string group_ = "Options";
};

void declare_files(Declarer& declare, RenderOptions& options, CLI::App& app) {
  declare.text("SCENE", "", "glTF 2.0 file, .glb or .gltf",
               [&](const std::string& value) { options.scene = value; });
  declare.group("Files");
  app.add_option_function<std::vector<std::string>>(
         "-o,--output",
         [&](const std::vector<std::string>& values) {
           options.outputs.assign(values.begin(), values.end());
           for (const std::string& value : values) {
             if (!image::has_known_extension(value)) {
               throw refusal("-o", value, "a file name that ends in .exr, .png or .hdr");
             }
           }
         },
         "picture to write; may be repeated")
      ->type_name("FILE.exr|.png|.hdr")
      ->group("Files")
      ->allow_extra_args(false);
  declare.text("--stats", "FILE.json", "write what was done and how long it took",
               [&](const std::string& value) { options.stats = value; });
  declare.real("--exposure", "EV", options.exposure, "a number from -100 to 100",
               fmt::format("PNG: radiance is multiplied by 2^EV, then clipped (default {})",
                           options.exposure),
               [](double value) { return std::abs(value) <= 100.0; });
}

void declare_radius(Declarer& declare, render::Settings& settings) {
  declare.text("--radius", "R|auto|footprint",
               "initial radius in scene units; auto: by a discarded pilot pass, for each\n"
               "hit point; footprint: from the pixel's footprint (default auto)",
               [&](const std::string& value) {
                 if (value == "auto") {
                   settings.radius_mode = render::RadiusMode::automatic;
                 } else if (value == "footprint") {
                   settings.radius_mode = render::RadiusMode::footprint;
                 } else if (const auto radius = parse_finite(value); radius && *radius > 0.0) {
                   settings.radius_mode = render::RadiusMode::fixed;
                   settings.radius = *radius;
                 } else {
                   throw refusal("--radius", value, "a positive number, auto or footprint");
                 }
               });
}

void declare_filter(Declarer& declare, render::Settings& settings) {
  declare.text("--filter", "box|tent|gaussian",
               "pixel filter that the eye paths are drawn from (default box)",
               [&](const std::string& value) {
                 if (value == "box") {
                   settings.filter = render::Filter::box;
                 } else if (value == "tent") {
                   settings.filter = render::Filter::tent;
                 } else if (value == "gaussian") {
                   settings.filter = render::Filter::gaussian;
                 } else {
                   throw refusal("--filter", value, "one of box, tent, gaussian");
                 }
               });
}

void declare_integrator(Declarer& declare, render::Settings& settings) {
  declare.text("--integrator", "NAME", fmt::format("method (default {})", settings.integrator),
               [&](const std::string& value) {
                 const auto names = render::integrator_names();
                 if (std::find(names.begin(), names.end(), value) == names.end()) {
                   throw refusal("--integrator", value,
                                 fmt::format("one of {}", fmt::join(names, ", ")));
                 }
                 settings.integrator = value;
               });
}

void declare_method(Declarer& declare, RenderOptions& options) {
  render::Settings& settings = options.settings;
  constexpr std::uint64_t kMany = std::numeric_limits<std::uint32_t>::max();
  declare.group("Method");
  declare_integrator(declare, settings);
  declare.whole<std::uint64_t>("--passes", options.passes, 1, kMany,
                               fmt::format("photon passes (default {})", options.passes));
  declare.whole<std::uint64_t>(
      "--photons", settings.photons_per_pass, 1, kMany,
      fmt::format("photon paths emitted a pass (default {})", settings.photons_per_pass));
  declare.real(
      "--alpha", "A", settings.alpha, "a number between 0 and 1, both excluded",
      fmt::format("share of a pass's photons that is kept, in (0,1) (default {})", settings.alpha),
      [](double value) {
        const auto single = static_cast<float>(value);  // what the kernels compute with
        return single > 0.0f && single < 1.0f;
      });
  declare_radius(declare, settings);
  declare.whole<std::uint32_t>(
      "--spp", settings.samples_per_pixel, 1, 65536,
      fmt::format("eye paths a pixel, stratified (default {})", settings.samples_per_pixel));
  declare_filter(declare, settings);
  declare.whole<std::uint32_t>(
      "--seed", settings.seed, 0, std::numeric_limits<std::uint32_t>::max(),
      fmt::format("what every random number follows from (default {})", settings.seed));
  declare.whole<std::uint32_t>(
      "--max-depth", settings.max_depth, 0, 255,
      fmt::format("scattering events between light and eye at most; 0: no limit (default {})",
                  settings.max_depth));
}

void declare_camera(Declarer& declare, RenderOptions& options) {
  declare.group("Picture and camera");
  declare.whole<std::uint32_t>(
      "--width", options.width, 1, kLargestSide,
      fmt::format("pixels (default {}, or from --height and the camera's aspect)",
                  options.settings.width));
  declare.whole<std::uint32_t>("--height", options.height, 1, kLargestSide,
                               "pixels (default from the width and the camera's aspect, or 4:3)");
  declare.text("--camera", "NAME|INDEX", "camera of the file (default the first)",
               [&](const std::string& value) { options.camera = value; });
  declare.vector("--camera-position", options.camera_position,
                 "where the camera stands, in scene units");
  declare.vector("--camera-target", options.camera_target,
                 "what the camera looks at, in scene units");
  declare.vector("--camera-up", options.camera_up,
                 "what is up in the picture (default 0,1,0 with --camera-target)");
  declare.real("--camera-fov", "DEGREES", options.camera_fov,
               "an angle between 0 and 180, both excluded", "vertical field of view",
               [](double value) { return value > 0.0 && value < 180.0; });
}

void declare_machine(Declarer& declare, RenderOptions& options) {
  declare.group("Machine");
  declare.text("--device", "NAME|INDEX",
               "Vulkan device, see ppm-vk devices (default the best: discrete GPU,\n"
               "integrated, virtual, CPU)",
               [&](const std::string& value) { options.device.selector = value; });
  declare.real("--dispatch-ms", "N", options.device.dispatch_milliseconds,
               "a number of milliseconds above 0",
               fmt::format("milliseconds that no dispatch is meant to exceed (default {})",
                           options.device.dispatch_milliseconds),
               [](double value) { return value > 0.0; });
  declare.whole<unsigned>("--threads", options.threads, 0, 4096,
                          "host threads; 0: one for each core (default 0)");
  declare.flag("--quiet", "print nothing but errors",
               [&] { options.verbosity = Verbosity::quiet; });
  declare.flag("--verbose", "print more", [&] { options.verbosity = Verbosity::verbose; });
}

void declare_testing(Declarer& declare, RenderOptions& options) {
  constexpr std::uint64_t kMany = std::uint64_t{1} << 31;
  declare.group("Testing (no effect on the picture)");
  declare.flag("--validate", "Vulkan validation; any message makes the exit code 1",
               [&] { options.device.validation = true; });
  declare.whole<std::uint64_t>(
      "--tile-hits", options.settings.tile_hits, 1, kMany,
      fmt::format("hit points a tile holds at most (default {})", options.settings.tile_hits));
  declare.whole<std::uint64_t>("--photon-capacity", options.settings.photon_capacity, 1, kMany,
                               fmt::format("photons stored at a time at most (default {})",
                                           options.settings.photon_capacity));
}

void declare_render(CLI::App& app, RenderOptions& options) {
  app.formatter(std::make_shared<HelpFormatter>());
  app.allow_extras();
  Declarer declare(app);
  declare_files(declare, options, app);
  declare_method(declare, options);
  declare_camera(declare, options);
  declare_machine(declare, options);
  declare_testing(declare, options);
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return a.lexically_normal() == b.lexically_normal() || std::filesystem::equivalent(a, b, ignored);
}

/// What no option can tell alone; throws CLI::ParseError.
void check_together(const CLI::App& app, const RenderOptions& options) {
  const std::vector<std::string> extras = app.remaining();
  if (!extras.empty()) {
    const bool is_option = extras.front().starts_with('-');
    throw CLI::ValidationError(extras.front(),
                               is_option ? "no such option" : "one argument too many");
  }
  if (options.scene.empty()) throw CLI::ValidationError("SCENE", "no scene file is given");
  if (options.outputs.empty()) {
    throw CLI::ValidationError("-o", "no picture to write is given, such as -o out.exr");
  }
  if (app.count("--quiet") > 0 && app.count("--verbose") > 0) {
    throw CLI::ValidationError("--quiet", "excludes --verbose");
  }
  if (app.count("--stats") > 0) {
    if (options.stats.empty()) throw refusal("--stats", "", "a file name");
    bool clash = same_file(options.stats, options.scene);
    for (const auto& output : options.outputs) clash = clash || same_file(options.stats, output);
    if (clash) throw refusal("--stats", options.stats.string(), "a file of its own");
  }
  if (options.camera_up && *options.camera_up == glm::dvec3(0.0)) {
    throw refusal("--camera-up", "0,0,0", "a direction");
  }
  if (options.camera_position && options.camera_target &&
      *options.camera_position == *options.camera_target) {
    throw CLI::ValidationError("--camera-target", "is the same point as --camera-position");
  }
}

Options usage_error(const std::string& what, const char* remedy) {
  std::string line = fmt::format("ppm-vk: error: {}: {}", what, remedy);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::fprintf(stderr, "%s\n", line.c_str());
  Options options;
  options.exit_code = 2;
  return options;
}

Options printed(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  return {};
}

/// CLI11 counts values where one is missing or an option is there twice; this says which.
std::string explain(const CLI::ArgumentMismatch& error, const CLI::App& app) {
  const std::string text = error.what();
  const std::string name = text.substr(0, text.find(':'));
  const CLI::Option* const option = app.get_option_no_throw(name);
  if (!option) return text;
  return name + (option->count() > 1 ? ": is given more than once" : ": a value is missing");
}

Options parse_render(std::vector<std::string> arguments) {
  Options options;
  CLI::App app("Renders a glTF scene to a picture.", "ppm-vk render");
  declare_render(app, options.render);
  try {
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    app.parse(arguments);
    check_together(app, options.render);
  } catch (const CLI::CallForHelp&) {
    return printed(app.help());
  } catch (const CLI::ArgumentMismatch& error) {
    return usage_error(explain(error, app), "see ppm-vk help render");
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what(), "see ppm-vk help render");
  }
  options.verb = Verb::render;
  return options;
}

Options parse_help(const std::vector<std::string>& arguments) {
  if (arguments.size() > 1)
    return usage_error(arguments[1] + ": one argument too many", "see ppm-vk help");
  if (arguments.empty() || arguments[0] == "help") return printed(kOverview);
  if (arguments[0] == "render") return parse_render({"--help"});
  if (arguments[0] == "devices") return printed(kDevicesHelp);
  return usage_error(arguments[0] + ": no such verb", "see ppm-vk help");
}

Options parse_devices(const std::vector<std::string>& arguments) {
  Options options;
  options.verb = Verb::devices;
  if (arguments.empty()) return options;
  if (arguments[0] == "--help" || arguments[0] == "-h") return printed(kDevicesHelp);
  return usage_error(arguments[0] + ": devices takes no options", "see ppm-vk help devices");
}

}  // namespace

Options parse(int argc, const char* const* argv) {
  if (argc < 2) return usage_error("no verb is given", "see ppm-vk help");
  const std::string verb = argv[1];
  const std::vector<std::string> rest(argv + 2, argv + argc);
  if (verb == "render") return parse_render(rest);
  if (verb == "devices") return parse_devices(rest);
  if (verb == "help" || verb == "--help" || verb == "-h") return parse_help(rest);
  if (verb == "--version") {
    if (!rest.empty()) return usage_error(rest[0] + ": one argument too many", "see ppm-vk help");
    return printed("ppm-vk " PPM_VERSION "\n");
  }
  return usage_error(verb + (verb.starts_with('-') ? ": no such option" : ": no such verb"),
                     "see ppm-vk help");
}

}  // namespace ppm::cli
