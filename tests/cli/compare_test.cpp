// `ppm-vk compare` as its users meet it: a tiny comparison, killed, interrupted and gone on with.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lit_floor.hpp"
#include "program.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Words = std::vector<std::string>;

class CompareCli : public ::testing::Test {
 protected:
  CompareCli() { lit_floor().write(folder_.path() / "s.glb"); }

  std::string path(std::string_view name) const { return (folder_.path() / name).string(); }

  /// Two settings of one method for `time` each, a reference of as much.
  Words small(const std::string& time, const Words& more = {}) const {
    Words words = {"compare",
                   path("s.glb"),
                   "-o",
                   path("report"),
                   "--methods",
                   "ppm,ppm:alpha=0.5",
                   "--width",
                   "16",
                   "--photons",
                   "2000",
                   "--time",
                   time,
                   "--reference-time",
                   time,
                   "--reference-seeds",
                   "2",
                   "--reference-method",
                   "ppm:alpha=0.6"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  bool has(const std::string& name) const {
    return std::filesystem::exists(folder_.path() / "report" / name);
  }
  nlohmann::json record(const std::string& run_name) const {
    return nlohmann::json::parse(
        file_text(folder_.path() / "report" / "runs" / run_name / "run.json"));
  }

  TemporaryFolder folder_;
};

TEST_F(CompareCli, GoesOnWhereItWasKilledAndReportsAll) {
  {
    Program program(small("0.3", {"--seeds", "2"}));
    ASSERT_TRUE(program.wait_for("ppm_alpha_0.5-0: "));  // the first run is there
    program.send(SIGKILL);
    EXPECT_EQ(program.finish().signal, SIGKILL);
  }
  ASSERT_TRUE(has("runs/ppm-0/run.json"));
  EXPECT_FALSE(has("index.html"));
  const std::string first = file_text(folder_.path() / "report" / "runs" / "ppm-0" / "run.json");

  const Result result =
      run(small("0.3", {"--seeds", "2", "--probe", "8,4", "--figure5", "--figure-passes", "3"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.find("ppm-0: "), std::string::npos) << result.err;  // not made again
  EXPECT_EQ(file_text(folder_.path() / "report" / "runs" / "ppm-0" / "run.json"), first);
  for (const char* name :
       {"index.html", "table.csv", "errors.csv", "figure4.csv", "figure5.csv", "pictures/ppm.exr",
        "pictures/ppm.png", "pictures/ppm-error.png", "pictures/ppm_alpha_0.5.exr",
        "pictures/reference.exr", "pictures/reference.png", "pictures/reference-standard-error.exr",
        "pictures/figure5-00003.png"}) {
    EXPECT_TRUE(has(name)) << name;
  }
  for (const char* name : {"ppm-0", "ppm-1", "ppm_alpha_0.5-0", "ppm_alpha_0.5-1"}) {
    const nlohmann::json run_record = record(name);
    const nlohmann::json last = run_record["pictures"].back();
    // It ends where the next picture, resolved as slowly as the last, would be late.
    EXPECT_GE(last["seconds"].get<double>(), 0.2) << name;
    EXPECT_GT(last["passes"].get<int>(), 0) << name;
    EXPECT_EQ(last["photons_emitted"], 2000 * last["passes"].get<int>()) << name;
    EXPECT_GE(run_record["pictures"].size(), 1u) << name;
  }
  EXPECT_NE(file_text(folder_.path() / "report" / "index.html").find("ppm:alpha=0.5"),
            std::string::npos);
  const std::string figure4 = file_text(folder_.path() / "report" / "figure4.csv");
  EXPECT_EQ(std::count(figure4.begin(), figure4.end(), '\n'), 4);  // the heading, three passes

  // All is there: only the report is written again.
  const Result again = run(small("0.3", {"--seeds", "2"}));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.err, "");
  // What the folder was not made for.
  expect_one_error(run(small("0.4")), 1, "0.3 s instead of 0.4 s");
  expect_one_error(run(small("0.3", {"--spp", "1"})), 1, "spp 4 instead of 1");
  expect_one_error(run(small("0.3", {"--height", "20"})), 1, "holds another comparison");
  lit_floor(0.5, 11.0).write(folder_.path() / "s.glb");
  expect_one_error(run(small("0.3")), 1, "scene contents");
}

TEST_F(CompareCli, InterruptionLeavesAFolderThatGoesOn) {
  Program program(small("1h"));
  ASSERT_TRUE(program.wait_for("ppm-0: "));
  program.send(SIGINT);
  const Result result = program.finish();
  EXPECT_EQ(result.exit_code, 130) << result.signal << result.err;
  EXPECT_NE(result.err.find("interrupted; the same command goes on"), std::string::npos);
  EXPECT_TRUE(has("comparison.json"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "report" / "runs"));
}

TEST_F(CompareCli, RefusesInALine) {
  expect_one_error(run({"compare", path("s.glb")}), 2, "-o");
  expect_one_error(run(small("never")), 2, "-time: 'never'");
  expect_one_error(run(small("0.1", {"--integrator", "ppm"})), 2, "--methods");
  expect_one_error(run(small("0.1", {"--passes", "3"})), 2, "--time");
  expect_one_error(run({"compare", path("s.glb"), "-o", path("r"), "--methods", "ppm,magic"}), 2,
                   "magic");
  expect_one_error(run({"compare", path("s.glb"), "-o", path("r"), "--methods", "ppm:seed=3"}), 2,
                   "ppm:seed=3");
  expect_one_error(run({"compare", path("s.glb"), "-o", path("r"), "--methods", "ppm:alpha=2"}), 2,
                   "alpha");
  expect_one_error(run({"compare", path("s.glb"), "-o", path("r"), "--methods", "ppm,ppm"}), 1,
                   "twice");
  expect_one_error(run(small("0.1", {"--probe", "16,0"})), 1, "--probe");
  expect_one_error(run({"compare", path("s.glb"), "-o", path("s.glb"), "--methods", "ppm"}), 1,
                   "s.glb");
  expect_one_error(run({"compare", path("s.glb"), "-o", path("r"), "--methods", "ppm",
                        "--reference", path("none.exr")}),
                   1, "none.exr");
  expect_one_error(run({"compare", path("none.glb"), "-o", path("r")}), 1, "none.glb");
}

}  // namespace
}  // namespace ppm::test
