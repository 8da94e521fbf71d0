// Renderings that are stopped, killed and starved of disk, and go on as if nothing had been.
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "kept_rendering.hpp"
#include "read_picture.hpp"

namespace ppm::test {
namespace {

/// Passes that would take weeks.
constexpr const char* kEndless = "4000000000";

/// Without these, permissions bind root, too.
void drop_rights() {
  prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE);
  prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH);
}

class CliResume : public KeptRendering {
 protected:
  /// One line for the error, besides those of progress, which has these words.
  static void expect_refused(const Result& result, int exit_code, const std::string& words) {
    EXPECT_EQ(result.exit_code, exit_code) << result.err << "signal " << result.signal;
    EXPECT_NE(result.err.find("ppm-vk: error: "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  }
};

// Twenty kills of one rendering, each at another moment, some while it starts; what is left goes
// on each time. Every other time it is cut into dispatches and tiles in another way.
TEST_F(CliResume, KilledAtAnyMomentItGoesOnToTheSameBytes) {
  const std::string expected = one_go({"--passes", "200"});
  std::mt19937 random(std::random_device{}());
  const auto milliseconds = [&](int most) {
    return std::chrono::milliseconds(std::uniform_int_distribution<int>(0, most)(random));
  };
  std::uint64_t passes = 0;
  int killed = 0;
  for (int moment = 0; moment < 20; ++moment) {
    const bool is_there = std::filesystem::exists(folder_ / "c");
    Words words = is_there ? resume({}) : kept({"--passes", "200"});
    if (is_there && moment % 2 == 1) {
      words.insert(words.end(), {"--dispatch-ms", "0.01", "--tile-hits", "100"});
    }
    Program program(words);
    if (moment % 5 == 0) {
      std::this_thread::sleep_for(milliseconds(500));
    } else {
      program.wait_for("\"passes\":");
      std::this_thread::sleep_for(milliseconds(40));
    }
    program.send(SIGKILL);
    const Result result = program.finish();
    EXPECT_TRUE(result.signal == SIGKILL || result.exit_code == 0) << result.err;
    killed += result.signal == SIGKILL ? 1 : 0;
    if (!std::filesystem::exists(folder_ / "c")) continue;
    const std::uint64_t now = kept_passes();
    EXPECT_GE(now, passes);
    passes = now;
  }
  EXPECT_GT(killed, 0);
  std::filesystem::remove(folder_ / "o.exr");
  const Result last = run(resume({}));
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_TRUE(file_text(folder_ / "o.exr") == expected) << "after " << killed << " kills";
  // Not even what was being written is left.
  EXPECT_EQ(folder_.names(), (std::set<std::string>{"c", "o.exr", "s.glb", "whole.exr"}));
}

TEST_F(CliResume, InterruptedItKeepsPictureAndCheckpoint) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::filesystem::remove(folder_ / "c");
    Words words = kept({"--passes", kEndless});
    *std::ranges::find(words, "0.0001") = "1h";
    Program program(words);
    ASSERT_TRUE(program.wait_for("\"passes\":2"));
    program.send(signal);
    const Result result = program.finish();
    EXPECT_EQ(result.exit_code, 130) << result.err;
    const std::uint64_t passes = kept_passes();
    EXPECT_GE(passes, 2u);
    EXPECT_EQ(file_text(folder_ / "o.exr"), one_go({"--passes", std::to_string(passes)}));
    const std::string total = std::to_string(passes + 3);
    EXPECT_EQ(run(resume({"--passes", total, "-o", path("p.exr")})).exit_code, 0);
    EXPECT_EQ(file_text(folder_ / "p.exr"), one_go({"--passes", total}));
    EXPECT_EQ(kept_passes(), passes + 3);
  }
}

// Whoever asks twice does not wait; what was whole stays so.
TEST_F(CliResume, ASecondInterruptionEndsAtOnce) {
  for (int round = 0; round < 3; ++round) {
    std::filesystem::remove(folder_ / "c");
    Program program(kept({"--passes", kEndless}));
    ASSERT_TRUE(program.wait_for("\"passes\":2"));
    program.send(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(2 * round));
    program.send(SIGINT);
    const Result result = program.finish();
    EXPECT_TRUE(result.signal == SIGINT || result.exit_code == 130) << result.err;
    EXPECT_GE(kept_passes(), 1u);
    if (std::filesystem::exists(folder_ / "o.exr")) {
      EXPECT_EQ(read_picture(folder_ / "o.exr").spec.width, 16);
    }
  }
}

