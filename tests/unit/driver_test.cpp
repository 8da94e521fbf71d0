// The driver with an integrator that only counts: budget, signals, what is written and when.
#include "driver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "counter.hpp"
#include "failure.hpp"
#include "progress.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::render {
namespace {

using test::Counter;
using test::file_text;
using test::TemporaryFolder;
using Names = std::set<std::string>;

class Driver : public ::testing::Test {
 protected:
  Driver() {
    settings_.width = 8;
    settings_.height = 4;
    settings_.photons_per_pass = 1000;
    circumstances_.program = "ppm-vk test";
    circumstances_.device = "a device";
    circumstances_.driver = "a driver";
    circumstances_.scene = "some/folder/s.glb";
    circumstances_.load_seconds = 0.25;
    circumstances_.seconds_before = 3.0;
    circumstances_.device_memory_bytes = [] { return std::uint64_t{12345}; };
    outputs_.pictures = {folder_ / "p.exr", folder_ / "p.png"};
    outputs_.statistics = folder_ / "s.json";
  }

  Outcome run(Counter& counter, std::uint64_t passes) {
    const Interruption interruption;
    return drive(counter, settings_, {passes, {}}, outputs_, circumstances_, interruption, log_);
  }

  float red(const char* name) { return test::read_picture(folder_ / name).values.at(0); }

  nlohmann::json statistics() { return nlohmann::json::parse(file_text(folder_ / "s.json")); }

  TemporaryFolder folder_;
  Settings settings_;
  Circumstances circumstances_;
  Outputs outputs_;
  Log log_{Verbosity::quiet};
};

TEST_F(Driver, SpendsTheBudgetAndWritesEverything) {
  Counter counter(settings_);
  EXPECT_EQ(run(counter, 5), Outcome::complete);
  EXPECT_EQ(counter.prepared, 1);
  EXPECT_EQ(red("p.exr"), 5.0f);
  EXPECT_EQ(folder_.names(), (Names{"p.exr", "p.png", "s.json"}));
  EXPECT_TRUE(log_.warnings().empty());
}

/// A pass takes some 10 ms; after `most` there is nothing left to do.
class Sleeper : public Counter {
 public:
  explicit Sleeper(const Settings& settings, std::uint64_t most = 1000)
      : Counter(settings), most_(most) {}
  bool advance(const std::function<bool()>& interrupted) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    counted.samples = counted.passes + 1;
    return Counter::advance(interrupted);
  }
  bool complete() const override { return counted.passes >= most_; }

 private:
  std::uint64_t most_;
};

TEST_F(Driver, TimeEndsWithThePassInHand) {
  const Interruption interruption;
  for (const double seconds : {1e-6, 0.1}) {
    Sleeper sleeper(settings_);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(
        drive(sleeper, settings_, {{}, seconds}, outputs_, circumstances_, interruption, log_),
        Outcome::complete);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    EXPECT_GE(taken.count(), seconds);
    EXPECT_LE(sleeper.counted.passes, seconds < 0.1 ? 1u : 10u);
    EXPECT_GE(sleeper.counted.passes, 1u);
    EXPECT_EQ(statistics()["samples"], sleeper.counted.samples);
    EXPECT_EQ(statistics()["mutations"], 0);
  }
}

TEST_F(Driver, PassesMayEndBeforeTheTime) {
  const Interruption interruption;
  Sleeper sleeper(settings_);
  drive(sleeper, settings_, {3, 60.0}, outputs_, circumstances_, interruption, log_);
  EXPECT_EQ(sleeper.counted.passes, 3u);
}

TEST_F(Driver, StopsWhenTheMethodIsComplete) {
  Sleeper sleeper(settings_, 4);
  EXPECT_EQ(run(sleeper, 100), Outcome::complete);
  EXPECT_EQ(sleeper.counted.passes, 4u);
  EXPECT_TRUE(log_.warnings().empty());
}

TEST_F(Driver, ProgressOfSamplesSaysSo) {
  Log log(Verbosity::normal);
  const Interruption interruption;
  Sleeper sleeper(settings_);
  testing::internal::CaptureStderr();
  drive(sleeper, settings_, {2, {}}, outputs_, circumstances_, interruption, log);
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("sample 1 of 2, "), std::string::npos) << text;
  EXPECT_NE(text.find(" samples/s, 0:00 in all"), std::string::npos) << text;
}

