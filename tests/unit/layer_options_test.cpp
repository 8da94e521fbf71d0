// --aov and --display on the command line.
#include <gtest/gtest.h>

#include "display_options.hpp"
#include "options.hpp"

namespace ppm::cli {
namespace {

struct Parsed {
  Options options;
  std::string err;
};

Parsed parse_words(std::vector<const char*> more) {
  std::vector<const char*> words{"ppm-vk", "render", "s.glb"};
  words.insert(words.end(), more.begin(), more.end());
  testing::internal::CaptureStderr();
  Parsed parsed;
  parsed.options = parse(static_cast<int>(words.size()), words.data());
  parsed.err = testing::internal::GetCapturedStderr();
  return parsed;
}

RenderOptions accepted(std::vector<const char*> more) {
  more.insert(more.begin(), {"-o", "o.exr"});
  const Parsed parsed = parse_words(more);
  EXPECT_EQ(parsed.options.verb, Verb::render) << parsed.err;
  return parsed.options.render;
}

/// One line, exit code 2, that begins with `words`.
void expect_refused(std::vector<const char*> more, const std::string& words) {
  const Parsed parsed = parse_words(std::move(more));
  EXPECT_EQ(parsed.options.verb, Verb::nothing);
  EXPECT_EQ(parsed.options.exit_code, 2);
  EXPECT_EQ(parsed.err.rfind("ppm-vk: error: " + words, 0), 0u) << parsed.err;
  EXPECT_EQ(parsed.err.find('\n') + 1, parsed.err.size());
}

using render::LayerKind;

TEST(LayerOptions, NamesBecomeKindsOnceEach) {
  EXPECT_TRUE(accepted({}).layers.empty());
  EXPECT_EQ(accepted({"--aov", "depth,albedo,depth"}).layers,
            (std::vector<LayerKind>{LayerKind::depth, LayerKind::albedo}));
  EXPECT_EQ(accepted({"--aov",
                      "albedo,normal,geometric-normal,depth,position,radius,photons,"
                      "density,direct-emission"})
                .layers.size(),
            9u);
  EXPECT_EQ(accepted({"--aov", "position", "--integrator", "mlt"}).layers.size(), 1u);
  EXPECT_EQ(accepted({"--aov", "radius", "--integrator", "pm"}).layers.size(), 1u);
}

TEST(LayerOptions, WhatCannotBeIsRefused) {
  for (const char* names : {"", "Albedo", "albedo,", "albedo normal", "beauty"}) {
    expect_refused({"-o", "o.exr", "--aov", names}, "--aov: ");
  }
  expect_refused({"-o", "o.exr", "--aov", "albedo,beauty"},
                 "--aov: 'beauty' is not one of albedo, normal, ");
  for (const char* method : {"pt", "pt-mis", "bdpt", "lt", "mlt"}) {
    expect_refused({"-o", "o.exr", "--aov", "albedo,radius", "--integrator", method},
                   "--aov: radius is no layer of --integrator " + std::string(method));
  }
  expect_refused({"-o", "o.png", "-o", "o.hdr", "--aov", "albedo"}, "--aov: needs a picture");
  expect_refused({"-o", "o.pfm", "-o", "o.albedo.pfm", "--aov", "albedo"}, "--aov: 'o.albedo.pfm'");
}

TEST(LayerOptions, ViewersHaveAddresses) {
  EXPECT_FALSE(accepted({}).display);
  const auto expect_display = [](const char* text, const char* host, unsigned port) {
    const auto display = accepted({"--display", text}).display;
    ASSERT_TRUE(display) << text;
    EXPECT_EQ(display->host, host) << text;
    EXPECT_EQ(display->port, port) << text;
  };
  expect_display("tev", "127.0.0.1", 14158);
  expect_display("tev:9000", "127.0.0.1", 9000);
  expect_display("tev:desk", "desk", 14158);
  expect_display("tev:desk:9000", "desk", 9000);
  expect_display("tev:[::1]:9000", "::1", 9000);
  expect_display("tev:[::1]", "::1", 14158);
  for (const char* text : {"", "TEV", "tev:", "tev:desk:", "tev:desk:0", "tev:desk:x",
                           "tev::1:9000", "tev:desk:65536", "window"}) {
    expect_refused({"-o", "o.exr", "--display", text}, "--display: ");
  }
}

}  // namespace
}  // namespace ppm::cli
