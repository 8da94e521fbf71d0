// The command line as values: defaults, every option, every refusal.
#include "options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "budget.hpp"

namespace ppm::cli {
namespace {

struct Parsed {
  Options options;
  std::string out, err;
};

Parsed parse_line(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "ppm-vk");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Parsed parsed;
  parsed.options = parse(static_cast<int>(arguments.size()), arguments.data());
  std::fflush(stdout);
  parsed.out = testing::internal::GetCapturedStdout();
  parsed.err = testing::internal::GetCapturedStderr();
  return parsed;
}

/// `render s.glb -o o.exr` and more, which must be accepted.
RenderOptions accepted(std::vector<const char*> more) {
  more.insert(more.begin(), {"render", "s.glb", "-o", "o.exr"});
  const Parsed parsed = parse_line(more);
  EXPECT_EQ(parsed.options.verb, Verb::render) << parsed.err;
  EXPECT_EQ(parsed.err, "");
  return parsed.options.render;
}

/// Checks exit code 2, silence on stdout and one line on stderr that names `culprit`.
void expect_refused(const std::vector<const char*>& arguments, const std::string& culprit) {
  std::string line;
  for (const char* argument : arguments) line += std::string(argument) + " ";
  SCOPED_TRACE(line);
  const Parsed parsed = parse_line(arguments);
  EXPECT_EQ(parsed.options.verb, Verb::nothing);
  EXPECT_EQ(parsed.options.exit_code, 2);
  EXPECT_EQ(parsed.out, "");
  EXPECT_EQ(parsed.err.rfind("ppm-vk: error: " + culprit, 0), 0u) << parsed.err;
  EXPECT_NE(parsed.err.find(": see ppm-vk help"), std::string::npos) << parsed.err;
  EXPECT_EQ(std::count(parsed.err.begin(), parsed.err.end(), '\n'), 1) << parsed.err;
}

void expect_value_refused(const char* option, std::initializer_list<const char*> values) {
  for (const char* value : values) {
    expect_refused({"render", "s.glb", "-o", "o.exr", option, value}, option);
  }
}

TEST(Options, DefaultsAreTheDocumentedOnes) {
  const RenderOptions options = accepted({});
  EXPECT_EQ(options.scene, "s.glb");
  EXPECT_EQ(options.outputs, std::vector<std::filesystem::path>{"o.exr"});
  EXPECT_FALSE(options.width || options.height);
  EXPECT_EQ(options.passes_or_usual(), 64u);
  EXPECT_FALSE(options.passes || options.seconds);
  EXPECT_EQ(options.encoding.exposure, 0.0);
  EXPECT_EQ(options.encoding.tone, image::Tone::linear);
  EXPECT_FALSE(options.encoding.half);
  EXPECT_TRUE(options.camera.empty() && options.stats.empty() && options.device.selector.empty());
  EXPECT_FALSE(options.camera_position || options.camera_target || options.camera_up);
  EXPECT_FALSE(options.camera_fov);
  EXPECT_EQ(options.verbosity, Verbosity::normal);
  EXPECT_EQ(options.device.dispatch_milliseconds, 50.0);
  EXPECT_FALSE(options.device.validation);
  const render::Settings& settings = options.settings;
  EXPECT_EQ(settings.integrator, "ppm");
  EXPECT_EQ(settings.width, 640u);
  EXPECT_EQ(settings.photons_per_pass, 100000u);
  EXPECT_EQ(settings.alpha, 0.7);
  EXPECT_EQ(settings.radius_mode, render::RadiusMode::automatic);
  EXPECT_EQ(settings.samples_per_pixel, 4u);
  EXPECT_EQ(settings.filter, render::Filter::box);
  EXPECT_EQ(settings.seed, 0u);
  EXPECT_EQ(settings.max_depth, 0u);
}

TEST(Options, EveryOptionArrives) {
  const RenderOptions options = accepted({"--integrator",
                                          "ppm",
                                          "--width",
                                          "32768",
                                          "--height",
                                          "1",
                                          "--passes",
                                          "7",
                                          "--time",
                                          "1.5m",
                                          "--photons",
                                          "12",
                                          "--alpha",
                                          "0.5",
                                          "--radius",
                                          "2.5e-3",
                                          "--spp",
                                          "9",
                                          "--filter",
                                          "gaussian",
                                          "--seed",
                                          "4294967295",
                                          "--max-depth",
                                          "255",
                                          "--camera",
                                          "east",
                                          "--camera-position",
                                          "1,-2,3e1",
                                          "--camera-target",
                                          "-.5,0,0",
                                          "--camera-up",
                                          "0,0,1",
                                          "--camera-fov",
                                          "39.5",
                                          "--device",
                                          "llvm",
                                          "--dispatch-ms",
                                          "12.5",
                                          "--exposure",
                                          "-1.5",
                                          "--stats",
                                          "s.json",
                                          "--threads",
                                          "3",
                                          "--verbose",
                                          "--validate",
                                          "--tile-hits",
                                          "100",
                                          "--segment-bytes",
                                          "65536",
                                          "--memory-budget",
                                          "4G",
                                          "--photon-capacity",
                                          "200",
                                          "--passes-in-flight",
                                          "3",
                                          "-o",
                                          "second.PNG",
                                          "--output",
                                          "third.Hdr"});
  EXPECT_EQ(options.width, 32768u);
  EXPECT_EQ(options.height, 1u);
  EXPECT_EQ(options.passes, 7u);
  EXPECT_EQ(options.seconds, 90.0);
  EXPECT_EQ(options.camera, "east");
  EXPECT_EQ(options.camera_position, glm::dvec3(1.0, -2.0, 30.0));
  EXPECT_EQ(options.camera_target, glm::dvec3(-0.5, 0.0, 0.0));
  EXPECT_EQ(options.camera_up, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(options.camera_fov, 39.5);
  EXPECT_EQ(options.device.selector, "llvm");
  EXPECT_EQ(options.device.dispatch_milliseconds, 12.5);
  EXPECT_TRUE(options.device.validation);
  EXPECT_EQ(options.encoding.exposure, -1.5);
  EXPECT_EQ(options.stats, "s.json");
  EXPECT_EQ(options.threads, 3u);
  EXPECT_EQ(options.verbosity, Verbosity::verbose);
  EXPECT_EQ(options.outputs,
            (std::vector<std::filesystem::path>{"o.exr", "second.PNG", "third.Hdr"}));
  const render::Settings& settings = options.settings;
  EXPECT_EQ(settings.photons_per_pass, 12u);
  EXPECT_EQ(settings.alpha, 0.5);
  EXPECT_EQ(settings.radius_mode, render::RadiusMode::fixed);
  EXPECT_EQ(settings.radius, 2.5e-3);
  EXPECT_EQ(settings.samples_per_pixel, 9u);
  EXPECT_EQ(settings.filter, render::Filter::gaussian);
  EXPECT_EQ(settings.seed, 4294967295u);
  EXPECT_EQ(settings.max_depth, 255u);
  EXPECT_EQ(settings.tile_hits, 100u);
  EXPECT_EQ(settings.photon_capacity, 200u);
  EXPECT_EQ(settings.passes_in_flight, 3u);
}

TEST(Options, WordsAndQuiet) {
  EXPECT_EQ(accepted({"--radius", "footprint"}).settings.radius_mode,
            render::RadiusMode::footprint);
  EXPECT_EQ(accepted({"--radius=auto"}).settings.radius_mode, render::RadiusMode::automatic);
  EXPECT_EQ(accepted({"--filter=tent"}).settings.filter, render::Filter::tent);
  EXPECT_EQ(accepted({"--quiet"}).verbosity, Verbosity::quiet);
  EXPECT_TRUE(accepted({"--half"}).encoding.half);
  EXPECT_EQ(accepted({"--tone", "pbr-neutral"}).encoding.tone, image::Tone::pbr_neutral);
}

TEST(Options, OutputTakesOneFileAtATime) {
  const Parsed parsed = parse_line({"render", "-o", "o.exr", "s.glb"});
  ASSERT_EQ(parsed.options.verb, Verb::render) << parsed.err;
  EXPECT_EQ(parsed.options.render.scene, "s.glb");
}

TEST(Options, ValuesOutOfRangeAreRefused) {
  for (const char* option : {"--width", "--height"}) {
    expect_value_refused(option, {"0", "32769", "-1", "64.0", "1e2", "ten", "", " 5"});
  }
  for (const char* option : {"--passes", "--photons"}) {
    expect_value_refused(option, {"0", "-1", "4294967296", "99999999999999999999999", "x"});
  }
  expect_value_refused("--alpha",
                       {"0", "1", "-0.5", "1.5", "nan", "inf", "0.7x", "0.999999999999"});
  expect_value_refused("--radius", {"0", "-1", "nan", "inf", "1e999", "Auto", ""});
  expect_value_refused("--spp", {"0", "65537"});
  expect_value_refused("--map-photons", {"0", "20000001", "2M"});
  expect_value_refused("--nearest", {"0", "-1", "1000001"});
  expect_value_refused("--filter", {"Box", "mitchell", ""});
  expect_value_refused("--seed", {"-1", "4294967296"});
  expect_value_refused("--max-depth", {"-1", "256"});
  expect_value_refused("--camera-fov", {"0", "180", "-10", "nan", "inf"});
  for (const char* option : {"--camera-position", "--camera-target", "--camera-up"}) {
    expect_value_refused(option,
                         {"1,2", "1,2,3,4", "1,2,", "a,b,c", "1,nan,2", "inf,0,0", "1, 2, 3", ""});
  }
  expect_value_refused("--camera-up", {"0,0,0"});
  expect_value_refused("--dispatch-ms", {"0", "-5", "nan", "inf"});
  expect_value_refused("--exposure", {"nan", "inf", "101", "-101"});
  expect_value_refused("--tone", {"ACES", "filmic", ""});
  expect_value_refused("--threads", {"-1", "4097", "all"});
  expect_value_refused("--integrator", {"magic", "PPM", ""});
  expect_value_refused("--time", {"0", "-1", "", "s", "10 s", "nan", "inf", "3d", "1e9"});
  expect_value_refused("-o", {"o.jpg", "o", "", ".exr", "exr"});
  expect_value_refused("--stats", {"", "s.glb", "o.exr", "./o.exr"});
  expect_value_refused("--tile-hits", {"0", "-1"});
  expect_value_refused("--segment-bytes", {"0", "512", "5000", "-1", "4k"});
  expect_value_refused("--memory-budget", {"0", "", "4GB", "-1G", "much"});
  expect_value_refused("--photon-capacity", {"0", "-1"});
  expect_value_refused("--passes-in-flight", {"0", "17", "x"});
}

TEST(Options, FilesThatAreWrittenAreOnesOfTheirOwn) {
  expect_refused({"render", "s.glb", "-o", "e.exr", "--env", "./e.exr"}, "-o");
  expect_refused({"view", "s.glb", "-o", "e.exr", "--env", "e.exr"}, "-o");
  constexpr std::pair<const char*, const char*> kClashes[] = {
      // the second one is told of
      {"--env", "--preview"},   {"--env", "--checkpoint"},    {"--env", "--stats"},
      {"-o", "--preview"},      {"-o", "--checkpoint"},       {"--checkpoint", "--stats"},
      {"--stats", "--preview"}, {"--checkpoint", "--preview"}};
  for (const auto& [one, other] : kClashes) {
    expect_refused({"render", "s.glb", "-o", "o.exr", one, "e.exr", other, "./e.exr"}, other);
    expect_refused({"render", "s.glb", "-o", "o.exr", other, "./e.exr", one, "e.exr"}, other);
  }
}

TEST(Options, SamplesAreThePassesOfMethodsThatTakeThem) {
  for (const char* const method : {"pt", "pt-mis"}) {
    EXPECT_EQ(accepted({"--integrator", method, "--spp", "100000"}).passes, 100000u);
    EXPECT_EQ(accepted({"--passes", "9", "--integrator", method}).passes, 9u);
    EXPECT_EQ(accepted({"--integrator", method}).passes_or_usual(), 64u);
    expect_refused(
        {"render", "s.glb", "-o", "o.exr", "--integrator", method, "--spp", "4", "--passes", "5"},
        "--spp");
    for (const char* const option : {"--photons", "--alpha", "--radius"}) {
      const char* const value = option == std::string("--photons") ? "5" : "0.5";
      expect_refused({"render", "s.glb", "-o", "o.exr", option, value, "--integrator", method},
                     option);
    }
  }
  EXPECT_FALSE(accepted({"--spp", "9"}).passes);
}

TEST(Options, TimesHaveUnits) {
  for (const auto& [text, seconds] : std::vector<std::pair<const char*, double>>{
           {"30", 30.0}, {"90s", 90.0}, {"0.5", 0.5}, {"10m", 600.0}, {"2h", 7200.0}}) {
    EXPECT_EQ(accepted({"--time", text}).seconds, seconds);
  }
}

// The smaller of what is given; the usual 64 only where nothing is.
TEST(Options, TheFirstEndThatIsReachedCounts) {
  constexpr auto kAny = std::nullopt;
  const std::vector<
      std::tuple<std::vector<const char*>, std::optional<std::uint64_t>, std::optional<double>>>
      cases = {
          {{}, 64, kAny},
          {{"--time", "5"}, kAny, 5.0},
          {{"--integrator", "pm"}, kAny, kAny},
          {{"--photons", "1000", "--total-photons", "1"}, 1, kAny},
          {{"--photons", "1000", "--total-photons", "5000"}, 5, kAny},
          {{"--photons", "1000", "--total-photons", "5001"}, 6, kAny},
          {{"--photons", "1000", "--total-photons", "5001", "--passes", "4"}, 4, kAny},
          {{"--photons", "1000", "--total-photons", "5001", "--passes", "9"}, 6, kAny},
          {{"--photons", "1000", "--total-photons", "5001", "--time", "2m"}, 6, 120.0},
          {{"--photons", "1", "--total-photons", "9007199254740992"}, 4294967295u, kAny},
          {{"--integrator", "pm", "--total-photons", "150000"}, 2, kAny},
      };
  for (const auto& [words, passes, seconds] : cases) {
    SCOPED_TRACE(testing::PrintToString(words));
    const render::Budget budget = budget_for(accepted(words));
    EXPECT_EQ(budget.passes, passes);
    EXPECT_EQ(budget.seconds, seconds);
  }
  expect_value_refused("--total-photons", {"0", "-1", "1e9", "9007199254740993", ""});
  for (const char* const method : {"pt", "pt-mis", "bdpt", "lt", "mlt"}) {
    expect_refused(
        {"render", "s.glb", "-o", "o.exr", "--integrator", method, "--total-photons", "9"},
        "--total-photons");
  }
}

TEST(Options, BrokenUsageIsRefused) {
  expect_refused({}, "no verb");
  expect_refused({"rendr"}, "rendr");
  expect_refused({"--quiet"}, "--quiet");
  expect_refused({"--version", "now"}, "now");
  expect_refused({"help", "me"}, "me");
  expect_refused({"help", "render", "now"}, "now");
  expect_refused({"devices", "all"}, "all");
  expect_refused({"render"}, "SCENE");
  expect_refused({"render", "s.glb"}, "-o");
  expect_refused({"render", "-o", "o.exr"}, "SCENE");
  expect_refused({"render", "s.glb", "t.glb", "-o", "o.exr"}, "t.glb");
  expect_refused({"render", "s.glb", "-o", "o.exr", "--bogus"}, "--bogus");
  expect_refused({"render", "s.glb", "-o", "o.exr", "--pass", "3"}, "--pass");
  expect_refused({"render", "s.glb", "-o", "o.exr", "-x"}, "-x");
  expect_refused({"render", "s.glb", "-o", "o.exr", "--width"}, "--width: a value is missing");
  expect_refused({"render", "s.glb", "-o"}, "--output: a value is missing");
  expect_refused({"render", "s.glb", "-o", "o.exr", "--width", "1", "--width", "2"},
                 "--width: is given more than once");
  expect_refused({"render", "s.glb", "-o", "o.exr", "--quiet", "--verbose"}, "--quiet");
  expect_refused(
      {"render", "s.glb", "-o", "o.exr", "--camera-position", "1,2,3", "--camera-target", "1,2,3"},
      "--camera-target");
  expect_refused({"render", "s.glb", "-o", "o.exr", "two\nlines"}, "two lines");
}

TEST(Options, ThePhotonMapHasItsOwn) {
  const Parsed parsed = parse_line({"render", "s.glb", "-o", "o.exr", "--integrator", "pm",
                                    "--map-photons", "20000000", "--nearest", "1"});
  EXPECT_EQ(parsed.err, "");
  EXPECT_EQ(parsed.options.render.settings.map_photons, 20000000u);
  EXPECT_EQ(parsed.options.render.settings.nearest, 1u);
  expect_refused({"render", "s.glb", "-o", "o.exr", "--nearest", "50"}, "--nearest");
  expect_refused({"render", "s.glb", "-o", "o.exr", "--integrator", "pm", "--alpha", "0.5"},
                 "--alpha");
}

TEST(Options, HelpAndVersionGoToStandardOutput) {
  for (const auto& arguments : std::vector<std::vector<const char*>>{{"--version"},
                                                                     {"help"},
                                                                     {"--help"},
                                                                     {"-h"},
                                                                     {"help", "render"},
                                                                     {"help", "devices"},
                                                                     {"render", "--help"},
                                                                     {"devices", "--help"}}) {
    const Parsed parsed = parse_line(arguments);
    EXPECT_EQ(parsed.options.verb, Verb::nothing);
    EXPECT_EQ(parsed.options.exit_code, 0);
    EXPECT_NE(parsed.out, "") << arguments[0];
    EXPECT_EQ(parsed.err, "");
  }
}

TEST(Options, HelpNamesEveryOption) {
  const std::string help = parse_line({"help", "render"}).out;
  for (const char* option : {"--integrator",
                             "--width",
                             "--height",
                             "--passes",
                             "--time",
                             "--total-photons",
                             "--photons",
                             "--alpha",
                             "--radius",
                             "--map-photons",
                             "--nearest",
                             "--spp",
                             "--filter",
                             "--seed",
                             "--max-depth",
                             "--camera",
                             "--camera-position",
                             "--camera-target",
                             "--camera-up",
                             "--camera-fov",
                             "--device",
                             "--dispatch-ms",
                             "--exposure",
                             "--stats",
                             "--quiet",
                             "--verbose",
                             "--threads",
                             "-o"}) {
    EXPECT_NE(help.find(option), std::string::npos) << option;
  }
  EXPECT_NE(help.find("(default 100000)"), std::string::npos);
  for (const render::Method& method : render::methods()) {
    EXPECT_NE(help.find(std::string(method.summary)), std::string::npos) << method.name;
  }
}

}  // namespace
}  // namespace ppm::cli
