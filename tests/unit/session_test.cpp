// What a rendering leaves and tells between its passes, with an integrator that only counts.
#include "session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "counter.hpp"
#include "driver.hpp"
#include "failure.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::render {
namespace {

using test::Counter;
using test::file_text;
using test::TemporaryFolder;
using Names = std::set<std::string>;

/// Does something after each pass.
class Eventful : public Counter {
 public:
  Eventful(const Settings& settings, std::function<void(std::uint64_t)> event)
      : Counter(settings), event_(std::move(event)) {}
  bool advance(const std::function<bool()>& interrupted) override {
    if (!Counter::advance(interrupted)) return false;
    event_(counted.passes);
    return true;
  }

 private:
  std::function<void(std::uint64_t)> event_;
};

class Sessions : public ::testing::Test {
 protected:
  Sessions() {
    settings_.width = 8;
    settings_.height = 4;
    settings_.photons_per_pass = 1000;
    circumstances_.program = "ppm-vk test";
    circumstances_.device = "a device";
    circumstances_.driver = "a driver";
    circumstances_.scene = "s.glb";
    circumstances_.device_memory_bytes = [] { return std::uint64_t{0}; };
    outputs_.pictures = {folder_ / "p.exr"};
  }

  void keep(double every_seconds = 1e-9) {
    outputs_.keeping = {folder_ / "c", every_seconds, {"a", "b"}, {{"camera", 5}}};
  }
  Outcome run(Integrator& integrator, const Budget& budget, Checkpoint* resumed = nullptr) {
    const Interruption interruption;
    return drive(integrator, settings_, budget, outputs_, circumstances_, interruption, log_,
                 resumed);
  }
  std::uint64_t kept_passes() { return read_checkpoint(folder_ / "c").statistics.passes; }
  bool warned_of(std::string_view words) const {
    return std::ranges::any_of(log_.warnings(), [&](const std::string& warning) {
      return warning.find(words) != std::string::npos;
    });
  }