// As nohup starts it.
TEST_F(CliResume, AnIgnoredHangupStaysIgnored) {
  Program program(kept({"--passes", kEndless}), [] { signal(SIGHUP, SIG_IGN); });
  ASSERT_TRUE(program.wait_for("\"passes\":2"));
  program.send(SIGHUP);
  ASSERT_TRUE(program.wait_for("\"passes\":16"));
  program.send(SIGTERM);
  EXPECT_EQ(program.finish().exit_code, 130);
}

TEST_F(CliResume, OtherMethodsGoOnAsWell) {
  for (const char* const method : {"pt-mis", "bdpt"}) {
    SCOPED_TRACE(method);
    std::filesystem::remove(folder_ / "c");
    Words words = {"render",   path("s.glb"), "--width", "16",          "--integrator", method,
                   "--passes", "3",           "-o",      path("o.exr"), "--quiet"};
    Words first = words;
    first.insert(first.end(), {"--checkpoint", path("c")});
    EXPECT_EQ(run(first).exit_code, 0);
    EXPECT_EQ(run(resume({"--passes", "7"})).exit_code, 0);
    const std::string resumed = file_text(folder_ / "o.exr");
    words[7] = "7";
    EXPECT_EQ(run(words).exit_code, 0);
    EXPECT_TRUE(file_text(folder_ / "o.exr") == resumed);
  }
}

TEST_F(CliResume, WhatCannotGoOnIsRefusedInALine) {
  EXPECT_EQ(run(kept({"--passes", "2"})).exit_code, 0);
  const std::string sound = file_text(folder_ / "c");
  expect_refused(run(kept({"--passes", "2"})), 1, "go on with ppm-vk resume " + path("c"));
  EXPECT_EQ(file_text(folder_ / "c"), sound);

  write_text(folder_ / "c", sound.substr(0, sound.size() - 1));
  expect_refused(run(resume({})), 1, "is cut short");
  std::string damaged = sound;
  damaged[sound.size() / 2] ^= 1;
  write_text(folder_ / "c", damaged);
  expect_refused(run(resume({})), 1, "checksum");
  write_text(folder_ / "c", file_text(folder_ / "s.glb"));
  expect_refused(run(resume({})), 1, "is no checkpoint of ppm-vk");
  std::string newer = sound;
  newer[24] = 99;
  write_text(folder_ / "c", newer);
  expect_refused(run(resume({})), 1, "of version 99");
  expect_refused(run({"info", path("c")}), 1, "of version 99");

  write_text(folder_ / "c", sound);
  lit_floor(0.25).write(folder_ / "s.glb");
  expect_refused(run(resume({"--passes", "5"})), 1, "has changed since: materials:");
  std::filesystem::remove(folder_ / "s.glb");
  expect_refused(run(resume({"--passes", "5"})), 1, "s.glb: there is no such file");
  expect_refused(run(resume({"--photons", "5"})), 2, "--photons");
  expect_refused(run(resume({"--stats", path("c")})), 2,
                 "--stats: '" + path("c") + "' is not a file of its own: see ppm-vk help resume");
  EXPECT_EQ(file_text(folder_ / "c"), sound);
}

// A disk that is full from some pass on: the last whole files stay, and the rest is told.
TEST_F(CliResume, AFullDiskCostsNothingThatWasThere) {
  const auto no_cache = [] { setenv("MESA_SHADER_CACHE_DISABLE", "true", 1); };
  Program program(kept({"--passes", kEndless}), no_cache);
  ASSERT_TRUE(program.wait_for("\"passes\":2"));
  const rlimit full{1000, 1000};
  ASSERT_EQ(prlimit(program.id(), RLIMIT_FSIZE, &full, nullptr), 0);
  ASSERT_TRUE(program.wait_for("the rendering goes on"));
  program.send(SIGTERM);
  expect_refused(program.finish(), 1, "o.exr");
  EXPECT_EQ(folder_.names(), (std::set<std::string>{"c", "s.glb"}));
  const std::string total = std::to_string(kept_passes() + 2);
  EXPECT_EQ(run(resume({"--passes", total})).exit_code, 0);
  EXPECT_EQ(file_text(folder_ / "o.exr"), one_go({"--passes", total}));
}

