// Layers, tone curves and viewers on the command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "gltf_writer.hpp"
#include "program.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Words = std::vector<std::string>;

class CliLayers : public ::testing::Test {
 protected:
  CliLayers() {
    GltfWriter writer;
    const std::size_t red = writer.material(lambert({0.75, 0.5, 0.25}));
    writer.mesh(quad({-1.0f, 0.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}), red);
    writer.point_light({0.0, 1.0, 0.0}, glm::dvec3(1.0), 10.0);
    writer.camera("above", {0.0, 2.0, 0.5}, {0.0, 0.0, 0.0}, 0.4, 2.0);
    writer.write(folder_ / "s.glb");
  }

  Result render(const Words& more) const {
    Words words = {
        "render", (folder_ / "s.glb").string(), "--width", "16", "--photons", "2000", "--passes",
        "2"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  std::string out(const char* name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
};

TEST_F(CliLayers, GoIntoExrAndBesidePfm) {
  const Result plain = render({"-o", out("plain.exr")});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  const Result result = render({"-o", out("p.exr"), "-o", out("p.pfm"), "-o", out("p.png"), "--aov",
                                "albedo,normal,radius", "--tone", "agx", "--half", "--validate"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(folder_.names(),
            (std::set<std::string>{"p.albedo.pfm", "p.exr", "p.normal.pfm", "p.pfm", "p.png",
                                   "p.radius.pfm", "plain.exr", "s.glb"}));
  const PictureFile picture = read_picture(folder_ / "p.exr");
  const PictureFile before = read_picture(folder_ / "plain.exr");
  const auto& names = picture.spec.channelnames;
  ASSERT_EQ(names.size(), 10u);
  const auto channel = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  for (const char* name : {"Albedo.R", "Albedo.G", "Albedo.B", "Ns.X", "Ns.Y", "Ns.Z", "Radius"}) {
    ASSERT_LT(channel(name), 10u) << name;
  }
  for (std::size_t pixel = 0; pixel < 16 * 8; ++pixel) {
    const float* const values = &picture.values[10 * pixel];
    EXPECT_EQ(values[channel("Albedo.R")], 0.75f);
    EXPECT_EQ(values[channel("Albedo.B")], 0.25f);
    EXPECT_EQ(values[channel("Ns.Y")], 1.0f);
    EXPECT_GT(values[channel("Radius")], 0.0f);
    for (std::size_t i = 0; i < 3; ++i) {  // layers and 16 bits leave the picture as it was
      const float radiance = before.values[3 * pixel + i];
      EXPECT_NEAR(values[i], radiance, radiance / 1024.0f);
    }
  }
}

TEST_F(CliLayers, AbsentViewerCostsAWarning) {
  const Result result = render({"-o", out("p.exr"), "--display", "tev:127.0.0.1:1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::size_t first = result.err.find("warning: --display tev:127.0.0.1:1: ");
  ASSERT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("--display", first + 12), std::string::npos) << result.err;
  EXPECT_EQ(read_picture(folder_ / "p.exr").spec.width, 16);
}

}  // namespace
}  // namespace ppm::test
