// What the viewer says.
#include "status.hpp"

#include <gtest/gtest.h>

#include "saved_files.hpp"
#include "temporary_folder.hpp"

namespace ppm::view {
namespace {

TEST(ViewStatus, TitleTellsWhatIsShownAndHow) {
  Status status{"lamp.glb", "ppm", {}, false, {}};
  EXPECT_EQ(title_text(status, nullptr), "lamp.glb: ppm, 0 passes");
  Frame frame;
  frame.passes = 1;
  frame.photons = 9999;
  EXPECT_EQ(title_text(status, &frame), "lamp.glb: ppm, 1 pass, 9999 photons");
  status.passes = 64;
  status.paused = true;
  status.encoding = {.exposure = -1.5, .tone = image::Tone::agx};
  frame.photons = 2400000;
  EXPECT_EQ(title_text(status, &frame),
            "lamp.glb: ppm, 1 of 64 passes, 2.4 M photons, exposure -1.5, agx, paused");
  status = {"lamp.glb", "pt", {}, false, {}};
  frame.passes = 20;
  frame.photons = 0;
  frame.reading = Reading{{3, 4}, {0.5, 0.25, 12345.0}, {}};
  EXPECT_EQ(title_text(status, &frame),
            "lamp.glb: pt, 20 passes | pixel 3,4: L 0.5 0.25 1.234e+04");
}

// tau = pi R^2 L N_emitted [HOJ08 Eq. 13]: pi * 0.25 * 2 * 1000.
TEST(ViewStatus, ReadingHasTheUnnormalisedFlux) {
  const Reading reading{{3, 4}, {0.5, 0.25, 0.0}, render::ProbeReading{7.0, 0.5, {2.0, 1.0, 0.0}}};
  EXPECT_EQ(reading_line(reading, 2, 1000),
            "pixel 3,4: L 0.5 0.25 0; hit point L 2 1 0, R 0.5, N 7, tau 1571 785.4 0, after 2 "
            "passes");
}

TEST(ViewSavedFiles, AreThoseAskedForOrNumbered) {
  const test::TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  using Files = std::vector<std::filesystem::path>;
  EXPECT_EQ(saved_files({"a.png"}, "x/lamp.glb"), Files{"a.png"});
  EXPECT_EQ(saved_files({}, "x/lamp.glb"), (Files{"lamp-1.exr", "lamp-1.png"}));
  std::ofstream("lamp-1.png") << "x";
  std::filesystem::create_symlink("nowhere", "lamp-2.exr");
  EXPECT_EQ(saved_files({}, "x/lamp.glb"), (Files{"lamp-3.exr", "lamp-3.png"}));
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace ppm::view
