// Environment maps as files have them, whole and broken.
#include "load_environment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "failure.hpp"
#include "image.hpp"
#include "load_gltf.hpp"
#include "temporary_folder.hpp"

namespace ppm::scene {
namespace {

using test::TemporaryFolder;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<float> ramp(std::uint32_t width, std::uint32_t height) {
  std::vector<float> values;
  for (std::uint32_t i = 0; i < 3 * width * height; ++i) {
    values.push_back(0.25f + 0.5f * static_cast<float>(i));
  }
  return values;
}

std::string refusal(const std::filesystem::path& file) {
  Log log(Verbosity::quiet);
  try {
    load_environment(file, log);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(LoadEnvironment, ReadsExrAndHdr) {
  const TemporaryFolder folder;
  const std::vector<float> values = ramp(8, 4);
  for (const char* name : {"sky.exr", "sky.HDR"}) {
    image::write(folder / name, {8, 4, values}, {}, {});
    Log log(Verbosity::quiet);
    const Environment environment = load_environment(folder / name, log);
    EXPECT_EQ(environment.width, 8u);
    EXPECT_EQ(environment.height, 4u);
    EXPECT_EQ(environment.strength, 1.0f);
    ASSERT_EQ(environment.texels.size(), 32u);
    for (std::size_t i = 0; i < 32; ++i) {
      for (int c = 0; c < 3; ++c) {
        const float expected = values[3 * i + static_cast<std::size_t>(c)];
        // RGBE keeps eight bits of the largest channel.
        const float slack = name[4] == 'e' ? 0.0f : (values[3 * i + 2]) / 128.0f;
        EXPECT_NEAR(environment.texels[i][c], expected, slack) << name << i;
      }
    }
    EXPECT_TRUE(log.warnings().empty());
  }
}

TEST(LoadEnvironment, ClampsWhatIsNoRadiance) {
  const TemporaryFolder folder;
  std::vector<float> values = ramp(4, 2);
  values[0] = -1.0f;
  values[4] = kNaN;
  values[5] = -kInfinity;
  values[8] = kInfinity;
  values[23] = 1e30f;
  image::write(folder / "sky.exr", {4, 2, values}, {}, {});
  Log log(Verbosity::quiet);
  const Environment environment = load_environment(folder / "sky.exr", log);
  EXPECT_EQ(environment.texels[0].x, 0.0f);
  EXPECT_EQ(environment.texels[1].y, 0.0f);
  EXPECT_EQ(environment.texels[1].z, 0.0f);
  EXPECT_EQ(environment.texels[2].z, 65504.0f);
  EXPECT_EQ(environment.texels[7].z, 1e15f);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_NE(log.warnings()[0].find("4 texels"), std::string::npos) << log.warnings()[0];
}

TEST(LoadEnvironment, RefusesInOneLineThatNamesTheFile) {
  const TemporaryFolder folder;
  image::write(folder / "square.exr", {4, 4, ramp(4, 4)}, {}, {});
  image::write(folder / "good.exr", {8, 4, ramp(8, 4)}, {}, {});
  image::write(folder / "good.hdr", {64, 32, ramp(64, 32)}, {}, {});
  const std::string exr = bytes_of(folder / "good.exr"), hdr = bytes_of(folder / "good.hdr");
  write_bytes(folder / "empty.hdr", "");
  write_bytes(folder / "text.exr", "no picture at all");
  write_bytes(folder / "cut.exr", exr.substr(0, exr.size() - 30));
  write_bytes(folder / "cut.hdr", hdr.substr(0, hdr.size() / 2));
  // Claims far more than it holds, and far more than is taken.
  write_bytes(folder / "lies.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2048 +X 4096\nabc");
  write_bytes(folder / "huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 500000 +X 1000000\n");
  std::filesystem::create_directory(folder / "folder.exr");
  const std::vector<std::pair<const char*, const char*>> cases{
      {"missing.exr", "no such file"}, {"folder.exr", "not a regular file"},
      {"square.exr", "twice as wide"}, {"empty.hdr", "cannot be read"},
      {"text.exr", "cannot be read"},  {"cut.exr", "cannot be read"},
      {"cut.hdr", "cannot be read"},   {"lies.hdr", "cannot hold"},
      {"huge.hdr", "too many"}};
  for (const auto& [name, why] : cases) {
    const std::string line = refusal(folder / name);
    EXPECT_NE(line.find(name), std::string::npos) << line;
    EXPECT_NE(line.find(why), std::string::npos) << name << ": " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace ppm::scene
