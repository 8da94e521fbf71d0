// `ppm-vk view` on a screen in memory, as somebody before it would use it.
#include <gtest/gtest.h>

#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <sstream>

#include "gltf_writer.hpp"
#include "integrator.hpp"
#include "layer_environment.hpp"
#include "program.hpp"
#include "read_picture.hpp"
#include "screen.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Words = std::vector<std::string>;

constexpr unsigned kWidth = 160, kHeight = 120;

Words words_in(const std::string& line) {
  std::istringstream stream(line);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The numbers after `name` in a line: "L 0.5 0.25 0.1;".
std::vector<double> numbers_after(const std::string& line, const std::string& name,
                                  std::size_t count) {
  const std::size_t place = line.find(name + " ");
  if (place == std::string::npos) return {};
  std::istringstream stream(line.substr(place + name.size()));
  std::vector<double> numbers(count);
  for (double& number : numbers) stream >> number;
  return numbers;
}

/// Whether a window of the picture's size shows the bytes of this PNG.
bool shows(const Shot& shot, const PictureFile& png) {
  return shot.rgb.size() == png.values.size() &&
         std::ranges::equal(shot.rgb, png.values, [](std::uint8_t shown, float value) {
           return static_cast<float>(shown) == std::round(255.0f * value);
         });
}

class View : public ::testing::Test {
 protected:
  View() {
    GltfWriter writer;
    const std::size_t grey = writer.material(lambert({0.6, 0.5, 0.4}));
    const std::size_t blue = writer.material(lambert({0.2, 0.3, 0.8}));
    writer.mesh(quad({-2.0f, 0.0f, 2.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -4.0f}), grey);
    writer.mesh(box({-0.4f, 0.0f, -0.4f}, {0.3f, 0.7f, 0.2f}), blue);
    writer.point_light({0.5, 1.5, 0.7}, {1.0, 0.9, 0.8}, 20.0);
    writer.camera("aside", {-0.5, 1.5, 2.0}, {0.0, 0.3, 0.0}, 0.8, 4.0 / 3.0);
    writer.write(folder_ / "s.glb");
  }

  std::string path(std::string_view name) const { return (folder_ / name).string(); }

  /// What makes a small picture of the scene, whatever shows it.
  Words common(const Words& more = {}) const {
    Words words = {path("s.glb"), "--width", std::to_string(kWidth), "--spp", "1", "--seed", "7"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Program view(
      Words words, const std::function<void()>& in_child = [] {}) const {
    words.insert(words.begin(), "view");
    const std::string display = screen_.display();
    return Program(words, [&] {
      setenv("DISPLAY", display.c_str(), 1);
      in_child();
    });
  }

  /// Presses o until what is written has all three passes.
  void save(Program& program) {
    for (;;) {
      screen_.key("o");
      const auto png = program.next_line(), exr = program.next_line();
      ASSERT_TRUE(png && exr);
      ASSERT_TRUE(png->starts_with("ppm-vk: wrote " + path("a.png") + " after ")) << *png;
      ASSERT_TRUE(exr->starts_with("ppm-vk: wrote " + path("a.exr") + " after ")) << *exr;
      if (png->ends_with(" after 3 passes")) return;
      pause_a_little();
    }
  }

  /// That the files are those of `render` with these options, and that the PNG is on the screen.
  void expect_rendered(const Words& more) {
    Words words = common({"--photons", "2000", "--passes", "3", "--aov", "radius,photons", "-o",
                          path("b.png"), "-o", path("b.exr")});
    words.insert(words.begin(), "render");
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(file_text(folder_ / "a.png"), file_text(folder_ / "b.png"));
    EXPECT_EQ(file_text(folder_ / "a.exr"), file_text(folder_ / "b.exr"));
    const PictureFile png = read_picture(folder_ / "a.png");
    EXPECT_TRUE(eventually([&] { return shows(screen_.shot(), png); }));
  }

  TemporaryFolder folder_;
  Screen screen_;
};

TEST_F(View, ShowsSavesAndInspectsWhatRenderMakes) {
  Program program = view(common({"--photons", "2000", "--passes", "3", "--aov", "radius,photons",
                                 "-o", path("a.png"), "-o", path("a.exr"), "--validate"}));
  ASSERT_TRUE(screen_.find_window());
  ASSERT_TRUE(screen_.wait_for_title("s.glb: ppm, 3 of 3 passes, 6000 photons"));
  screen_.key("equal");
  screen_.key("t");
  ASSERT_TRUE(screen_.wait_for_title("exposure +0.5, reinhard"));
  save(program);
  expect_rendered({"--exposure", "0.5", "--tone", "reinhard"});

  // A pixel of the box, against the layers of the file.
  const glm::ivec2 at(80, 60);
  screen_.click(at);
  const std::string line = program.next_line().value_or("");
  ASSERT_TRUE(line.starts_with("ppm-vk: pixel 80,60: L ")) << line;
  EXPECT_TRUE(line.ends_with(", after 3 passes")) << line;
  const PictureFile exr = read_picture(folder_ / "a.exr");
  const auto value = [&](const char* channel) {
    const auto& names = exr.spec.channelnames;
    const auto index = static_cast<std::size_t>(std::ranges::find(names, channel) - names.begin());
    const auto pixel = static_cast<std::size_t>(at.y) * kWidth + static_cast<std::size_t>(at.x);
    return static_cast<double>(exr.values.at(pixel * names.size() + index));
  };
  const double radius = numbers_after(line, "R", 1).at(0);
  EXPECT_NEAR(radius, value("Radius"), 1e-3 * radius);  // four digits are printed
  const double photons = numbers_after(line, "N", 1).at(0);
  EXPECT_GT(photons, 0.0);
  EXPECT_NEAR(photons, value("Photons"), 1e-3 * photons);
  const auto shown = numbers_after(line, "L", 3), hit = numbers_after(line, "hit point L", 3);
  const auto tau = numbers_after(line, "tau", 3);
  for (const std::size_t channel : {0u, 1u, 2u}) {
    const double radiance = value(std::array{"R", "G", "B"}[channel]);
    EXPECT_NEAR(shown.at(channel), radiance, 1e-3 * radiance);
    EXPECT_NEAR(hit.at(channel), radiance, 1e-3 * radiance);  // one eye path: the only one
    const double expected = std::numbers::pi * radius * radius * 6000.0 * radiance;
    EXPECT_NEAR(tau.at(channel), expected, 4e-3 * expected);
  }
  EXPECT_TRUE(screen_.wait_for_title(" | pixel 80,60: L "));

  screen_.key("Escape");
  const Result result = program.finish();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
}

TEST_F(View, MovedCameraIsThePrintedOne) {
  Program program = view(common({"--photons", "2000", "--passes", "3", "--aov", "radius,photons",
                                 "-o", path("a.png"), "-o", path("a.exr")}));
  ASSERT_TRUE(screen_.find_window());
  ASSERT_TRUE(screen_.wait_for_title("3 of 3 passes"));
  save(program);
  const std::string first = file_text(folder_ / "a.png"), radiance = file_text(folder_ / "a.exr");
  screen_.press(6);  // tilts the wheel, which moves nothing
  screen_.release(6);
  save(program);
  EXPECT_TRUE(file_text(folder_ / "a.exr") == radiance);

  screen_.drag(1, {80, 60}, {100, 50});
  screen_.drag(3, {80, 60}, {70, 66});
  screen_.press(4);
  screen_.release(4);
  screen_.key("w");
  screen_.key("c");
  const std::string line = program.next_line().value_or("");
  ASSERT_TRUE(line.starts_with("ppm-vk: --camera-position ")) << line;
  Words options = words_in(line);
  options.erase(options.begin());
  save(program);
  EXPECT_NE(file_text(folder_ / "a.png"), first);
  expect_rendered(options);

  // While it is paused a camera's first pass is shown and no more; back there it is as it was.
  screen_.key("space");
  ASSERT_TRUE(screen_.wait_for_title(", paused"));
  screen_.key("r");
  ASSERT_TRUE(screen_.wait_for_title("1 of 3 passes, 2000 photons, paused"));
  screen_.key("space");
  ASSERT_TRUE(screen_.wait_for_title("3 of 3 passes"));
  save(program);
  expect_rendered({});
  EXPECT_EQ(file_text(folder_ / "a.png"), first);

  // Twice as large, between bars of 20 rows.
  const PictureFile png = read_picture(folder_ / "a.png");
  screen_.resize(2 * kWidth, 2 * kHeight + 40);
  EXPECT_TRUE(eventually([&] {
    const Shot shot = screen_.shot();
    if (shot.width != 2 * kWidth || shot.height != 2 * kHeight + 40) return false;
    PictureFile large;
    for (unsigned y = 0; y < shot.height; ++y) {
      for (unsigned i = 0; i < 3 * shot.width; ++i) {
        const bool is_bar = y < 20 || y >= 2 * kHeight + 20;
        const std::size_t pixel = (y - 20) / 2 * kWidth + i / 3 / 2;
        large.values.push_back(is_bar ? 32.0f / 255.0f : png.values[3 * pixel + i % 3]);
      }
    }
    return shows(shot, large);
  }));
  screen_.close();
  EXPECT_EQ(program.finish().exit_code, 0);
}

TEST_F(View, EveryMethodIsViewed) {
  for (const render::Method& method : render::methods()) {
    SCOPED_TRACE(method.name);
    Words words = common({"--integrator", std::string(method.name), "--passes", "2"});
    std::erase(words, "--spp");
    std::erase(words, "1");
    if (method.has_option("--photons")) words.insert(words.end(), {"--photons", "2000"});
    Program program = view(words);
    ASSERT_TRUE(screen_.find_window());
    ASSERT_TRUE(screen_.wait_for_title("2 of 2 passes"));
    screen_.click({80, 60});
    const std::string line = program.next_line().value_or("");
    EXPECT_TRUE(line.starts_with("ppm-vk: pixel 80,60: L ")) << line;
    EXPECT_EQ(line.find("hit point") != std::string::npos, method.name == "ppm") << line;
    screen_.key("Escape");
    EXPECT_EQ(program.finish().exit_code, 0);
  }
}

TEST_F(View, InterruptionEndsIt) {
  Program program = view(common({"--photons", "2000"}));  // without end
  ASSERT_TRUE(screen_.find_window());
  ASSERT_TRUE(screen_.wait_for_title(" photons"));
  program.send(SIGINT);
  const Result result = program.finish();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(View, WithoutAScreenItSaysSoAtOnce) {
  Words words = common();
  words.insert(words.begin(), "view");
  words[1] = path("nowhere.glb");  // is not even opened
  for (const char* display : {"", ":987654"}) {
    const Result result = Program(words, [&] {
                            unsetenv("WAYLAND_DISPLAY");
                            setenv("DISPLAY", display, 1);
                          }).finish();
    expect_one_error(result, 1, "view: there is no screen");
  }
}

// What cannot be written is told of, and the window stays.
TEST_F(View, FailedSavesAreWarnedOf) {
  std::filesystem::create_directory(folder_ / "d");
  Program program = view(common({"--passes", "1", "-o", path("d/a.png")}));
  ASSERT_TRUE(screen_.find_window());
  ASSERT_TRUE(screen_.wait_for_title("1 of 1 pass"));
  std::filesystem::remove(folder_ / "d");
  screen_.key("o");
  EXPECT_TRUE(program.wait_for("ppm-vk: warning: " + path("d/a.png")));
  std::filesystem::create_directory(folder_ / "d");
  screen_.key("o");
  EXPECT_EQ(program.next_line(), "ppm-vk: wrote " + path("d/a.png") + " after 1 pass");
  screen_.key("Escape");
  EXPECT_EQ(program.finish().exit_code, 0);
}

// Others took the memory that the device had.
TEST_F(View, AllocationsThatFailCostPiecesAndNoPicture) {
  const char* const fault = "vkAllocateMemory 20 -2";  // while buffers for photons are made
  Program program =
      view(common({"--photons", "2000", "--passes", "3"}), [&] { load_layer(fault); });
  ASSERT_TRUE(screen_.find_window());
  EXPECT_TRUE(program.wait_for("warning: ") && program.wait_for("goes on with less at a time\n"));
  EXPECT_TRUE(screen_.wait_for_title("3 of 3 passes"));
  screen_.key("Escape");
  EXPECT_EQ(program.finish().exit_code, 0);
}

// The device is lost in the rendering's thread, the line is the program's last.
TEST_F(View, ALostDeviceEndsItInALine) {
  const char* const fault = "vkQueueSubmit 20 -4";
  Program program = view(common({"--photons", "2000"}), [&] { load_layer(fault); });
  expect_one_error(program.finish(), 1, "vkQueueSubmit: VK_ERROR_DEVICE_LOST");
}

}  // namespace
}  // namespace ppm::test
