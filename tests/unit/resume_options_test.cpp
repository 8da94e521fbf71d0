// From a checkpoint's words and the command line of resume to the command line of render.
#include "resume_options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace ppm::cli {
namespace {

using Words = std::vector<std::string>;

Options parse_words(const Words& words) {
  std::vector<const char*> arguments{"ppm-vk"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  return parse(static_cast<int>(arguments.size()), arguments.data());
}

/// The words that a checkpoint of this command line would hold.
Words kept(Words more) {
  more.insert(more.begin(), {"render", "/x/s.glb", "-o", "/x/o.exr", "--checkpoint", "/x/c"});
  const Options options = parse_words(more);
  EXPECT_EQ(options.verb, Verb::render);
  return options.render.run.words;
}

/// The rendering that goes on from there.
RenderOptions resumed(const Words& first, Words more) {
  more.insert(more.begin(), {"resume", "/y/c"});
  const Options resume = parse_words(more);
  EXPECT_EQ(resume.verb, Verb::resume);
  const Words words = resumed_words(kept(first), resume.resume);
  const Options options = parse_resumed(words);
  EXPECT_EQ(options.verb, Verb::render) << testing::PrintToString(words);
  return options.render;
}

TEST(ResumeOptions, WordsAreWhatWasGiven) {
  Words words = kept({"--photons=7", "--exposure", "-1.5", "--camera", "a=b c", "--verbose", "-o",
                      "rel.png", "--env=e.hdr", "--camera-target", "-1,0,0", "--device", ""});
  std::ranges::sort(words);
  const std::string here = std::filesystem::current_path().string();
  Words expected = {"--camera=a=b c",
                    "--camera-target=-1,0,0",
                    "--checkpoint=/x/c",
                    "--env=" + here + "/e.hdr",
                    "--exposure=-1.5",
                    "--output=/x/o.exr",
                    "--output=" + here + "/rel.png",
                    "--photons=7",
                    "--verbose",
                    "/x/s.glb"};
  std::ranges::sort(expected);
  EXPECT_EQ(words, expected);
}

TEST(ResumeOptions, EverythingStaysUnlessGiven) {
  const RenderOptions options = resumed({"--photons",
                                         "7",
                                         "--alpha",
                                         "0.6",
                                         "--passes",
                                         "9",
                                         "--exposure",
                                         "-1.5",
                                         "--seed",
                                         "5",
                                         "--camera",
                                         "east",
                                         "--camera-position",
                                         "-1,2,3",
                                         "--env",
                                         "/x/e.hdr",
                                         "--width",
                                         "33",
                                         "--preview",
                                         "/x/v.png",
                                         "--checkpoint-every",
                                         "2m"},
                                        {});
  EXPECT_EQ(options.scene, "/x/s.glb");
  EXPECT_EQ(options.outputs, std::vector<std::filesystem::path>{"/x/o.exr"});
  EXPECT_EQ(options.run.checkpoint, "/y/c");  // wherever it is now
  EXPECT_EQ(options.run.checkpoint_seconds, 120.0);
  EXPECT_EQ(options.run.preview, "/x/v.png");
  EXPECT_EQ(options.settings.photons_per_pass, 7u);
  EXPECT_EQ(options.settings.alpha, 0.6);
  EXPECT_EQ(options.settings.seed, 5u);
  EXPECT_EQ(options.passes, 9u);
  EXPECT_EQ(options.encoding.exposure, -1.5);
  EXPECT_EQ(options.camera, "east");
  EXPECT_EQ(options.camera_position, glm::dvec3(-1.0, 2.0, 3.0));
  EXPECT_EQ(options.load.environment, "/x/e.hdr");
  EXPECT_EQ(options.width, 33u);
}

TEST(ResumeOptions, WhatIsGivenCounts) {
  const RenderOptions options = resumed(
      {"-o", "/x/p.png", "--exposure", "1", "--dispatch-ms", "5", "--verbose", "--stats",
       "/x/s.json", "--progress", "json", "--validate"},
      {"--output=/y/q.hdr", "-o", "/y/r.exr", "--exposure", "-2", "--dispatch-ms", "7", "--quiet"});
  EXPECT_EQ(options.outputs, (std::vector<std::filesystem::path>{"/y/q.hdr", "/y/r.exr"}));
  EXPECT_EQ(options.encoding.exposure, -2.0);
  EXPECT_EQ(options.device.dispatch_milliseconds, 7.0);
  EXPECT_EQ(options.verbosity, Verbosity::quiet);
  // Of the first session alone.
  EXPECT_TRUE(options.stats.empty());
  EXPECT_FALSE(options.run.progress_json || options.device.validation);
}

TEST(ResumeOptions, AnyEndReplacesAllOfThem) {
  const Words first = {"--passes", "9", "--time", "5", "--total-photons", "3"};
  const RenderOptions passes = resumed(first, {"--passes", "20"});
  EXPECT_EQ(passes.passes, 20u);
  EXPECT_FALSE(passes.seconds || passes.run.total_photons);
  const RenderOptions time = resumed(first, {"--time", "1h"});
  EXPECT_EQ(time.seconds, 3600.0);
  EXPECT_FALSE(time.passes || time.run.total_photons);
  const RenderOptions same = resumed(first, {});
  EXPECT_EQ(same.passes, 9u);
  EXPECT_EQ(same.seconds, 5.0);
  EXPECT_EQ(same.run.total_photons, 3u);
  // --spp is a number of passes where passes are samples, and shapes the picture elsewhere.
  EXPECT_EQ(resumed({"--integrator", "pt", "--spp", "9"}, {"--passes", "20"}).passes, 20u);
  EXPECT_EQ(resumed({"--spp", "9"}, {"--passes", "20"}).settings.samples_per_pixel, 9u);
}

TEST(ResumeOptions, WhatShapesThePictureIsRefused) {
  for (const Words& more : std::vector<Words>{{"--photons", "5"},
                                              {"--alpha", "0.5"},
                                              {"--seed", "1"},
                                              {"--width", "8"},
                                              {"--spp", "8"},
                                              {"--integrator", "pt"},
                                              {"--env", "e.hdr"},
                                              {"--checkpoint", "c"},
                                              {"another"},
                                              {"--quiet", "--verbose"},
                                              {"--passes", "0"}}) {
    Words words = {"resume", "c"};
    words.insert(words.end(), more.begin(), more.end());
    testing::internal::CaptureStderr();
    const Options options = parse_words(words);
    const std::string line = testing::internal::GetCapturedStderr();
    EXPECT_EQ(options.verb, Verb::nothing) << line;
    EXPECT_EQ(options.exit_code, 2);
    EXPECT_EQ(line.rfind("ppm-vk: error: " + more[0] + ": ", 0), 0u) << line;
    EXPECT_NE(line.find("see ppm-vk help resume"), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace ppm::cli
