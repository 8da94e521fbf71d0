#include "render_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>

#include "declarer.hpp"
#include "display_options.hpp"
#include "image.hpp"
#include "layer_options.hpp"
#include "load_environment.hpp"
#include "memory_budget.hpp"
#include "run_options.hpp"

namespace ppm::cli {
namespace {

constexpr std::uint32_t kMostSamples = 65536;  // of a pixel, where all are kept at once

void declare_files(Declarer& declare, RenderOptions& options, CLI::App& app) {
  declare_pictures(declare, options, app);
  declare_display(declare, options);
  declare.text("--stats", "FILE.json", "write what was done and how long it took",
               [&](const std::string& value) { options.stats = value; });
  declare_encoding(declare, options);
}

void declare_radius(Declarer& declare, render::Settings& settings) {
  declare.text("--radius", "R|auto|footprint",
               "initial radius in scene units; auto: by a discarded pilot pass, for each\n"
               "hit point; footprint: from the pixel's footprint (default auto);\n"
               "pm: the largest, auto: a quarter of the scene's",
               [&](const std::string& value) {
                 if (value == "auto") {
                   settings.radius_mode = render::RadiusMode::automatic;
                 } else if (value == "footprint") {
                   settings.radius_mode = render::RadiusMode::footprint;
                 } else if (const auto radius = parse_finite(value); radius && *radius > 0.0) {
                   settings.radius_mode = render::RadiusMode::fixed;
                   settings.radius = *radius;
                 } else {
                   refuse("--radius", value, "a positive number, auto or footprint");
                 }
               });
}

void declare_photon_map(Declarer& declare, render::Settings& settings) {
  declare.whole<std::uint64_t>(
      "--map-photons", settings.map_photons, 1, 20000000,
      fmt::format("pm: photons stored at most (default {})", settings.map_photons));
  declare.whole<std::uint32_t>(
      "--nearest", settings.nearest, 1, 1000000,
      fmt::format("pm: photons that an estimate is made of (default {})", settings.nearest));
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
                   refuse("--filter", value, "one of box, tent, gaussian");
                 }
               });
}

void declare_integrator(Declarer& declare, render::Settings& settings) {
  std::string help = fmt::format("method (default {})", settings.integrator);
  std::vector<std::string_view> names;
  for (const render::Method& method : render::methods()) {
    help += fmt::format("\n  {:8}{}", method.name, method.summary);
    names.push_back(method.name);
  }
  declare.text("--integrator", "NAME", help, [&, names](const std::string& value) {
    if (std::ranges::find(names, value) == names.end()) {
      refuse("--integrator", value, fmt::format("one of {}", fmt::join(names, ", ")));
    }
    settings.integrator = value;
  });
}

}  // namespace

void declare_pictures(Declarer& declare, RenderOptions& options, CLI::App& app) {
  declare.group("Files");
  app.add_option_function<std::vector<std::string>>(
         "-o,--output",
         [&](const std::vector<std::string>& values) {
           options.outputs.assign(values.begin(), values.end());
           for (const std::string& value : values) {
             if (!image::has_known_extension(value)) {
               refuse("-o", value, "a file name that ends in .exr, .png, .hdr or .pfm");
             }
           }
         },
         "picture to write; may be repeated")
      ->type_name("FILE.exr|.png|.hdr|.pfm")
      ->group("Files")
      ->allow_extra_args(false);
  declare_layers(declare, options);
}

void declare_encoding(Declarer& declare, RenderOptions& options) {
  declare.real(
      "--exposure", "EV", options.encoding.exposure, "a number from -100 to 100",
      fmt::format("PNG: radiance is multiplied by 2^EV (default {})", options.encoding.exposure),
      [](double value) { return std::abs(value) <= 100.0; });
  declare.text("--tone", "NAME",
               fmt::format("PNG: tone curve, one of {} (default linear: clipped)",
                           fmt::join(image::tone_names(), ", ")),
               [&](const std::string& value) {
                 const std::optional<image::Tone> tone = image::tone_named(value);
                 if (!tone) {
                   refuse("--tone", value,
                          fmt::format("one of {}", fmt::join(image::tone_names(), ", ")));
                 }
                 options.encoding.tone = *tone;
               });
  declare.flag("--half", "EXR: 16-bit floats; what is above 65504 is written as 65504",
               [&] { options.encoding.half = true; });
}

