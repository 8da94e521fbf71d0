// Checkpoints as files: nothing is lost, and what cannot go on is told why.
#include "checkpoint.hpp"

#include <gtest/gtest.h>

#include <array>

#include "failure.hpp"
#include "resumed_statistics.hpp"
#include "sealed_file.hpp"
#include "temporary_folder.hpp"

namespace ppm::render {
namespace {

Checkpoint full_checkpoint() {
  Checkpoint checkpoint;
  checkpoint.program = "ppm-vk 9";
  checkpoint.device = "a device";
  checkpoint.driver = "a driver";
  checkpoint.scene = "/some/s.glb";
  checkpoint.integrator = "ppm";
  checkpoint.width = 32768;
  checkpoint.height = 1;
  checkpoint.words = {"/some/\xff\n.glb", "--output=/x=y.exr", "--verbose", ""};
  checkpoint.parts = {{"triangles", ~0ull}, {"camera", 0}};
  checkpoint.seconds = 1e5 + 1.0 / 3.0;
  Statistics& statistics = checkpoint.statistics;
  std::uint64_t number = (1ull << 53) + 1;  // more than a double can tell
  for (std::uint64_t Statistics::*member :
       {&Statistics::triangles, &Statistics::lights, &Statistics::hit_points, &Statistics::tiles,
        &Statistics::passes, &Statistics::photons_emitted, &Statistics::photons_stored,
        &Statistics::samples, &Statistics::mutations, &Statistics::eye_rays,
        &Statistics::photon_rays, &Statistics::map_photons, &Statistics::paths_cut}) {
    statistics.*member = number++;
  }
  double length = 0.1;
  for (double Statistics::*member :
       {&Statistics::initial_radius_min, &Statistics::initial_radius_median,
        &Statistics::initial_radius_max, &Statistics::nearest_radius_min,
        &Statistics::nearest_radius_median, &Statistics::nearest_radius_max}) {
    statistics.*member = length *= 1.1;
  }
  statistics.rejected = {{"clamped", 3}};
  statistics.seconds = {{"eye", 0.7}};
  statistics.kernel_seconds = {{"gather", 0.3}};
  statistics.pass_seconds = {0.1, 0.2, 1e-300};
  checkpoint.state = {0, 255, 7};
  return checkpoint;
}

/// What there is to say of a checkpoint, in one line.
template <class Deed>
std::string failure_of(const Deed& deed) {
  try {
    deed();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

TEST(Checkpoint, IsReadAsItWasWritten) {
  const test::TemporaryFolder folder;
  const Checkpoint written = full_checkpoint();
  write_checkpoint(folder / "c", written);
  const Checkpoint read = read_checkpoint(folder / "c");
  EXPECT_EQ(read.program, written.program);
  EXPECT_EQ(read.device, written.device);
  EXPECT_EQ(read.driver, written.driver);
  EXPECT_EQ(read.scene, written.scene);
  EXPECT_EQ(read.integrator, written.integrator);
  EXPECT_EQ(read.width, written.width);
  EXPECT_EQ(read.height, written.height);
  EXPECT_EQ(read.words, written.words);
  EXPECT_EQ(read.parts, written.parts);
  EXPECT_EQ(read.seconds, written.seconds);
  EXPECT_EQ(read.state, written.state);
  const Statistics &a = read.statistics, &b = written.statistics;
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.lights, b.lights);
  EXPECT_EQ(a.hit_points, b.hit_points);
  EXPECT_EQ(a.tiles, b.tiles);
  EXPECT_EQ(a.passes, b.passes);
  EXPECT_EQ(a.photons_emitted, b.photons_emitted);
  EXPECT_EQ(a.photons_stored, b.photons_stored);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.mutations, b.mutations);
  EXPECT_EQ(a.eye_rays, b.eye_rays);
  EXPECT_EQ(a.photon_rays, b.photon_rays);
  EXPECT_EQ(a.map_photons, b.map_photons);
  EXPECT_EQ(a.paths_cut, b.paths_cut);
  EXPECT_EQ(a.initial_radius_min, b.initial_radius_min);
  EXPECT_EQ(a.initial_radius_median, b.initial_radius_median);
  EXPECT_EQ(a.initial_radius_max, b.initial_radius_max);
  EXPECT_EQ(a.nearest_radius_min, b.nearest_radius_min);
  EXPECT_EQ(a.nearest_radius_median, b.nearest_radius_median);
  EXPECT_EQ(a.nearest_radius_max, b.nearest_radius_max);
  EXPECT_EQ(a.rejected, b.rejected);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.kernel_seconds, b.kernel_seconds);
  EXPECT_EQ(a.pass_seconds, b.pass_seconds);
}

// Sound by its checksum and still none: somebody made it.
TEST(Checkpoint, NonsenseUnderARightChecksumIsRefused) {
  const test::TemporaryFolder folder;
  constexpr SealedKind kKind{"checkpoint of ppm-vk",
                             {'p', 'p', 'm', '-', 'v', 'k', ' ',  'c',  'h',    'e', 'c',
                              'k', 'p', 'o', 'i', 'n', 't', '\r', '\n', '\x1a', '\n'},
                             1,
                             4};
  for (const std::string_view facts : {"", "{", "[]", "{}", "null", R"({"program":1})", "\xff\xfe",
                                       R"({"program":"a","device":[]})"}) {
    write_sealed(folder / "c", kKind, std::array<std::string_view, 4>{facts, "", "", ""});
    EXPECT_NE(failure_of([&] { read_checkpoint(folder / "c"); }).find("makes no sense"),
              std::string::npos)
        << facts;
  }
}

TEST(Checkpoint, ChangesAreNamed) {
  const Checkpoint checkpoint = full_checkpoint();
  const auto changed = [&](const std::string& program, const std::vector<PartHash>& parts) {
    return failure_of([&] { check_continues("c.ckpt", checkpoint, program, parts); });
  };
  EXPECT_EQ(changed("ppm-vk 9", checkpoint.parts), "");
  EXPECT_NE(changed("ppm-vk 10", checkpoint.parts).find("written by ppm-vk 9, this is ppm-vk 10"),
            std::string::npos);
  const std::string one = changed("ppm-vk 9", {{"triangles", 1}, {"camera", 0}});
  EXPECT_NE(one.find("c.ckpt: the scene /some/s.glb has changed since: triangles:"),
            std::string::npos)
      << one;
  const std::string both = changed("ppm-vk 9", {{"triangles", 1}, {"camera", 2}});
  EXPECT_NE(both.find("since: triangles, camera:"), std::string::npos) << both;
  EXPECT_NE(changed("ppm-vk 9", {{"camera", 0}}), "");

  const auto moved = [&](const char* device, const char* driver) {
    return failure_of([&] { check_device("c.ckpt", checkpoint, device, driver); });
  };
  EXPECT_EQ(moved("a device", "a driver"), "");
  EXPECT_NE(moved("another", "a driver").find("this is another"), std::string::npos);
  EXPECT_NE(moved("a device", "newer").find("newer"), std::string::npos);
}

// Three passes before, two now; the eye paths were traced again and counted again.
TEST(Checkpoint, StatisticsAreThoseOfOneGo) {
  Statistics before, restored, now;
  before.passes = 3;
  before.paths_cut = 10 + 5;  // eye paths, photons
  before.eye_rays = 100;
  before.rejected = {{"clamped", 2}, {"non_finite", 1}};
  before.initial_radius_median = 0.5;
  before.seconds = {{"eye", 1.0}, {"pilot", 2.0}};
  before.pass_seconds = {1.0, 2.0, 3.0};
  restored.passes = 3;
  restored.paths_cut = 10;
  restored.eye_rays = 100;
  restored.rejected = {{"non_finite", 1}};
  now = restored;
  now.passes = 5;
  now.paths_cut = 10 + 4;
  now.eye_rays = 100;
  now.rejected = {{"non_finite", 1}, {"overflow", 7}};
  now.seconds = {{"eye", 1.5}};
  now.pass_seconds = {4.0, 5.0};
  const Statistics joined = ResumedStatistics(before, restored).joined(now);
  EXPECT_EQ(joined.passes, 5u);
  EXPECT_EQ(joined.paths_cut, 10u + 5u + 4u);
  EXPECT_EQ(joined.eye_rays, 100u);
  EXPECT_EQ(joined.rejected, (std::map<std::string, std::uint64_t>{
                                 {"clamped", 2}, {"non_finite", 1}, {"overflow", 7}}));
  EXPECT_EQ(joined.initial_radius_median, 0.5);
  EXPECT_EQ(joined.seconds, (std::map<std::string, double>{{"eye", 2.5}, {"pilot", 2.0}}));
  EXPECT_EQ(joined.pass_seconds, (std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0}));
}

}  // namespace
}  // namespace ppm::render
