// Pictures written and read back by OpenImageIO, and files that appear whole or not at all.
#include "image.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <set>
#include <thread>

#include "failure.hpp"
#include "output_file.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::image {
namespace {

using test::file_text;
using test::PictureFile;
using test::read_picture;
using test::TemporaryFolder;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// 3 x 2 pixels that no format confuses: all channels differ, values from 0 to 1000.
const std::vector<float> kPixels = {0.0f,  0.25f, 0.5f,   1.0f, 0.75f, 0.1f, 1e-3f, 2.0f, 1000.0f,
                                    0.02f, 0.3f,  0.004f, 0.6f, 0.9f,  1.1f, 12.5f, 0.0f, 0.33f};
const View kPicture{3, 2, kPixels};

TEST(Image, ExrHoldsTheVeryFloatsAndTheAttributes) {
  const TemporaryFolder folder;
  write(folder / "p.exr", kPicture, {3.0},
        {{"ppm-vk:passes", 7}, {"ppm-vk:alpha", 0.7}, {"ppm-vk:device", "llvmpipe"}});
  const PictureFile read = read_picture(folder / "p.exr");
  EXPECT_EQ(read.spec.width, 3);
  EXPECT_EQ(read.spec.height, 2);
  EXPECT_EQ(read.spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(read.spec.channelnames, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(read.spec.get_string_attribute("compression"), "zip");
  EXPECT_EQ(read.values, kPixels);  // exposure does not touch them
  EXPECT_EQ(read.spec.get_int_attribute("ppm-vk:passes"), 7);
  const auto* const alpha = read.spec.find_attribute("ppm-vk:alpha", OIIO::TypeDesc::DOUBLE);
  ASSERT_NE(alpha, nullptr);
  EXPECT_EQ(*static_cast<const double*>(alpha->data()), 0.7);
  EXPECT_EQ(read.spec.get_string_attribute("ppm-vk:device"), "llvmpipe");
}

TEST(Image, HalvesAreTheNearestAndNeverInfinite) {
  const TemporaryFolder folder;
  write(folder / "p.exr", kPicture, {0.0, Tone::linear, true}, {});
  const PictureFile read = read_picture(folder / "p.exr");
  EXPECT_EQ(read.spec.format, OIIO::TypeDesc::HALF);
  EXPECT_EQ(read.spec.channelnames, (std::vector<std::string>{"R", "G", "B"}));
  ASSERT_EQ(read.values.size(), kPixels.size());
  for (std::size_t i = 0; i < kPixels.size(); ++i) {
    // 11 bits of mantissa, the first of them implied.
    EXPECT_NEAR(read.values[i], kPixels[i], kPixels[i] / 2048.0f) << i;
  }
  const std::vector<float> extremes = {kInfinity, 1e30f, 65504.0f, -kInfinity, 65520.0f, kNaN};
  write(folder / "e.exr", {2, 1, extremes}, {0.0, Tone::linear, true}, {});
  const std::vector<float> held = read_picture(folder / "e.exr").values;
  ASSERT_EQ(held.size(), 6u);
  for (const std::size_t i : {0u, 1u, 2u, 4u}) EXPECT_EQ(held[i], 65504.0f) << i;
  EXPECT_EQ(held[3], -65504.0f);
  EXPECT_TRUE(std::isnan(held[5]));
}

const std::vector<Layer> kLayers = {{"depth", {"Z"}, {1.0f, 2.5f, 1e5f, 4.0f, 0.1f, 6.0f}, true},
                                    {"albedo",
                                     {"Albedo.R", "Albedo.G", "Albedo.B"},
                                     {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 1.0f,
                                      0.9f, 0.8f, 0.7f, 0.6f, 0.5f, 0.4f, 0.3f, 0.2f},
                                     false}};

TEST(Image, ExrHoldsLayersByName) {
  const TemporaryFolder folder;
  for (const bool half : {false, true}) {
    write(folder / "p.exr", kPicture, {0.0, Tone::linear, half}, {}, kLayers);
    const PictureFile read = read_picture(folder / "p.exr");
    const auto channel = [&](const std::string& name) {
      const auto& names = read.spec.channelnames;
      return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    ASSERT_EQ(read.spec.nchannels, 7);
    const auto expect_channel = [&](const std::string& name, const std::vector<float>& values,
                                    std::size_t first, std::size_t count, bool rounded) {
      ASSERT_LT(channel(name), 7u) << name;
      for (std::size_t i = 0; i < 6; ++i) {
        const float value = values[count * i + first];
        EXPECT_NEAR(read.values[7 * i + channel(name)], value, rounded ? value / 2048.0f : 0.0f)
            << name;
      }
    };
    for (std::size_t i = 0; i < 3; ++i) {
      expect_channel(std::string(1, "RGB"[i]), kPixels, i, 3, half);
      expect_channel(kLayers[1].channels[i], kLayers[1].values, i, 3, half);
    }
    expect_channel("Z", kLayers[0].values, 0, 1, false);  // precise
    // Whoever reads the first three channels reads the picture.
    EXPECT_EQ(channel("R"), 0u);
    EXPECT_EQ(channel("B"), 2u);
  }
  EXPECT_EQ(folder.names(), std::set<std::string>{"p.exr"});
}

TEST(Image, PfmHoldsTheVeryFloatsFromTheBottomAndLayersBesideIt) {
  const TemporaryFolder folder;
  write(folder / "p.q.pfm", kPicture, {3.0, Tone::agx, true}, {}, kLayers);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"p.q.pfm", "p.q.albedo.pfm", "p.q.depth.pfm"}));
  const auto expect_file = [&](const char* name, const std::string& header,
                               const std::vector<float>& values) {
    const std::string text = file_text(folder / name);
    ASSERT_EQ(text.substr(0, header.size()), header);
    ASSERT_EQ(text.size(), header.size() + 4 * values.size());
    const std::size_t row = values.size() / 2;
    for (std::size_t i = 0; i < values.size(); ++i) {
      float value = 0.0f;
      std::memcpy(&value, text.data() + header.size() + 4 * i, 4);
      EXPECT_EQ(value, values[(i + row) % values.size()]) << i;  // two rows, the lower first
    }
  };
  expect_file("p.q.pfm", "PF\n3 2\n-1.0\n", kPixels);
  expect_file("p.q.albedo.pfm", "PF\n3 2\n-1.0\n", kLayers[1].values);
  expect_file("p.q.depth.pfm", "Pf\n3 2\n-1.0\n", kLayers[0].values);
}

TEST(Image, HdrHoldsEightBitsOfEachPixelsLargestChannel) {
  const TemporaryFolder folder;
  write(folder / "p.hdr", kPicture, {3.0}, {});
  const PictureFile read = read_picture(folder / "p.hdr");
  ASSERT_EQ(read.values.size(), kPixels.size());
  for (std::size_t i = 0; i < kPixels.size(); ++i) {
    const std::size_t pixel = i - i % 3;
    const float largest = std::max({kPixels[pixel], kPixels[pixel + 1], kPixels[pixel + 2]});
    // The mantissa of the largest channel has 8 bits, so a step is at most 1/128 of it.
    EXPECT_NEAR(read.values[i], kPixels[i], largest / 128.0f) << i;
  }
}

TEST(Image, HdrStandsWhatItCannotHold) {
  const TemporaryFolder folder;
  const std::vector<float> pixels = {kNaN, -1.0f, 0.5f, kInfinity, 1.0f, 3e38f};
  write(folder / "p.hdr", {2, 1, pixels}, {}, {});
  const PictureFile read = read_picture(folder / "p.hdr");
  ASSERT_EQ(read.values.size(), 6u);
  EXPECT_EQ(read.values[0], 0.0f);
  EXPECT_EQ(read.values[1], 0.0f);
  EXPECT_NEAR(read.values[2], 0.5f, 0.004f);
  EXPECT_GT(read.values[3], 1e38f);
  EXPECT_GT(read.values[5], 1e38f);
}

TEST(Image, PngIsSrgbOfTheExposedRadiance) {
  const TemporaryFolder folder;
  write(folder / "p.png", kPicture, {1.0}, {});
  const PictureFile read = read_picture(folder / "p.png");
  EXPECT_EQ(read.spec.format, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(read.spec.get_string_attribute("oiio:ColorSpace"), "sRGB");
  ASSERT_EQ(read.values.size(), kPixels.size());
  for (std::size_t i = 0; i < kPixels.size(); ++i) {
    EXPECT_EQ(std::lround(255.0f * read.values[i]), srgb_byte(kPixels[i], 1.0)) << i;
  }
}

/// The decoding curve of IEC 61966-2-1, inverse to the one under test.
double linear_of(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

TEST(Image, SrgbByteIsTheNearest) {
  for (int byte = 0; byte < 255; ++byte) {
    // Half way between two bytes the choice changes; a millionth to either side it is clear.
    const double border = linear_of((byte + 0.5) / 255.0);
    EXPECT_EQ(srgb_byte(static_cast<float>(border * (1.0 - 1e-6)), 0.0), byte);
    EXPECT_EQ(srgb_byte(static_cast<float>(border * (1.0 + 1e-6)), 0.0), byte + 1);
  }
}

TEST(Image, SrgbByteAtTheEnds) {
  EXPECT_EQ(srgb_byte(0.0f, 0.0), 0);
  EXPECT_EQ(srgb_byte(-1.0f, 0.0), 0);
  EXPECT_EQ(srgb_byte(kNaN, 0.0), 0);
  EXPECT_EQ(srgb_byte(kInfinity, 0.0), 255);
  EXPECT_EQ(srgb_byte(-kInfinity, 0.0), 0);
  EXPECT_EQ(srgb_byte(1.0f, 0.0), 255);
  EXPECT_EQ(srgb_byte(0.5f, 1.0), 255);
  EXPECT_EQ(srgb_byte(2.0f, -1.0), 255);
  EXPECT_EQ(srgb_byte(3e38f, 100.0), 255);
  EXPECT_EQ(srgb_byte(2.0f, -3.0), srgb_byte(0.25f, 0.0));
}

TEST(Image, SameInputSameBytesLater) {
  const TemporaryFolder folder;
  const std::vector<Attribute> attributes = {{"ppm-vk:seed", 1}};
  for (const char* name : {"a.exr", "a.hdr", "a.png"})
    write(folder / name, kPicture, {}, attributes);
  // Times of day in headers count in seconds.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  for (const char* name : {"b.exr", "b.hdr", "b.png"})
    write(folder / name, kPicture, {}, attributes);
  for (const char* extension : {".exr", ".hdr", ".png"}) {
    EXPECT_EQ(file_text(folder / (std::string("a") + extension)),
              file_text(folder / (std::string("b") + extension)))
        << extension;
  }
}

TEST(Image, ExtensionsAreKnownInAnyCase) {
  for (const char* name : {"a.exr", "a.EXR", "b/c.Hdr", "a.b.png", "a.pfm"}) {
    EXPECT_TRUE(has_known_extension(name)) << name;
  }
  for (const char* name : {"a", "a.jpg", ".png", "", "exr", "a.exr/", "a.exr.gz"}) {
    EXPECT_FALSE(has_known_extension(name)) << name;
  }
}

TEST(Image, CheckingLeavesNothingBehind) {
  const TemporaryFolder folder;
  check_writable(folder / "p.exr");
  EXPECT_TRUE(folder.names().empty());
  test::write_text(folder / "old.png", "old");
  check_writable(folder / "old.png");
  EXPECT_EQ(file_text(folder / "old.png"), "old");
}

TEST(Image, WhatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  test::write_text(folder / "file", "");
  std::filesystem::create_directory(folder / "folder.exr");
  for (const std::filesystem::path& file :
       {folder / "p.jpg", folder / "absent" / "p.exr", folder / "file" / "p.exr",
        folder / "folder.exr", folder / (std::string(300, 'x') + ".exr"),
        std::filesystem::path("/proc/p.exr"), folder / "folder.exr" / ""}) {
    for (const bool whole : {false, true}) {
      try {
        whole ? write(file, kPicture, {}, {}) : check_writable(file);
        ADD_FAILURE() << file;
      } catch (const Failure& failure) {
        EXPECT_EQ(std::string(failure.what()).rfind(file.string() + ": ", 0), 0u) << failure.what();
      }
    }
  }
  EXPECT_EQ(folder.names(), (std::set<std::string>{"file", "folder.exr"}));
}

TEST(OutputFile, ReplacesThroughALink) {
  const TemporaryFolder folder;
  test::write_text(folder / "target", "old");
  std::filesystem::create_symlink("target", folder / "link");
  write_whole(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(file_text(folder / "target"), "new");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"link", "target"}));
}

TEST(OutputFile, DevicesAreLeftAlone) {
  EXPECT_THROW(write_whole("/dev/null", "x"), Failure);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, FullDiskLeavesTheOldFileAndNoOther) {
  const TemporaryFolder folder;
  test::write_text(folder / "p", "old");
  // A limit on file size stands for the full disk: write() fails half way through.
  const auto previous_action = std::signal(SIGXFSZ, SIG_IGN);
  rlimit previous_limit{};
  getrlimit(RLIMIT_FSIZE, &previous_limit);
  const rlimit limit{100000, previous_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_THROW(write_whole(folder / "p", std::string(1000000, 'x')), Failure);
  setrlimit(RLIMIT_FSIZE, &previous_limit);
  std::signal(SIGXFSZ, previous_action);
  EXPECT_EQ(file_text(folder / "p"), "old");
  EXPECT_EQ(folder.names(), std::set<std::string>{"p"});
}

}  // namespace
}  // namespace ppm::image
