// The command line of `ppm-vk view`.
#include <gtest/gtest.h>

#include "options.hpp"

namespace ppm::cli {
namespace {

Options parsed(std::vector<const char*> words) {
  words.insert(words.begin(), {"ppm-vk", "view"});
  return parse(static_cast<int>(words.size()), words.data());
}

TEST(ViewOptions, NeedAScene) {
  const Options options = parsed({"s.glb"});
  EXPECT_EQ(options.verb, Verb::view);
  const RenderOptions& render = options.view.render;
  EXPECT_EQ(render.scene, "s.glb");
  EXPECT_TRUE(render.outputs.empty());
  EXPECT_FALSE(render.passes);
  EXPECT_EQ(render.settings.integrator, RenderOptions().settings.integrator);
  EXPECT_EQ(parsed({}).exit_code, 2);
}

TEST(ViewOptions, AreThoseOfRender) {
  const RenderOptions render = parsed({"s.glb",
                                       "-o",
                                       "a.png",
                                       "-o",
                                       "a.exr",
                                       "--aov",
                                       "albedo",
                                       "--exposure",
                                       "-1",
                                       "--tone",
                                       "agx",
                                       "--half",
                                       "--integrator",
                                       "pt",
                                       "--spp",
                                       "16",
                                       "--width",
                                       "100",
                                       "--camera-position",
                                       "-1,2,3",
                                       "--camera-target",
                                       "0,0,0",
                                       "--threads",
                                       "2"})
                                   .view.render;
  EXPECT_EQ(render.outputs.size(), 2u);
  EXPECT_EQ(render.layers.size(), 1u);
  EXPECT_EQ(render.encoding.exposure, -1.0);
  EXPECT_EQ(render.encoding.tone, image::Tone::agx);
  EXPECT_TRUE(render.encoding.half);
  EXPECT_EQ(render.passes, 16u);  // whose passes are samples
  EXPECT_EQ(render.camera_position, glm::dvec3(-1.0, 2.0, 3.0));
}

// What a window has no use for, and what is wrong in render, too.
TEST(ViewOptions, OthersAreRefused) {
  const std::vector<const char*> wrong[] = {
      {"--time", "3s"},  {"--checkpoint", "c"},   {"--preview", "p.png"},   {"--display", "tev"},
      {"--stats", "j"},  {"-o", "a.jpg"},         {"--tone", "none"},       {"other.glb"},
      {"--passes", "0"}, {"--aov", "x"},          {"--quiet", "--verbose"}, {"--env-strength", "2"},
      {"--alpha", "1"},  {"--camera-up", "0,0,0"}};
  for (std::vector<const char*> words : wrong) {
    words.insert(words.begin(), "s.glb");
    const Options options = parsed(words);
    EXPECT_EQ(options.verb, Verb::nothing) << words[1];
    EXPECT_EQ(options.exit_code, 2) << words[1];
  }
}

TEST(ViewOptions, HelpTellsOfKeys) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(parsed({"--help"}).exit_code, 0);
  const std::string help = testing::internal::GetCapturedStdout();
  for (const char* part : {"\n  space   pause, and go on\n", "--camera-fov", "any number"}) {
    EXPECT_NE(help.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace ppm::cli
