// ppm-vk as its users meet it: exit codes, lines on stderr, files left and not left behind.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "gltf_writer.hpp"
#include "lit_floor.hpp"
#include "program.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Names = std::set<std::string>;
using Words = std::vector<std::string>;

/// Passes that would take weeks: what ends before them did not wait for the rendering.
constexpr std::uint64_t kEndless = 4000000000;

class Cli : public ::testing::Test {
 protected:
  Cli() { lit_floor().write(scene_.path() / "s.glb"); }

  std::string scene() const { return (scene_.path() / "s.glb").string(); }
  std::string out(std::string_view name) const { return (folder_.path() / name).string(); }

  /// A quick rendering: few photons, few pixels.
  Words small(const Words& more, const std::string& scene_file, std::uint64_t passes = 2) const {
    Words words = {"render",    scene_file, "--width",  "16",
                   "--photons", "2000",     "--passes", std::to_string(passes)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Words small(const Words& more, std::uint64_t passes = 2) const {
    return small(more, scene(), passes);
  }

  TemporaryFolder scene_, folder_;
};

/// One line for the error and none for anything but warnings; nothing on stdout.
void expect_one_line(const Result& result, int exit_code, const std::string& named) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err << "signal " << result.signal;
  EXPECT_EQ(result.out, "");
  int errors = 0;
  std::size_t start = 0;
  while (start < result.err.size()) {
    const std::size_t end = std::min(result.err.find('\n', start), result.err.size());
    const std::string line = result.err.substr(start, end - start);
    start = end + 1;
    if (line.rfind("ppm-vk: warning: ", 0) == 0) continue;
    ++errors;
    EXPECT_EQ(line.rfind("ppm-vk: error: ", 0), 0u) << line;
    EXPECT_NE(line.find(named), std::string::npos) << line;
  }
  EXPECT_EQ(errors, 1) << result.err;
}

// ---- Usage

TEST_F(Cli, WrongUsageIsOneLineAndExitCodeTwo) {
  const std::string picture = out("o.exr");
  const std::vector<std::pair<Words, std::string>> cases = {
      {{}, "verb"},
      {{"paint"}, "paint"},
      {{"--bogus"}, "--bogus"},
      {{"help", "paint"}, "paint"},
      {{"devices", "--all"}, "--all"},
      {{"render"}, "SCENE"},
      {{"render", scene()}, "-o"},
      {{"render", scene(), "-o", out("o.jpg")}, "o.jpg"},
      {{"render", scene(), "-o", picture, "--bogus"}, "--bogus"},
      {{"render", scene(), "-o", picture, "--width"}, "--width"},
      {{"render", scene(), "-o", picture, "--width", "0"}, "--width"},
      {{"render", scene(), "-o", picture, "--alpha", "nan"}, "--alpha"},
      {{"render", scene(), "-o", picture, "--integrator", "magic"}, "magic"},
      {{"render", scene(), "-o", picture, "--stats", picture}, "--stats"},
      {{"render", scene(), "-o", picture, "--env", "sky.png"}, "sky.png"},
      {{"render", scene(), "-o", picture, "--env-strength", "2"}, "needs --env"},
      {{"render", scene(), "-o", picture, "--env", "sky.exr", "--env-strength", "-1"},
       "--env-strength"},
      {{"render", scene(), "-o", picture, "--luminous-efficacy", "0"}, "--luminous-efficacy"},
  };
  for (const auto& [words, named] : cases) {
    SCOPED_TRACE(testing::PrintToString(words));
    const Result result = run(words);
    expect_one_line(result, 2, named);
    EXPECT_NE(result.err.find("see ppm-vk help"), std::string::npos) << result.err;
  }
  EXPECT_EQ(folder_.names(), Names{});
}

TEST_F(Cli, HelpAndVersion) {
  for (const Words& words : std::vector<Words>{
           {"help"}, {"help", "render"}, {"help", "devices"}, {"render", "--help"}, {"--help"}}) {
    const Result result = run(words);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.out.find("ppm-vk"), std::string::npos);
    EXPECT_EQ(result.err, "");
  }
  const Result version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out, "ppm-vk " PPM_VK_VERSION "\n");
}

TEST_F(Cli, DevicesAreListedWithTheirFitness) {
  const Result result = run({"devices"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.rfind("0: ", 0), 0u) << result.out;
  EXPECT_NE(result.out.find("can serve"), std::string::npos) << result.out;
}

TEST_F(Cli, FullStandardOutputIsAnError) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  if (full < 0) GTEST_SKIP() << "no /dev/full here";
  for (const Words& words : std::vector<Words>{{"help"}, {"--version"}, {"devices"}}) {
    expect_one_line(Program(words, [full] { dup2(full, STDOUT_FILENO); }).finish(), 1,
                    "standard output");
  }
  close(full);
}