TEST_F(Driver, StatisticsHaveAllTheirKeys) {
  Counter counter(settings_);
  counter.counted.paths_cut = 3;
  counter.counted.rejected = {{"clamped", 4}, {"overflow", 5}};
  counter.counted.initial_radius_median = 0.125;
  counter.counted.seconds = {{"bvh", 1.5}, {"photons", 2.5}};
  run(counter, 2);
  const nlohmann::json json = statistics();
  for (const char* key : {"device",
                          "driver",
                          "width",
                          "height",
                          "triangles",
                          "lights",
                          "hit_points",
                          "tiles",
                          "passes",
                          "photons_emitted",
                          "photons_stored",
                          "alpha",
                          "seed",
                          "initial_radius",
                          "seconds",
                          "pass_seconds",
                          "device_memory_bytes",
                          "paths_cut",
                          "rejected",
                          "warnings"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  for (const char* key : {"load", "bvh", "pipelines", "pilot", "eye", "photons", "grid", "update",
                          "resolve", "write", "total"}) {
    EXPECT_TRUE(json["seconds"][key].is_number()) << key;
  }
  for (const char* key : {"non_finite", "clamped", "overflow"}) {
    EXPECT_TRUE(json["rejected"][key].is_number_unsigned()) << key;
  }
  EXPECT_EQ(json["width"], 8);
  EXPECT_EQ(json["passes"], 2);
  EXPECT_EQ(json["photons_emitted"], 2000);
  EXPECT_EQ(json["pass_seconds"].size(), 2u);
  EXPECT_EQ(json["seconds"]["load"], 0.25);
  EXPECT_EQ(json["seconds"]["bvh"], 1.5);
  EXPECT_GE(json["seconds"]["total"], 3.0);
  EXPECT_EQ(json["device_memory_bytes"], 12345);
  EXPECT_EQ(json["initial_radius"]["median"], 0.125);
  EXPECT_EQ(json["rejected"]["clamped"], 4);
  EXPECT_EQ(json["warnings"].size(), 2u);  // of the cut paths and of the overflow
}

TEST_F(Driver, AttributesNameWhatMadeThePictureButNoTimes) {
  settings_.seed = 4294967295u;
  Counter counter(settings_);
  run(counter, 1);
  const OIIO::ImageSpec spec = test::read_picture(folder_ / "p.exr").spec;
  EXPECT_EQ(spec.get_string_attribute("ppm-vk:device"), "a device");
  EXPECT_EQ(spec.get_string_attribute("ppm-vk:scene"), "s.glb");
  const auto* const seed = spec.find_attribute("ppm-vk:seed", OIIO::TypeDesc::DOUBLE);
  ASSERT_NE(seed, nullptr);
  EXPECT_EQ(*static_cast<const double*>(seed->data()), 4294967295.0);
  const std::string first = file_text(folder_ / "p.exr");
  circumstances_.seconds_before = 99.0;
  circumstances_.scene = "elsewhere/s.glb";
  Counter again(settings_);
  run(again, 1);
  EXPECT_EQ(file_text(folder_ / "p.exr"), first);
}

TEST_F(Driver, InterruptedPassIsDiscardedAndThePictureSoFarWritten) {
  Counter counter(settings_);
  counter.interrupt_in_pass = 4;
  EXPECT_EQ(run(counter, 100), Outcome::interrupted);
  EXPECT_EQ(red("p.exr"), 3.0f);
  EXPECT_EQ(statistics()["passes"], 3);
  EXPECT_EQ(log_.warnings().size(), 1u);
}

TEST_F(Driver, InterruptedWhilePreparing) {
  Counter counter(settings_);
  counter.interrupt_in_prepare = true;
  EXPECT_EQ(run(counter, 100), Outcome::interrupted);
  EXPECT_EQ(red("p.exr"), 0.0f);
}

TEST_F(Driver, SecondSignalEndsTheProgram) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const int second : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          const Interruption interruption;
          std::raise(SIGINT);
          if (!interruption.requested()) std::_Exit(1);
          std::raise(second);
          std::_Exit(2);
        },
        testing::KilledBySignal(second), "");
  }
}

