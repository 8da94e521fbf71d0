// `ppm-vk bench` as its users meet it.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "gltf_writer.hpp"
#include "output_file.hpp"
#include "program.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Names = std::set<std::string>;
using Words = std::vector<std::string>;
using nlohmann::json;

class BenchCli : public ::testing::Test {
 protected:
  std::string out(std::string_view name) const { return (folder_.path() / name).string(); }

  /// Takes hardly any time.
  static Words small(const Words& more) {
    Words words = {"bench", "--width", "32", "--photons", "500", "--passes", "1", "--repeat", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Results of the small room in a file.
  json measured(const std::string& file) const {
    const Result result = run(small({"room", "--quiet", "--json", file}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(file_text(file));
  }

  void write(const std::string& file, const json& document) const {
    write_whole(file, document.dump());
  }

  TemporaryFolder folder_;
};

TEST_F(BenchCli, PrintsATableAndWritesJson) {
  const Result result = run(small({"room", "--json", out("r.json")}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* word : {"room/start", "room/pass", "room/kernel:photon", "photons emitted",
                           "device memory", "triangles"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word << result.out;
  }
  EXPECT_NE(result.err.find("ppm-vk: room, repetition 2 of 2\n"), std::string::npos) << result.err;
  EXPECT_EQ(folder_.names(), (Names{"r.json"}));
  const json file = json::parse(file_text(folder_ / "r.json"));
  EXPECT_EQ(file["context"]["program"], "ppm-vk " PPM_VK_VERSION);
  EXPECT_GT(file["benchmarks"].size(), 20u);
}

TEST_F(BenchCli, JsonOnStandardOutputStandsAlone) {
  const Result result = run(small({"room", "--quiet", "--json", "-"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(json::parse(result.out).contains("benchmarks"));
  EXPECT_NE(result.err.find("room/pass"), std::string::npos) << result.err;
}

TEST_F(BenchCli, MeasuresFiles) {
  GltfWriter writer;
  writer.mesh(quad({-1.0f, 0.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}),
              writer.material(lambert(glm::dvec3(0.5))));
  writer.point_light({0.0, 1.0, 0.0}, glm::dvec3(1.0), 10.0);
  writer.write(folder_.path() / "floor.glb");
  const Result result = run(small({out("floor.glb")}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("floor.glb/pass"), std::string::npos) << result.out;
  expect_one_error(run(small({out("missing.glb")})), 1, "missing.glb");
}

TEST_F(BenchCli, ComparesTwoFilesWithoutMeasuring) {
  const std::string old_file = out("old.json"), new_file = out("new.json");
  json document = measured(old_file);
  const Result alike = run({"bench", "--compare", old_file, "--with", old_file});
  EXPECT_EQ(alike.exit_code, 0) << alike.err;
  EXPECT_EQ(alike.err, "");
  EXPECT_NE(alike.out.find("room/pass"), std::string::npos) << alike.out;
  EXPECT_NE(alike.out.find("1.000"), std::string::npos) << alike.out;

  // A pass of twice the time, a kernel less, and another device.
  json changed = document;
  json entries = json::array();
  for (json& entry : changed["benchmarks"]) {
    if (entry["run_name"] == "room/kernel:gather") continue;
    if (entry["name"] == "room/pass") entry["real_time"] = 2.0 * entry["real_time"].get<double>();
    entries.push_back(entry);
  }
  changed["benchmarks"] = entries;
  changed["context"]["device"] = "another";
  write(new_file, changed);
  const Result worse = run({"bench", "--compare", old_file, "--with", new_file});
  expect_one_error(worse, 1, "room/pass");
  EXPECT_NE(worse.out.find("2.000 WORSE"), std::string::npos) << worse.out;
  EXPECT_NE(worse.err.find("room/kernel:gather: only in the old results"), std::string::npos);
  EXPECT_NE(worse.err.find("device: was "), std::string::npos) << worse.err;

  const Result tolerated =
      run({"bench", "--compare", old_file, "--with", new_file, "--tolerance", "101%"});
  EXPECT_EQ(tolerated.exit_code, 0) << tolerated.err;
  EXPECT_EQ(run({"bench", "--compare", new_file, "--with", old_file}).exit_code, 0);  // better
}

TEST_F(BenchCli, MeasuresTheScenesOfOldResultsAndFailsWhereOneIsWorse) {
  const std::string old_file = out("old.json");
  json document = measured(old_file);
  for (json& entry : document["benchmarks"]) entry["real_time"] = 1e-6;
  write(old_file, document);
  const Result result = run(
      small({"--quiet", "--compare", old_file, "--json", out("new.json"), "--tolerance", "50"}));
  expect_one_error(result, 1, "worse by more than 50 %");
  EXPECT_NE(result.out.find("room/pass"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("uneven"), std::string::npos) << result.out;
  EXPECT_EQ(folder_.names(), (Names{"old.json", "new.json"}));
}

TEST_F(BenchCli, RefusesBrokenResultsBeforeMeasuring) {
  const std::string broken = out("broken.json");
  write_whole(broken, R"({"context": {}, "benchm)");
  const Result result = run({"bench", "--compare", broken});
  expect_one_error(result, 1, "broken.json");
  EXPECT_EQ(result.out, "");
  expect_one_error(run(small({"room", "--json", out("no/such/folder.json")})), 1, "folder.json");
}

TEST_F(BenchCli, AnUnknownSceneIsToldTheBuiltInOnes) {
  const Result result = run({"bench", "cellar"});
  expect_one_error(result, 2, "room, big (big-700k, big-1500k), dark, uneven");
  EXPECT_EQ(result.out, "");
}

TEST_F(BenchCli, InterruptionWritesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program({"bench", "room", "--width", "32", "--photons", "500", "--passes", "4000000000",
                     "--json", out("r.json")});
    ASSERT_TRUE(program.wait_for("repetition 1 of 5"));
    program.send(signal);
    const Result result = program.finish();
    EXPECT_EQ(result.exit_code, 130) << result.signal << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find("interrupted; nothing is written"), std::string::npos) << result.err;
    EXPECT_EQ(folder_.names(), Names{});
  }
}

}  // namespace
}  // namespace ppm::test