TEST_F(CliResume, WhatAVanishedFolderCannotTakeGoesElsewhere) {
  std::filesystem::create_directory(folder_ / "disk");
  std::filesystem::create_directory(folder_ / "other");
  Program program(render({"-o", path("disk/o.exr"), "--preview", path("v.hdr"), "--progress",
                          "json", "--passes", kEndless, "--output-fallback", path("other")}));
  ASSERT_TRUE(program.wait_for("\"passes\":2"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "v.hdr"));
  std::filesystem::remove_all(folder_ / "disk");
  program.send(SIGINT);
  const Result result = program.finish();
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_NE(result.err.find("wrote " + path("other/o.exr") + " instead"), std::string::npos)
      << result.err;
  EXPECT_EQ(read_picture(folder_ / "other/o.exr").spec.width, 16);
}

TEST_F(CliResume, AReadOnlyFileIsNotReplaced) {
  write_text(folder_ / "o.exr", "old");
  ASSERT_EQ(chmod(path("o.exr").c_str(), 0444), 0);
  const Result result =
      Program(render({"-o", path("o.exr"), "--passes", kEndless}), drop_rights).finish();
  expect_refused(result, 1, "o.exr: cannot write");
  EXPECT_EQ(file_text(folder_ / "o.exr"), "old");
}

TEST_F(CliResume, InfoTellsWhatFilesHold) {
  EXPECT_EQ(run(kept({"--passes", "3", "--seed", "7"})).exit_code, 0);
  const nlohmann::json checkpoint = nlohmann::json::parse(run({"info", path("c"), "--json"}).out);
  EXPECT_EQ(checkpoint["kind"], "checkpoint");
  EXPECT_EQ(checkpoint["program"], "ppm-vk " PPM_VK_VERSION);
  EXPECT_EQ(checkpoint["scene"], path("s.glb"));
  EXPECT_EQ(checkpoint["passes"], 3);
  EXPECT_EQ(checkpoint["photons_emitted"], 6000);
  EXPECT_EQ(checkpoint["width"], 16);
  const Result picture = run({"info", path("o.exr"), "--json"});
  EXPECT_EQ(picture.exit_code, 0) << picture.err;
  const nlohmann::json facts = nlohmann::json::parse(picture.out);
  EXPECT_EQ(facts["kind"], "picture");
  EXPECT_EQ(facts["height"], 8);
  EXPECT_EQ(facts["channels"]["R"], "float");
  EXPECT_EQ(facts["seed"], 7.0);
  EXPECT_EQ(facts["camera"], "above");
  const Result text = run({"info", path("o.exr")});
  EXPECT_NE(text.out.find("integrator          ppm\n"), std::string::npos) << text.out;
  expect_refused(run({"info", path("s.glb")}), 1, "is no checkpoint of ppm-vk");
  write_text(folder_ / "broken.exr", "EXR?");
  expect_refused(run({"info", path("broken.exr")}), 1, "broken.exr");
  expect_refused(run({"info", path("absent.exr")}), 1, "absent.exr: there is no such file");
  std::filesystem::create_directory(folder_ / "folder.exr");
  expect_refused(run({"info", path("folder.exr")}), 1, "folder.exr: is a folder");
  ASSERT_EQ(mkfifo(path("pipe.exr").c_str(), 0600), 0);  // whoever opened it would wait
  expect_refused(run({"info", path("pipe.exr")}), 1, "pipe.exr: is not a regular file");
  ASSERT_EQ(chmod(path("o.exr").c_str(), 0), 0);
  const Result unreadable = Program({"info", path("o.exr")}, drop_rights).finish();
  expect_refused(unreadable, 1, "o.exr: cannot be opened for reading: Permission denied");
  expect_refused(run({"info"}), 2, "no file is given");
}

}  // namespace
}  // namespace ppm::test