TEST_F(Driver, UnwritableOutputsAreFoundBeforeRendering) {
  const Outputs good = outputs_;
  test::write_text(folder_ / "file", "");
  for (const bool picture : {true, false}) {
    outputs_ = good;
    (picture ? outputs_.pictures[1] : outputs_.statistics) = folder_ / "file" / "p.png";
    Counter counter(settings_);
    EXPECT_THROW(run(counter, 1), Failure);
    EXPECT_EQ(counter.prepared, 0);
    EXPECT_EQ(folder_.names(), Names{"file"});
  }
}

/// Takes the folder of one output away while the passes run.
class Saboteur : public Counter {
 public:
  Saboteur(const Settings& settings, std::filesystem::path folder)
      : Counter(settings), folder_(std::move(folder)) {}
  bool advance(const std::function<bool()>& interrupted) override {
    std::filesystem::remove_all(folder_);
    return Counter::advance(interrupted);
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(Driver, OneFailingOutputDoesNotCostTheOthers) {
  std::filesystem::create_directory(folder_ / "doomed");
  outputs_.pictures = {folder_ / "doomed" / "p.exr", folder_ / "p.png"};
  Saboteur saboteur(settings_, folder_ / "doomed");
  try {
    run(saboteur, 1);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("doomed"), std::string::npos);
  }
  EXPECT_EQ(folder_.names(), (Names{"p.png", "s.json"}));
}

TEST_F(Driver, ProgressIsPlainLinesAtPowersOfTwoAndTheEnd) {
  Log log(Verbosity::normal);
  const Interruption interruption;
  Counter counter(settings_);
  testing::internal::CaptureStderr();
  drive(counter, settings_, {11, {}}, outputs_, circumstances_, interruption, log);
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5) << text;
  for (const char* pass :
       {"pass 1 of 11,", "pass 2 of 11,", "pass 4 of 11,", "pass 8 of 11,", "pass 11 of 11,"}) {
    EXPECT_NE(text.find(pass), std::string::npos) << pass;
  }
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

/// Makes up to three passes at a time.
class Triple : public Counter {
 public:
  using Counter::Counter;
  std::uint64_t advance_up_to(std::uint64_t passes,
                              const std::function<bool()>& interrupted) override {
    asked.push_back(passes);
    std::uint64_t made = 0;
    while (made < std::min<std::uint64_t>(passes, 3) && advance(interrupted)) ++made;
    return made;
  }
  std::vector<std::uint64_t> asked;
};

TEST_F(Driver, SeveralPassesAtATimeAreAsManyAsAskedFor) {
  Triple triple(settings_);
  EXPECT_EQ(run(triple, 8), Outcome::complete);
  EXPECT_EQ(triple.counted.passes, 8u);
  EXPECT_EQ(triple.asked, (std::vector<std::uint64_t>{8, 5, 2}));
}

TEST_F(Driver, PassesBeforeAnInterruptionAmongSeveralAreKept) {
  Triple triple(settings_);
  triple.interrupt_in_pass = 6;
  EXPECT_EQ(run(triple, 8), Outcome::interrupted);
  EXPECT_EQ(triple.counted.passes, 5u);
}

TEST_F(Driver, QuietIsQuiet) {
  Counter counter(settings_);
  testing::internal::CaptureStderr();
  run(counter, 3);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, NumbersAndTimesAreShort) {
  EXPECT_EQ(short_count(0.0), "0");
  EXPECT_EQ(short_count(42.0), "42");
  EXPECT_EQ(short_count(999.4), "999");
  EXPECT_EQ(short_count(999.6), "1k");
  EXPECT_EQ(short_count(310400.0), "310k");
  EXPECT_EQ(short_count(1254321.0), "1.25M");
  EXPECT_EQ(short_count(2.5e9), "2.5G");
  EXPECT_EQ(clock_time(0.4), "0:00");
  EXPECT_EQ(clock_time(67.0), "1:07");
  EXPECT_EQ(clock_time(3.0 * 3600.0 + 9.0), "3:00:09");
  EXPECT_EQ(clock_time(-1.0), "0:00");
}

}  // namespace
}  // namespace ppm::render