TEST_F(Cli, WithoutAnyVulkanDriver) {
  const auto hide_drivers = [] {
    setenv("VK_ICD_FILENAMES", "/nonexistent.json", 1);
    setenv("VK_DRIVER_FILES", "/nonexistent.json", 1);
  };
  expect_one_line(Program({"devices"}, hide_drivers).finish(), 1, "");
  expect_one_line(Program(small({"-o", out("o.exr")}), hide_drivers).finish(), 1, "");
  EXPECT_EQ(folder_.names(), Names{});
}

TEST_F(Cli, UnknownDeviceAndCamera) {
  expect_one_line(run(small({"-o", out("o.exr"), "--device", "abacus"})), 1, "abacus");
  expect_one_line(run(small({"-o", out("o.exr"), "--device", "99"})), 1, "99");
  expect_one_line(run(small({"-o", out("o.exr"), "--camera", "below"})), 1, "below");
  EXPECT_EQ(folder_.names(), Names{});
}

TEST_F(Cli, RadiusOutOfProportion) {
  expect_one_line(run(small({"-o", out("o.exr"), "--radius", "1e-30"})), 1, "--radius");
  expect_one_line(run(small({"-o", out("o.exr"), "--radius", "1e30"})), 1, "--radius");
  EXPECT_EQ(folder_.names(), Names{});
}

// ---- Scene files

TEST_F(Cli, MissingAndBrokenScenes) {
  const std::string whole = file_text(scene());
  const TemporaryFolder broken;
  write_text(broken / "empty.glb", "");
  write_text(broken / "garbage.glb", std::string(1000, '\x5a'));
  write_text(broken / "head.glb", whole.substr(0, 10));
  write_text(broken / "half.glb", whole.substr(0, whole.size() / 2));
  write_text(broken / "short.glb", whole.substr(0, whole.size() - 4));
  write_text(broken / "garbage.gltf", "{ \"asset\": ");
  write_text(broken / "bare.gltf", R"({"asset": {"version": "2.0"}})");
  write_text(broken / "scene.obj", "v 0 0 0\n");
  std::filesystem::create_directory(broken / "folder.glb");
  write_text(broken / "line\nbreak.glb", "");
  for (const std::string& name : broken.names()) {
    SCOPED_TRACE(name);
    std::string shown = name;
    std::replace(shown.begin(), shown.end(), '\n', ' ');
    expect_one_line(run(small({"-o", out("o.exr")}, (broken / name).string())), 1, shown);
  }
  expect_one_line(run(small({"-o", out("o.exr")}, out("absent.glb"))), 1, "absent.glb");
  EXPECT_EQ(folder_.names(), Names{});
}

TEST_F(Cli, SceneWithoutTriangles) {
  GltfWriter writer;
  writer.point_light({0.0, 1.0, 0.0}, glm::dvec3(1.0), 10.0);
  const TemporaryFolder other;
  writer.write(other / "dark.glb");
  expect_one_line(run(small({"-o", out("o.exr")}, (other / "dark.glb").string())), 1, "dark.glb");
  EXPECT_EQ(folder_.names(), Names{});
}

// ---- Where the results go

// What gives off no light is refused with a line that says what would; an environment does.
TEST_F(Cli, DarkScenesNeedAnEnvironment) {
  GltfWriter writer;
  writer.mesh(quad({-1.0f, 0.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}),
              writer.material(lambert(glm::dvec3(0.5))));
  writer.camera("above", {0.0, 2.0, 0.5}, {0.0, 0.0, 0.0}, 0.8, 2.0);
  writer.write(scene_.path() / "dark.glb");
  const std::string dark = (scene_.path() / "dark.glb").string();
  expect_one_line(run(small({"-o", out("o.exr")}, dark)), 1, "--env");
  const std::string sky = (scene_.path() / "sky.exr").string();
  const std::vector<float> texels(3 * 8 * 4, 0.25f);
  const auto file = OIIO::ImageOutput::create(sky);
  ASSERT_TRUE(file && file->open(sky, OIIO::ImageSpec(8, 4, 3, OIIO::TypeDesc::FLOAT)));
  ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, texels.data()) && file->close());
  const Words lit = {"-o", out("o.exr"),     "--env", sky, "--env-strength",
                     "2",  "--env-rotation", "90"};
  const Result result = run(small(lit, dark, 16));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const PictureFile picture = read_picture(out("o.exr"));
  double mean = 0.0;
  for (const float value : picture.values)
    mean += value / static_cast<double>(picture.values.size());
  EXPECT_GT(mean, 0.2);  // half of it is sky, 0.5, the rest the plate, half as bright
  EXPECT_LT(mean, 0.5);
  EXPECT_EQ(picture.spec.get_string_attribute("ppm-vk:environment"), "sky.exr");
  // A map without any light is no help, and one that is missing is named.
  expect_one_line(run(small({"-o", out("p.exr"), "--env", sky, "--env-strength", "0"}, dark)), 1,
                  "--env");
  expect_one_line(run(small({"-o", out("p.exr"), "--env", out("none.hdr")}, dark)), 1, "none.hdr");
  EXPECT_EQ(folder_.names(), Names{"o.exr"});
}