  TemporaryFolder folder_;
  Settings settings_;
  Circumstances circumstances_;
  Outputs outputs_;
  Log log_{Verbosity::quiet};
};

// ---- Checkpoints

TEST_F(Sessions, KeepsACheckpointFromBeforeTheFirstPassToTheLast) {
  keep();
  std::vector<std::uint64_t> kept;
  Eventful eventful(settings_, [&](std::uint64_t) { kept.push_back(kept_passes()); });
  EXPECT_EQ(run(eventful, {4, {}}), Outcome::complete);
  EXPECT_EQ(kept, (std::vector<std::uint64_t>{0, 1, 2, 3}));
  const Checkpoint last = read_checkpoint(folder_ / "c");
  EXPECT_EQ(last.statistics.passes, 4u);
  EXPECT_EQ(last.state, eventful.save_state());
  EXPECT_EQ(last.words, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(last.parts, (std::vector<PartHash>{{"camera", 5}}));
  EXPECT_EQ(last.program, "ppm-vk test");
  EXPECT_EQ(last.integrator, "ppm");
  EXPECT_EQ(last.width, 8u);
  EXPECT_EQ(folder_.names(), (Names{"c", "p.exr"}));
}

TEST_F(Sessions, BetweenCheckpointsTimeMustPass) {
  keep(3600.0);
  std::vector<std::uint64_t> kept;
  Eventful eventful(settings_, [&](std::uint64_t) { kept.push_back(kept_passes()); });
  run(eventful, {3, {}});
  EXPECT_EQ(kept, (std::vector<std::uint64_t>{0, 0, 0}));
  EXPECT_EQ(kept_passes(), 3u);
}

TEST_F(Sessions, ResumedIsAsFromOneGo) {
  Counter whole(settings_);
  run(whole, {7, {}});
  const std::string expected = file_text(folder_ / "p.exr");
  keep();
  for (const std::uint64_t stop : {1, 4, 7}) {
    std::filesystem::remove(folder_ / "p.exr");
    Counter first(settings_);
    first.interrupt_in_pass = stop;
    EXPECT_EQ(run(first, {7, {}}), Outcome::interrupted);
    EXPECT_NE(file_text(folder_ / "p.exr"), expected);
    Checkpoint checkpoint = read_checkpoint(folder_ / "c");
    EXPECT_EQ(checkpoint.statistics.passes, stop - 1);
    Counter second(settings_);
    EXPECT_EQ(run(second, {7, {}}, &checkpoint), Outcome::complete);
    EXPECT_EQ(second.prepared, 0);
    EXPECT_EQ(file_text(folder_ / "p.exr"), expected);
    EXPECT_EQ(kept_passes(), 7u);
  }
}

TEST_F(Sessions, WhatWasDoneBeforeCounts) {
  keep();
  Counter first(settings_);
  run(first, {5, {}});
  // Nothing is left to do, or less than nothing: the picture is written all the same.
  for (const std::uint64_t passes : {5, 3}) {
    std::filesystem::remove(folder_ / "p.exr");
    Checkpoint checkpoint = read_checkpoint(folder_ / "c");
    Counter second(settings_);
    EXPECT_EQ(run(second, {passes, {}}, &checkpoint), Outcome::complete);
    EXPECT_EQ(second.counted.passes, 5u);
    EXPECT_EQ(test::read_picture(folder_ / "p.exr").values.at(0), 5.0f);
    EXPECT_EQ(warned_of("more than the 3 asked for"), passes == 3);
  }
  // Time, likewise.
  Checkpoint checkpoint = read_checkpoint(folder_ / "c");
  checkpoint.seconds = 0.2;
  Counter second(settings_);
  EXPECT_EQ(run(second, {{}, 0.1}, &checkpoint), Outcome::complete);
  EXPECT_EQ(second.counted.passes, 5u);
}

TEST_F(Sessions, AStateThatCannotBeKeptIsToldBeforeTheFirstPass) {
  struct Closed : Counter {
    using Counter::Counter;
    SavedState save_state() override { throw Failure("", "--integrator closed", "no", ""); }
  };
  keep();
  Closed closed(settings_);
  EXPECT_THROW(run(closed, {3, {}}), Failure);
  EXPECT_EQ(closed.counted.passes, 0u);
  EXPECT_EQ(folder_.names(), Names{});
}

TEST_F(Sessions, InterruptedBeforeTheFirstPassKeepsNothing) {
  keep();
  Counter counter(settings_);
  counter.interrupt_in_prepare = true;
  EXPECT_EQ(run(counter, {3, {}}), Outcome::interrupted);
  EXPECT_EQ(folder_.names(), Names{"p.exr"});
}

// ---- Disks

// The folder of the checkpoint goes away and comes back: it is told once and tried again.
TEST_F(Sessions, AFailingCheckpointDoesNotEndTheRendering) {
  keep();
  std::filesystem::create_directory(folder_ / "disk");
  outputs_.keeping.file = folder_ / "disk" / "c";
  Eventful eventful(settings_, [&](std::uint64_t pass) {
    if (pass == 2) std::filesystem::remove_all(folder_ / "disk");
    if (pass == 4) std::filesystem::create_directory(folder_ / "disk");
  });
  EXPECT_EQ(run(eventful, {5, {}}), Outcome::complete);
  EXPECT_TRUE(warned_of("the rendering goes on"));
  EXPECT_EQ(log_.warnings().size(), 1u);
  EXPECT_EQ(read_checkpoint(folder_ / "disk" / "c").statistics.passes, 5u);
}

TEST_F(Sessions, WhatCannotBeWrittenGoesElsewhere) {
  std::filesystem::create_directory(folder_ / "disk");
  std::filesystem::create_directory(folder_ / "other");
  outputs_.pictures = {folder_ / "disk" / "p.exr", folder_ / "disk" / "q.png", folder_ / "q.hdr"};
  outputs_.statistics = folder_ / "disk" / "s.json";
  outputs_.fallback = folder_ / "other";
  keep();
  outputs_.keeping.file = folder_ / "disk" / "c";
  Eventful eventful(settings_,
                    [&](std::uint64_t) { std::filesystem::remove_all(folder_ / "disk"); });
  EXPECT_EQ(run(eventful, {3, {}}), Outcome::complete);
  EXPECT_EQ(folder_.names(), (Names{"other", "q.hdr"}));
  Names found;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "other")) {
    found.insert(entry.path().filename().string());
  }
  EXPECT_EQ(found, (Names{"c", "p.exr", "q.png", "s.json"}));
  EXPECT_TRUE(warned_of("other/p.exr instead"));
}

TEST_F(Sessions, WhereElsewhereFailsTooItIsAnError) {
  std::filesystem::create_directory(folder_ / "disk");
  outputs_.pictures = {folder_ / "disk" / "p.exr", folder_ / "q.hdr"};
  outputs_.fallback = folder_ / "disk";
  Eventful eventful(settings_,
                    [&](std::uint64_t) { std::filesystem::remove_all(folder_ / "disk"); });
  EXPECT_THROW(run(eventful, {3, {}}), Failure);
  EXPECT_EQ(folder_.names(), Names{"q.hdr"});
}

TEST_F(Sessions, NamesElsewhereAreNotTakenTwice) {
  Elsewhere elsewhere(folder_.path(), log_);
  const auto refuse_a = [](const std::filesystem::path& file) {
    if (file.parent_path() == "/a") throw Failure(file.string(), "", "no", "");
    test::write_text(file, "x");
  };
  for (int i = 0; i < 3; ++i) elsewhere.write("/a/p.exr", refuse_a);
  EXPECT_EQ(folder_.names(), (Names{"p.exr", "p-2.exr", "p-3.exr"}));
}

// ---- Previews and progress

