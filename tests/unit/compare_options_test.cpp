// The command line of `ppm-vk compare` as values: defaults, every option, every refusal.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "options.hpp"

namespace ppm::cli {
namespace {

struct Parsed {
  Options options;
  std::string err;
};

Parsed parse_compare(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), {"ppm-vk", "compare"});
  testing::internal::CaptureStderr();
  Parsed parsed;
  parsed.options = parse(static_cast<int>(arguments.size()), arguments.data());
  parsed.err = testing::internal::GetCapturedStderr();
  return parsed;
}

CompareOptions accepted(const std::vector<const char*>& arguments) {
  const Parsed parsed = parse_compare(arguments);
  EXPECT_EQ(parsed.options.verb, Verb::compare) << parsed.err;
  EXPECT_EQ(parsed.err, "");
  return parsed.options.compare;
}

TEST(CompareOptions, Defaults) {
  const CompareOptions options = accepted({"s.glb", "-o", "report"});
  EXPECT_EQ(options.report, "report");
  EXPECT_EQ(options.render.seconds, 60.0);
  EXPECT_EQ(options.seeds, 1u);
  EXPECT_EQ(options.reference_seeds, 4u);
  EXPECT_FALSE(options.reference_seconds);
  EXPECT_FALSE(options.reference_method);
  EXPECT_FALSE(options.exposure);
  EXPECT_FALSE(options.figure5);
  ASSERT_FALSE(options.methods.empty());
  EXPECT_EQ(options.methods[0].label, "ppm");
  EXPECT_EQ(options.methods[0].settings.samples_per_pixel, 4u);
}

TEST(CompareOptions, EveryOptionIsStored) {
  const CompareOptions options = accepted({"s.glb",
                                           "-o",
                                           "r/",
                                           "--methods",
                                           "ppm,ppm:alpha=0.8:radius=footprint:photons=500:spp=2",
                                           "--time",
                                           "2m",
                                           "--seeds",
                                           "3",
                                           "--reference-time",
                                           "1h",
                                           "--reference-method",
                                           "ppm:alpha=0.5",
                                           "--reference-seeds",
                                           "8",
                                           "--exposure",
                                           "-1.5",
                                           "--crop",
                                           "1,2,3,4",
                                           "--crop",
                                           "5,6,7,8",
                                           "--probe",
                                           "9,10",
                                           "--probe",
                                           "11,12",
                                           "--figure5",
                                           "--figure-passes",
                                           "64",
                                           "--alpha",
                                           "0.6",
                                           "--max-depth",
                                           "9"});
  EXPECT_EQ(options.render.seconds, 120.0);
  EXPECT_EQ(options.seeds, 3u);
  EXPECT_EQ(options.reference_seconds, 3600.0);
  EXPECT_EQ(options.reference_method->settings.alpha, 0.5);
  EXPECT_EQ(options.reference_seeds, 8u);
  EXPECT_EQ(options.exposure, -1.5);
  EXPECT_EQ(options.crops, (std::vector<glm::uvec4>{{1, 2, 3, 4}, {5, 6, 7, 8}}));
  EXPECT_EQ(options.probes, (std::vector<glm::uvec2>{{9, 10}, {11, 12}}));
  EXPECT_TRUE(options.figure5);
  EXPECT_EQ(options.figure_passes, 64u);
  // What all have in common, and what is a method's own.
  ASSERT_EQ(options.methods.size(), 2u);
  const render::Settings &first = options.methods[0].settings,
                         &second = options.methods[1].settings;
  EXPECT_EQ(first.alpha, 0.6);
  EXPECT_EQ(first.radius_mode, render::RadiusMode::automatic);
  EXPECT_EQ(second.alpha, 0.8);
  EXPECT_EQ(second.radius_mode, render::RadiusMode::footprint);
  EXPECT_EQ(second.photons_per_pass, 500u);
  EXPECT_EQ(second.samples_per_pixel, 2u);
  EXPECT_EQ(first.max_depth, 9u);
  EXPECT_EQ(second.max_depth, 9u);
}

TEST(CompareOptions, RefusalsNameTheOptionInALine) {
  struct Case {
    std::vector<const char*> arguments;
    const char* named;
  };
  const Case kCases[] = {
      {{"-o", "r"}, "no scene file"},
      {{"s.glb"}, "-o"},
      {{"s.glb", "-o", "r", "--methods", "ppm,"}, "--methods: '' is not one of ppm"},
      {{"s.glb", "-o", "r", "--methods", "ppm:"}, "ppm:"},
      {{"s.glb", "-o", "r", "--methods", "ppm:alpha"}, "ppm:alpha"},
      {{"s.glb", "-o", "r", "--methods", "ppm:alpha=x"}, "--alpha"},
      {{"s.glb", "-o", "r", "--methods", "ppm:width=3"}, "ppm:width=3"},
      {{"s.glb", "-o", "r", "--time", "0"}, "--time"},
      {{"s.glb", "-o", "r", "--time", "3d"}, "--time"},
      {{"s.glb", "-o", "r", "--seeds", "0"}, "--seeds"},
      {{"s.glb", "-o", "r", "--reference-time", "-1"}, "--reference-time"},
      {{"s.glb", "-o", "r", "--reference", "a.exr", "--reference-time", "1m"}, "--reference-time"},
      {{"s.glb", "-o", "r", "--reference-method", "magic"}, "magic"},
      {{"s.glb", "-o", "r", "--reference", ""}, "--reference"},
      {{"s.glb", "-o", "r", "--crop", "1,2,3"}, "--crop"},
      {{"s.glb", "-o", "r", "--crop", "1,2,0,4"}, "--crop"},
      {{"s.glb", "-o", "r", "--probe", "1,-2"}, "--probe"},
      {{"s.glb", "-o", "r", "--probe", "1,2,3"}, "--probe"},
      {{"s.glb", "-o", "r", "--figure-passes", "9"}, "--figure-passes"},
      {{"s.glb", "-o", "r", "--exposure", "200"}, "--exposure"},
      {{"s.glb", "-o", "r", "--integrator", "ppm"}, "--integrator"},
      {{"s.glb", "-o", "r", "--passes", "9"}, "--passes"},
      {{"s.glb", "-o", "r", "--stats", "a.json"}, "--stats"},
      {{"s.glb", "-o", "r", "more"}, "more"},
  };
  for (const auto& [arguments, named] : kCases) {
    const Parsed parsed = parse_compare(arguments);
    EXPECT_EQ(parsed.options.verb, Verb::nothing) << named;
    EXPECT_EQ(parsed.options.exit_code, 2) << named;
    EXPECT_NE(parsed.err.find(named), std::string::npos) << parsed.err;
    EXPECT_EQ(parsed.err.find('\n'), parsed.err.size() - 1) << parsed.err;
  }
}

}  // namespace
}  // namespace ppm::cli