void declare_method(Declarer& declare, RenderOptions& options, const char* passes) {
  render::Settings& settings = options.settings;
  constexpr std::uint64_t kMany = std::numeric_limits<std::uint32_t>::max();
  declare.group("Method");
  declare_integrator(declare, settings);
  declare_passes(declare, options,
                 options.usual_passes > 0
                     ? fmt::format("{} (default {})", passes, options.usual_passes)
                     : fmt::format("{} (default any number)", passes));
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
  declare_photon_map(declare, settings);
  declare.whole<std::uint32_t>(
      "--spp", settings.samples_per_pixel, 1, kMany,
      fmt::format("eye paths a pixel, stratified (default {}); methods whose\n"
                  "passes are samples: the same as --passes",
                  settings.samples_per_pixel));
  declare_filter(declare, settings);
  declare.whole<std::uint32_t>(
      "--seed", settings.seed, 0, std::numeric_limits<std::uint32_t>::max(),
      fmt::format("what every random number follows from (default {})", settings.seed));
  declare.whole<std::uint32_t>(
      "--max-depth", settings.max_depth, 0, 255,
      fmt::format("scattering events between light and eye at most; 0: no limit (default {})",
                  settings.max_depth));
}

void declare_outputs(Declarer& declare, RenderOptions& options, CLI::App& app) {
  declare_files(declare, options, app);
}

void declare_passes(Declarer& declare, RenderOptions& options, const std::string& help) {
  declare.whole<std::uint64_t>("--passes", options.passes, 1,
                               std::numeric_limits<std::uint32_t>::max(), help);
}

void declare_time(Declarer& declare, RenderOptions& options) {
  declare.text("--time", "30|90s|10m|2h",
               "time of rendering; the pass in hand is finished. Without --passes\n"
               "as many as that takes",
               [&](const std::string& value) {
                 options.seconds = parse_duration(value);
                 if (!options.seconds) {
                   refuse("--time", value, "a time such as 30, 90s, 10m or 2h");
                 }
               });
}

void declare_camera(Declarer& declare, RenderOptions& options) {
  declare.group("Picture and camera");
  declare.whole<std::uint32_t>(
      "--width", options.width, 1, kLargestSide,
      fmt::format("pixels (default {}, or from --height and the camera's aspect)",
                  options.settings.width));
  declare.whole<std::uint32_t>("--height", options.height, 1, kLargestSide,
                               "pixels (default from the width and the camera's aspect, or 4:3)");
  declare.text("--scene", "NAME|INDEX",
               "scene of the file (default the one it names, or the first)",
               [&](const std::string& value) {
                 if (value.empty()) refuse("--scene", value, "a name or an index");
                 options.load.scene = value;
               });
  declare.text("--camera", "NAME|INDEX", "camera of the file (default the first)",
               [&](const std::string& value) { options.camera = value; });
  declare.vector("--camera-position", options.camera_position,
                 "where the camera stands, in scene units");
  declare.vector("--camera-target", options.camera_target,
                 "what the camera looks at, in scene units");
  declare.vector("--camera-up", options.camera_up,
                 "what is up in the picture (default 0,1,0 with --camera-target)");
  declare.real("--camera-fov", "DEGREES", options.camera_fov,
               "an angle between 0 and 180, both excluded",
               "vertical field of view; makes an orthographic camera\na perspective one",
               [](double value) { return value > 0.0 && value < 180.0; });
}

void declare_lights(Declarer& declare, RenderOptions& options) {
  scene::LoadOptions& load = options.load;
  declare.group("Light");
  declare.text("--env", "FILE.hdr|.exr", "lat-long map of the light from all around",
               [&](const std::string& value) {
                 if (!scene::is_environment_file(value)) {
                   refuse("--env", value, "a file name that ends in .hdr or .exr");
                 }
                 load.environment = value;
               });
  declare.real("--env-rotation", "DEGREES", load.environment_rotation, "a number from -360 to 360",
               "turns it about the vertical, counter-clockwise seen from above (default 0)",
               [](double value) { return std::abs(value) <= 360.0; });
  declare.real("--env-strength", "S", load.environment_strength, "a number from 0 to 1e12",
               "multiplies its radiance (default 1)",
               [](double value) { return value >= 0.0 && value <= 1e12; });
  declare.real("--luminous-efficacy", "K", load.luminous_efficacy, "a number from 1e-6 to 1e6",
               "divides the intensity of punctual lights; 683 where the file gives\n"
               "lumens, as Blender writes them by default (default 1: watts)",
               [](double value) { return value >= 1e-6 && value <= 1e6; });
}