TEST_F(Cli, UnwritableOutputsAreRefusedBeforeRendering) {
  write_text(folder_ / "file", "");
  std::filesystem::create_directory(folder_ / "folder.exr");
  const Names before = folder_.names();
  for (const std::string& name :
       {out("absent/o.exr"), out("file/o.exr"), out("folder.exr"), std::string("/proc/o.exr"),
        out(std::string(300, 'x') + ".exr")}) {
    expect_one_line(run(small({"-o", name}, kEndless)), 1, name);
    expect_one_line(run(small({"-o", out("good.exr"), "-o", name}, kEndless)), 1, name);
    expect_one_line(run(small({"-o", out("good.exr"), "--stats", name}, kEndless)), 1, name);
  }
  expect_one_line(run(small({"-o", out("good.exr"), "--stats", "/dev/null"}, kEndless)), 1,
                  "/dev/null");
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(Cli, ReadOnlyFolder) {
  ASSERT_EQ(chmod(folder_.path().c_str(), 0555), 0);
  // Without this right permissions bind root, too. Whoever lacks it already cannot give it up.
  const auto drop_rights = [] { prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE); };
  const Result result = Program(small({"-o", out("o.exr")}, kEndless), drop_rights).finish();
  chmod(folder_.path().c_str(), 0755);
  expect_one_line(result, 1, "o.exr");
  EXPECT_EQ(folder_.names(), Names{});
}

TEST_F(Cli, FullDiskKeepsTheOldPicture) {
  write_text(folder_ / "o.hdr", "old");
  const auto limit_files = [] {
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    // Drivers that cache shaders on the disk meet the same limit.
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  };
  Words words = small({"-o", out("o.hdr"), "--quiet"});
  *std::find(words.begin(), words.end(), "16") = "64";
  expect_one_line(Program(words, limit_files).finish(), 1, "o.hdr");
  EXPECT_EQ(file_text(folder_ / "o.hdr"), "old");
  EXPECT_EQ(folder_.names(), Names{"o.hdr"});
}

// ---- Rendering

