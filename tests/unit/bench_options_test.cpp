// The command line of `ppm-vk bench` as values: defaults, every option, every refusal.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "options.hpp"

namespace ppm::cli {
namespace {

struct Parsed {
  Options options;
  std::string out, err;
};

Parsed parse_bench(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), {"ppm-vk", "bench"});
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Parsed parsed;
  parsed.options = parse(static_cast<int>(arguments.size()), arguments.data());
  std::fflush(stdout);
  parsed.out = testing::internal::GetCapturedStdout();
  parsed.err = testing::internal::GetCapturedStderr();
  return parsed;
}

BenchOptions accepted(const std::vector<const char*>& arguments) {
  const Parsed parsed = parse_bench(arguments);
  EXPECT_EQ(parsed.options.verb, Verb::bench) << parsed.err;
  EXPECT_EQ(parsed.err, "");
  return parsed.options.bench;
}

TEST(BenchOptions, DefaultsAreThoseThatFiguresAreGivenFor) {
  const BenchOptions options = accepted({});
  EXPECT_TRUE(options.scenes.empty());
  EXPECT_EQ(options.repetitions, 5u);
  EXPECT_EQ(options.warmup, 1u);
  EXPECT_EQ(options.render.passes_or_usual(), 4u);
  EXPECT_FALSE(options.aged);
  EXPECT_FALSE(options.scaling);
  EXPECT_EQ(options.json, "");
  EXPECT_TRUE(options.compare.empty());
  EXPECT_EQ(options.tolerance, 0.1);
  EXPECT_EQ(options.render.settings.width, 640u);
  EXPECT_EQ(options.render.settings.samples_per_pixel, 1u);
  EXPECT_EQ(options.render.settings.photons_per_pass, 100000u);
}

TEST(BenchOptions, EveryOptionIsStored) {
  const BenchOptions options =
      accepted({"room", "a b.glb", "--repeat", "7",       "--warmup",  "3",      "--passes",
                "9",    "--aged",  "--json",   "r.json",  "--compare", "o.json", "--tolerance",
                "2.5%", "--spp",   "2",        "--width", "64",        "--seed", "5"});
  EXPECT_EQ(options.scenes, (std::vector<std::string>{"room", "a b.glb"}));
  EXPECT_EQ(options.repetitions, 7u);
  EXPECT_EQ(options.warmup, 3u);
  EXPECT_EQ(options.render.passes, 9u);
  EXPECT_TRUE(options.aged);
  EXPECT_EQ(options.json, "r.json");
  EXPECT_EQ(options.compare, "o.json");
  EXPECT_DOUBLE_EQ(options.tolerance, 0.025);
  EXPECT_EQ(options.render.settings.samples_per_pixel, 2u);
  EXPECT_EQ(options.render.width, 64u);
  EXPECT_EQ(options.render.settings.seed, 5u);
  EXPECT_TRUE(accepted({"--scaling"}).scaling);
  EXPECT_EQ(accepted({"--compare", "a", "--with", "b"}).with, "b");
  EXPECT_EQ(accepted({"--json", "-"}).json, "-");
  EXPECT_DOUBLE_EQ(accepted({"--compare", "a", "--tolerance", "20"}).tolerance, 0.2);
}

TEST(BenchOptions, WrongUsageIsOneLineAndExitCodeTwo) {
  const std::vector<std::pair<std::vector<const char*>, std::string>> cases = {
      {{"cellar"}, "room, big (big-700k, big-1500k), dark, uneven"},
      {{""}, "SCENE"},
      {{"--bogus"}, "--bogus"},
      {{"room", "--repeat", "0"}, "--repeat"},
      {{"room", "--warmup", "0"}, "--warmup"},
      {{"room", "--passes", "0"}, "--passes"},
      {{"room", "--json"}, "--json"},
      {{"room", "--json", ""}, "--json"},
      {{"room", "--aged=no"}, "aged"},
      {{"--compare", ""}, "--compare"},
      {{"--with", "a.json"}, "--compare"},
      {{"--tolerance", "5"}, "--compare"},
      {{"--compare", "a.json", "--tolerance", "-5"}, "--tolerance"},
      {{"--compare", "a.json", "--tolerance", "much"}, "--tolerance"},
      {{"--compare", "a.json", "--tolerance", "nan%"}, "--tolerance"},
      {{"room", "--compare", "a.json", "--with", "b.json"}, "--with"},
      {{"--compare", "a.json", "--with", "b.json", "--json", "c.json"}, "--with"},
      {{"room", "--scaling"}, "--scaling"},
      {{"s.glb", "--json", "s.glb"}, "--json"},
      {{"room", "-o", "a.png"}, "-o"},
      {{"room", "--quiet", "--verbose"}, "--quiet"},
  };
  for (const auto& [arguments, culprit] : cases) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Parsed parsed = parse_bench(arguments);
    EXPECT_EQ(parsed.options.verb, Verb::nothing);
    EXPECT_EQ(parsed.options.exit_code, 2);
    EXPECT_EQ(parsed.out, "");
    EXPECT_EQ(parsed.err.rfind("ppm-vk: error: ", 0), 0u) << parsed.err;
    EXPECT_EQ(parsed.err.find('\n'), parsed.err.size() - 1) << parsed.err;
    EXPECT_NE(parsed.err.find(culprit), std::string::npos) << parsed.err;
    EXPECT_NE(parsed.err.find("see ppm-vk help bench"), std::string::npos) << parsed.err;
  }
}

TEST(BenchOptions, HelpNamesScenesAndOptions) {
  const Parsed parsed = parse_bench({"--help"});
  EXPECT_EQ(parsed.options.exit_code, 0);
  for (const char* word : {"uneven", "--repeat", "--aged", "--scaling", "--json", "--compare",
                           "--with", "--tolerance", "--photons", "--device"}) {
    EXPECT_NE(parsed.out.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace ppm::cli