TEST_F(Sessions, ThePreviewIsThereFromTheFirstPassOn) {
  outputs_.preview = folder_ / "v.hdr";
  outputs_.preview_seconds = 1e-9;
  std::vector<float> seen;
  Eventful eventful(settings_, [&](std::uint64_t pass) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // nine times what one takes
    if (pass > 1) seen.push_back(test::read_picture(folder_ / "v.hdr").values.at(0));
  });
  run(eventful, {4, {}});
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_EQ(seen[0], 1.0f);  // after the first pass, in the second
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_EQ(test::read_picture(folder_ / "v.hdr").values.at(0), 4.0f);
  EXPECT_EQ(folder_.names(), (Names{"p.exr", "v.hdr"}));
}

TEST_F(Sessions, AFailingPreviewIsOnlyWarnedOf) {
  std::filesystem::create_directory(folder_ / "disk");
  outputs_.preview = folder_ / "disk" / "v.hdr";
  Eventful eventful(settings_,
                    [&](std::uint64_t) { std::filesystem::remove_all(folder_ / "disk"); });
  EXPECT_EQ(run(eventful, {3, {}}), Outcome::complete);
  EXPECT_TRUE(warned_of("the rendering goes on"));
  EXPECT_EQ(folder_.names(), Names{"p.exr"});
}

TEST_F(Sessions, ProgressForMachinesIsAnObjectALine) {
  outputs_.progress = ProgressStyle::json;
  Counter counter(settings_);
  testing::internal::CaptureStderr();
  run(counter, {5, 1000.0});
  std::istringstream lines(testing::internal::GetCapturedStderr());
  std::vector<nlohmann::json> told;
  for (std::string line; std::getline(lines, line);) told.push_back(nlohmann::json::parse(line));
  ASSERT_GE(told.size(), 5u);  // preparing; passes 1, 2, 4 and the last; more on a slow machine
  EXPECT_EQ(told[0]["stage"], "preparing");
  EXPECT_EQ(told[1]["passes"], 1);
  EXPECT_FALSE(told[1].contains("change"));
  const nlohmann::json& second = told[2];
  EXPECT_EQ(second["stage"], "passes");
  EXPECT_EQ(second["passes"], 2);
  EXPECT_EQ(second["passes_wanted"], 5);
  EXPECT_EQ(second["photons"], 2000);
  EXPECT_GT(second["photons_per_second"], 0.0);
  EXPECT_GE(second["seconds"], 0.0);
  EXPECT_LE(second["seconds_left"], 1000.0);
  // Red went from 1 to 2, green and blue are 0.5 and 0.25: a change of 1 in 2.75.
  EXPECT_NEAR(second["change"], 1.0 / 2.75, 1e-12);
  EXPECT_EQ(second["change_since"], 1);
  EXPECT_EQ(told.back()["stage"], "done");
  EXPECT_EQ(told.back()["passes"], 5);
}

TEST(PictureChange, IsTheMeanDifferenceOverTheMean) {
  const Picture dark{1, 1, {0.0f, 0.0f, 0.0f}}, grey{1, 1, {1.0f, 1.0f, 2.0f}},
      other{1, 1, {2.0f, 1.0f, 1.0f}},
      broken{1, 1, {std::numeric_limits<float>::quiet_NaN(), 1.0f, 3.0f}};
  EXPECT_EQ(relative_change(grey, grey), 0.0);
  EXPECT_EQ(relative_change(dark, dark), 0.0);
  EXPECT_EQ(relative_change(grey, other), 0.5);
  EXPECT_EQ(relative_change(dark, grey), 1.0);
  EXPECT_EQ(relative_change(grey, dark), 1.0);
  EXPECT_EQ(relative_change(broken, grey), 1.0 / 3.0);
}

// What it is good for: of 2 n independent passes it tells the error, here that of the mean of
// exponentially distributed numbers, whose variance is 1. The mean of |N(0, s)| is s sqrt(2 / pi).
TEST(PictureChange, TellsTheErrorOfIndependentPasses) {
  constexpr std::uint32_t kPixels = 20000, kPasses = 64;
  std::mt19937 random(1);
  std::exponential_distribution<double> radiance(1.0);
  std::vector<double> sums(3 * kPixels, 0.0);
  ChangeMeter meter;
  for (std::uint64_t pass = 1; pass <= kPasses; ++pass) {
    for (double& sum : sums) sum += radiance(random);
    if (!meter.due(pass)) continue;
    Picture picture{kPixels, 1, {}};
    for (const double sum : sums) {
      picture.rgb.push_back(static_cast<float>(sum / static_cast<double>(pass)));
    }
    meter.take(std::move(picture), pass);
  }
  ASSERT_TRUE(meter.change());
  EXPECT_EQ(meter.change()->since, kPasses / 2);
  const double expected = std::sqrt(2.0 / std::numbers::pi / kPasses);
  EXPECT_NEAR(meter.change()->value, expected, 0.02 * expected);  // some 0.3 % of noise
}

}  // namespace
}  // namespace ppm::render