TEST_F(Cli, SeveralOutputsAtOnce) {
  write_text(folder_ / "o.exr", "an older picture");
  const Result result = run(small({"-o", out("o.exr"), "-o", out("o.PNG"), "-o", out("o.hdr"),
                                   "--stats", out("s.json"), "--seed", "5", "--validate"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(folder_.names(), (Names{"o.PNG", "o.exr", "o.hdr", "s.json"}));
  for (const char* name : {"o.exr", "o.PNG", "o.hdr"}) {
    const PictureFile picture = read_picture(folder_ / name);
    EXPECT_EQ(picture.spec.width, 16);
    EXPECT_EQ(picture.spec.height, 8);  // from the camera's aspect
    EXPECT_GT(*std::max_element(picture.values.begin(), picture.values.end()), 0.0f) << name;
  }
  const OIIO::ImageSpec spec = read_picture(folder_ / "o.exr").spec;
  EXPECT_EQ(spec.get_string_attribute("ppm-vk:camera"), "above");
  EXPECT_EQ(spec.get_string_attribute("ppm-vk:scene"), "s.glb");
  EXPECT_EQ(spec.get_string_attribute("ppm-vk:program"), "ppm-vk " PPM_VK_VERSION);
  const nlohmann::json statistics = nlohmann::json::parse(file_text(folder_ / "s.json"));
  EXPECT_EQ(statistics["passes"], 2);
  EXPECT_EQ(statistics["photons_emitted"], 4000);
  EXPECT_EQ(statistics["seed"], 5);
  EXPECT_EQ(statistics["triangles"], 2);
  EXPECT_EQ(statistics["lights"], 1);
  EXPECT_EQ(statistics["pass_seconds"].size(), 2u);
  EXPECT_GT(statistics["hit_points"], 0);
  EXPECT_GT(statistics["photons_stored"], 0);
  EXPECT_GT(statistics["device_memory_bytes"], 0);
  EXPECT_GT(statistics["initial_radius"]["min"], 0.0);
}

TEST_F(Cli, SameCommandSameBytes) {
  for (const char* name : {"a.exr", "b.exr"}) {
    EXPECT_EQ(run(small({"-o", out(name), "--quiet"})).exit_code, 0);
  }
  EXPECT_EQ(file_text(folder_ / "a.exr"), file_text(folder_ / "b.exr"));
}

TEST_F(Cli, SeedChangesThePicture) {
  EXPECT_EQ(run(small({"-o", out("a.hdr"), "--quiet", "--seed", "1"})).exit_code, 0);
  EXPECT_EQ(run(small({"-o", out("b.hdr"), "--quiet", "--seed", "2"})).exit_code, 0);
  EXPECT_NE(file_text(folder_ / "a.hdr"), file_text(folder_ / "b.hdr"));
}

TEST_F(Cli, QuietSaysNothing) {
  const Result result = run(small({"-o", out("o.exr"), "--quiet"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Cli, FileWithoutCameraIsFramedWithAWarning) {
  GltfWriter writer = lit_floor();
  writer.document().erase("cameras");
  for (auto& node : writer.document()["nodes"]) node.erase("camera");
  const TemporaryFolder other;
  writer.write(other / "blind.glb");
  const Result result = run(small({"-o", out("o.hdr")}, (other / "blind.glb").string()));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("ppm-vk: warning: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("camera"), std::string::npos) << result.err;
  const PictureFile picture = read_picture(folder_ / "o.hdr");
  EXPECT_EQ(picture.spec.height, 12);  // 4:3
  EXPECT_GT(*std::max_element(picture.values.begin(), picture.values.end()), 0.0f);
}

TEST_F(Cli, ProgressOnATerminalRewritesOneLine) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) {
    GTEST_SKIP() << "no pseudo-terminals here";
  }
  const std::string name = ptsname(terminal);
  const auto use_terminal = [&] { dup2(open(name.c_str(), O_WRONLY | O_NOCTTY), STDERR_FILENO); };
  const Result result = Program(small({"-o", out("o.exr")}), use_terminal).finish();
  std::string text(4096, '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(terminal, text.data(), 4096))));
  close(terminal);
  EXPECT_EQ(result.exit_code, 0) << text;
  EXPECT_NE(text.find("\rppm-vk: pass 2 of 2, "), std::string::npos) << text;
  EXPECT_NE(text.find(" photons/s, "), std::string::npos) << text;
  // The terminal turns the one line feed at the end into "\r\n".
  EXPECT_EQ(text.find('\n'), text.size() - 1) << text;
}

// ---- Signals

TEST_F(Cli, InterruptionWritesThePictureSoFar) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program(
        small({"-o", out("o.exr"), "-o", out("o.png"), "--stats", out("s.json")}, kEndless));
    ASSERT_TRUE(program.wait_for("pass 2 of "));
    program.send(signal);
    const Result result = program.finish();
    EXPECT_EQ(result.exit_code, 130) << result.signal << result.err;
    EXPECT_EQ(folder_.names(), (Names{"o.exr", "o.png", "s.json"}));
    const PictureFile picture = read_picture(folder_ / "o.exr");
    EXPECT_GT(*std::max_element(picture.values.begin(), picture.values.end()), 0.0f);
    const nlohmann::json statistics = nlohmann::json::parse(file_text(folder_ / "s.json"));
    const std::uint64_t passes = statistics["passes"];
    EXPECT_GE(passes, 2u);
    EXPECT_EQ(statistics["photons_emitted"], 2000 * passes);
    std::filesystem::remove(folder_ / "o.exr");
  }
}

TEST_F(Cli, InterruptedRenderingEqualsAShorterOne) {
  Program program(small({"-o", out("a.hdr"), "--stats", out("s.json")}, kEndless));
  ASSERT_TRUE(program.wait_for("pass 2 of "));
  program.send(SIGINT);
  EXPECT_EQ(program.finish().exit_code, 130);
  const std::uint64_t passes = nlohmann::json::parse(file_text(folder_ / "s.json"))["passes"];
  EXPECT_EQ(run(small({"-o", out("b.hdr")}, passes)).exit_code, 0);
  EXPECT_EQ(file_text(folder_ / "a.hdr"), file_text(folder_ / "b.hdr"));
}

}  // namespace
}  // namespace ppm::test
