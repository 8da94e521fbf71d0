// Files that are no scenes, places that take no pictures: one line each, the right exit code,
// nothing left behind.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "gltf_writer.hpp"
#include "lit_floor.hpp"
#include "program.hpp"
#include "small_disk.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Names = std::set<std::string>;
using Words = std::vector<std::string>;

constexpr double kMostSeconds = 10.0;

class CliFiles : public ::testing::Test {
 protected:
  CliFiles() { lit_floor().write(folder_ / "sound.glb"); }

  std::string path(std::string_view name) const { return (folder_ / name).string(); }

  Words render(const Words& more) const {
    Words words{"render", "--width", "64", "--photons", "1000", "--passes", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Rendering `scene` must end soon with this exit code and one line that has these words, and
  /// write nothing.
  void expect_refused(
      const std::string& scene, int exit_code, const std::string& words,
      const std::function<void()>& in_child = [] {}) {
    SCOPED_TRACE(scene);
    const Names before = folder_.names();
    const auto start = std::chrono::steady_clock::now();
    const Result result = Program(render({scene, "-o", path("o.exr")}), in_child).finish();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    EXPECT_LT(spent.count(), kMostSeconds);
    EXPECT_EQ(result.exit_code, exit_code) << result.err << "signal " << result.signal;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("ppm-vk: error: ")) << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(folder_.names(), before);
  }

  TemporaryFolder folder_;
};

/// A file that claims `size` bytes of disk without having them, with `head` at its start.
void write_sparse(const std::filesystem::path& file, std::string_view head, std::uint64_t size) {
  write_text(file, head);
  std::filesystem::resize_file(file, size);
}

TEST_F(CliFiles, WhatIsNoFileIsNoScene) {
  std::filesystem::create_directory(folder_ / "folder.gltf");
  ASSERT_EQ(mkfifo(path("pipe.gltf").c_str(), 0600), 0);
  std::filesystem::create_symlink("nowhere.glb", folder_ / "dangling.glb");
  std::filesystem::create_symlink("circle.glb", folder_ / "circle.glb");
  expect_refused(path("folder.gltf"), 1, "folder.gltf: is a folder");
  expect_refused(path("pipe.gltf"), 1, "pipe.gltf: is not a regular file");
  expect_refused("/dev/zero", 1, "/dev/zero: is not a regular file");
  expect_refused("/dev/null", 1, "/dev/null: is not a regular file");
  expect_refused(path("dangling.glb"), 1, "dangling.glb: there is no such file");
  expect_refused(path("circle.glb"), 1, "circle.glb: cannot be read: ");
  expect_refused(path("sound.glb/inside.glb"), 1, "inside.glb: there is no such file");
  expect_refused(std::string(5000, 'x') + ".glb", 1, "cannot be read: ");
  expect_refused("", 2, "no scene file is given");
}

TEST_F(CliFiles, ScenesWithoutLight) {
  GltfWriter writer;
  writer.mesh(quad({-1.0f, 0.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}),
              writer.material(lambert(glm::dvec3(0.5))));
  writer.camera("above", {0.0, 2.0, 0.5}, {0.0, 0.0, 0.0}, 0.8, 2.0);
  writer.write(folder_ / "dark.glb");
  expect_refused(path("dark.glb"), 1, "give --env");
}

TEST_F(CliFiles, UnreadableScene) {
  ASSERT_EQ(chmod(path("sound.glb").c_str(), 0), 0);
  const auto drop_rights = [] {  // that root has and others never had
    prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE);
    prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH);
  };
  expect_refused(path("sound.glb"), 1, "sound.glb: cannot be opened for reading", drop_rights);
  std::filesystem::create_directory(folder_ / "closed");
  write_text(folder_ / "closed/s.glb", "");
  ASSERT_EQ(chmod(path("closed").c_str(), 0), 0);
  expect_refused(path("closed/s.glb"), 1, "closed/s.glb: cannot be read: ", drop_rights);
  chmod(path("closed").c_str(), 0700);
}

TEST_F(CliFiles, EmptyAndHugeScenes) {
  write_text(folder_ / "empty.glb", "");
  const std::uint64_t five_gigabytes = 5000000000;
  write_sparse(folder_ / "zeros.gltf", "", five_gigabytes);
  write_sparse(folder_ / "zeros-below-the-limit.gltf", "", 4000000000);
  write_sparse(folder_ / "text.gltf", "{", 4000000000);
  write_sparse(folder_ / "container.glb", std::string("glTF\2\0\0\0\0\0\0\x80\0\0\0\x70JSON", 20),
               five_gigabytes);
  // A container of 20 bytes may be followed by anything; what it says itself counts.
  write_sparse(folder_ / "short.glb", std::string("glTF\2\0\0\0\x14\0\0\0\0\0\0\0JSON", 20),
               100000);
  expect_refused(path("empty.glb"), 1, "is neither a .gltf (JSON) nor a .glb file");
  expect_refused(path("zeros.gltf"), 1, "is too large");
  expect_refused(path("zeros-below-the-limit.gltf"), 1, "is neither a .gltf (JSON) nor a .glb");
  expect_refused(path("text.gltf"), 1, "its JSON is larger than 1 GiB");
  expect_refused(path("container.glb"), 1, "is too large");
  expect_refused(path("short.glb"), 1, "the JSON of the .glb is no object");
}

TEST_F(CliFiles, ScenesWithDashes) {
  std::filesystem::copy_file(folder_ / "sound.glb", folder_ / "-sound.glb");
  const auto in_folder = [&] { (void)!chdir(folder_.path().c_str()); };
  expect_refused("-", 1, "-: there is no such file", in_folder);
  expect_refused("-sound.glb", 2, "-sound.glb", in_folder);
  const Result result =
      Program(render({"-o", path("o.hdr"), "--quiet", "./-sound.glb"}), in_folder).finish();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(folder_.names().contains("o.hdr"));
}

TEST_F(CliFiles, FullDiskTakesNoPartOfAPicture) {
  const SmallDisk disk(folder_ / "disk", "4k");
  if (!disk.is_there()) GTEST_SKIP() << "nothing can be mounted here";
  write_text(disk.path() / "o.hdr", "old");
  for (const char* name : {"o.hdr", "new.hdr"}) {
    const std::string file = disk.path() / name;
    const Result result = run(render({path("sound.glb"), "-o", file, "--quiet"}));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(result.err.starts_with("ppm-vk: error: " + file)) << result.err;
    EXPECT_NE(result.err.find("free some space"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
  EXPECT_EQ(file_text(disk.path() / "o.hdr"), "old");
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(disk.path())) {
    ++files;
  }
  EXPECT_EQ(files, 1);
}

}  // namespace
}  // namespace ppm::test