void declare_memory(Declarer& declare, RenderOptions& options) {
  declare.text("--memory-budget", "SIZE",
               "memory that all together may take, such as 4G: where that is short less\n"
               "is held at a time (default what machine and device have left)",
               [&](const std::string& value) {
                 options.memory_budget = parse_size(value);
                 if (!options.memory_budget) {
                   refuse("--memory-budget", value, "a size such as 4G or 512M");
                 }
               });
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
  declare_memory(declare, options);
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
      fmt::format("hit points, or paths, a tile holds at most (default {})",
                  options.settings.tile_hits));
  declare.text("--segment-bytes", "N",
               "bytes of a segment of the scene's buffers at most (default 134217728)",
               [&](const std::string& value) {
                 const auto bytes = parse_number<std::uint64_t>(value);
                 if (!bytes || *bytes < 1024 || !std::has_single_bit(*bytes)) {
                   refuse("--segment-bytes", value, "a power of two from 1024 on");
                 }
                 options.settings.segment_bytes = *bytes;
               });
  declare.whole<std::uint64_t>("--photon-capacity", options.settings.photon_capacity, 1, kMany,
                               "photons stored at a time at most (default what suits the device)");
  declare.whole<std::uint32_t>(
      "--passes-in-flight", options.settings.passes_in_flight, 1, 16,
      "photon passes that the device is given at a time (default what suits it)");
}

void declare_render(CLI::App& app, RenderOptions& options) {
  set_usage(app,
            "Usage: ppm-vk render SCENE.glb|.gltf -o FILE.exr|.png|.hdr|.pfm [-o ...] [OPTIONS]\n");
  app.allow_extras();
  Declarer declare(app);
  declare.text("SCENE", "", "glTF 2.0 file, .glb or .gltf",
               [&](const std::string& value) { options.scene = value; });
  declare_outputs(declare, options, app);
  declare_method(declare, options, "passes: of photons, or samples of each pixel");
  declare_time(declare, options);
  declare_total_photons(declare, options);
  declare_camera(declare, options);
  declare_lights(declare, options);
  declare_run(declare, options, true);
  declare_machine(declare, options);
  declare_testing(declare, options);
}

void check_extras(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining();
  if (extras.empty()) return;
  const bool is_option = extras.front().starts_with('-');
  throw CLI::ValidationError(extras.front(),
                             is_option ? "no such option" : "one argument too many");
}

void take_method(const CLI::App& app, RenderOptions& options) {
  const render::Method method = render::method_named(options.settings.integrator);
  for (const render::Method& other : render::methods()) {
    for (const CLI::Option* const option : app.get_options()) {
      const std::string name = option->get_name();
      if (option->count() == 0 || !other.has_option(name) || method.has_option(name)) continue;
      throw CLI::ValidationError(name, fmt::format("is no option of --integrator {}", method.name));
    }
  }
  std::uint32_t& samples = options.settings.samples_per_pixel;
  const bool has_samples = app.count("--spp") > 0;
  if (method.unit != render::PassUnit::photons) {
    if (has_samples && options.passes && *options.passes != samples) {
      throw CLI::ValidationError(
          "--spp", fmt::format("means the same as --passes with --integrator {}", method.name));
    }
    if (has_samples) options.passes = samples;
    samples = 1;
  } else if (samples > kMostSamples) {
    refuse("--spp", std::to_string(samples),
           fmt::format("a whole number from 1 to {}", kMostSamples));
  }
}

void check_shared(const CLI::App& app, const RenderOptions& options) {
  for (const char* name : {"--env-rotation", "--env-strength"}) {
    if (app.count(name) > 0 && app.count("--env") == 0) {
      throw CLI::ValidationError(name, "needs --env");
    }
  }
  for (const auto& output : options.outputs) {
    if (!options.load.environment.empty() && same_file(output, options.load.environment)) {
      refuse("-o", output.string(), "a file of its own");
    }
  }
  check_verbosity(app);
  check_camera(options);
}

void check_verbosity(const CLI::App& app) {
  if (app.count("--quiet") > 0 && app.count("--verbose") > 0) {
    throw CLI::ValidationError("--quiet", "excludes --verbose");
  }
}

void check_camera(const RenderOptions& options) {
  if (options.camera_up && *options.camera_up == glm::dvec3(0.0)) {
    refuse("--camera-up", "0,0,0", "a direction");
  }
  if (options.camera_position && options.camera_target &&
      *options.camera_position == *options.camera_target) {
    throw CLI::ValidationError("--camera-target", "is the same point as --camera-position");
  }
}

void check_render(const CLI::App& app, RenderOptions& options) {
  check_extras(app);
  take_method(app, options);
  if (options.scene.empty()) throw CLI::ValidationError("SCENE", "no scene file is given");
  if (options.outputs.empty()) {
    throw CLI::ValidationError("-o", "no picture to write is given, such as -o out.exr");
  }
  check_layers(app, options);
  if (app.count("--stats") > 0 && options.stats.empty()) refuse("--stats", "", "a file name");
  check_run(app, options);
  check_shared(app, options);
  options.run.words = words_of(app);
}

}  // namespace ppm::cli
