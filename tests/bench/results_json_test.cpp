// Results as a file: the schema that Google Benchmark's tools read, and the way back.
#include "results_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "failure.hpp"
#include "temporary_folder.hpp"

namespace ppm::bench {
namespace {

using nlohmann::json;

Results two_rows() {
  Results results;
  results.context = {{"program", "ppm-vk 1.2.3"}, {"device", "a \"device\"\n"}};
  results.rows.push_back({"room/pass", 4, {0.25, 0.5, 0.125}, {0.5, 1.0, 0.25}, {}});
  results.rows.back().counters["photon_rays_per_second"] = {1e6, 2e6, 4e6};
  results.rows.back().counters["device_memory_bytes"] = {1e9, 1e9, 1e9};
  results.rows.push_back({"room/kernel:gather", 4, {0.0625, 0.03125, 0.125}, {}, {}});
  results.rows.back().counters["share"] = {0.25, 0.125, 0.5};
  return results;
}

Machine some_machine() {
  Machine machine;
  machine.date = "2020-01-02T03:04:05+00:00";
  machine.host_name = "host";
  machine.executable = "/bin/ppm-vk";
  machine.processors = 2;
  machine.megahertz = 2400;
  machine.caches = {{"Data", 1, 32768, 1}};
  machine.load_average = {0.5, 0.25, 0.125};
  return machine;
}

json document() {
  return json::parse(results_json(two_rows(), some_machine()));
}

TEST(ResultsJson, ContextHasAllThatGoogleBenchmarkWrites) {
  const json context = document()["context"];
  EXPECT_EQ(context["date"], "2020-01-02T03:04:05+00:00");
  EXPECT_EQ(context["host_name"], "host");
  EXPECT_EQ(context["executable"], "/bin/ppm-vk");
  EXPECT_EQ(context["num_cpus"], 2);
  EXPECT_EQ(context["mhz_per_cpu"], 2400);
  EXPECT_EQ(context["cpu_scaling_enabled"], false);
  EXPECT_EQ(context["caches"],
            json::parse(R"([{"type": "Data", "level": 1, "size": 32768, "num_sharing": 1}])"));
  EXPECT_EQ(context["load_avg"], json::parse("[0.5, 0.25, 0.125]"));
  EXPECT_TRUE(context["library_build_type"] == "release" ||
              context["library_build_type"] == "debug");
  EXPECT_EQ(context["json_schema_version"], 1);
  EXPECT_EQ(context["program"], "ppm-vk 1.2.3");
  EXPECT_EQ(context["device"], "a \"device\"\n");
}

TEST(ResultsJson, EveryRepetitionIsAnEntry) {
  const json entries = document()["benchmarks"];
  ASSERT_EQ(entries.size(), 2u * (3 + 5));  // repetitions and aggregates
  for (std::size_t i = 0; i < 3; ++i) {
    const json& entry = entries[i];
    EXPECT_EQ(entry["name"], "room/pass");
    EXPECT_EQ(entry["run_name"], "room/pass");
    EXPECT_EQ(entry["family_index"], 0);
    EXPECT_EQ(entry["per_family_instance_index"], 0);
    EXPECT_EQ(entry["run_type"], "iteration");
    EXPECT_EQ(entry["repetitions"], 3);
    EXPECT_EQ(entry["repetition_index"], i);
    EXPECT_EQ(entry["threads"], 1);
    EXPECT_EQ(entry["iterations"], 4);
    EXPECT_EQ(entry["time_unit"], "us");
    EXPECT_EQ(entry["device_memory_bytes"], 1e9);
  }
  EXPECT_EQ(entries[1]["real_time"], 5e5);
  EXPECT_EQ(entries[1]["cpu_time"], 1e6);
  EXPECT_EQ(entries[2]["photon_rays_per_second"], 4e6);
}

TEST(ResultsJson, AggregatesFollow) {
  const json entries = document()["benchmarks"];
  const auto find = [&](const std::string& name) {
    for (const json& entry : entries) {
      if (entry["name"] == name) return entry;
    }
    return json();
  };
  const json median = find("room/pass_median");
  EXPECT_EQ(median["run_type"], "aggregate");
  EXPECT_EQ(median["run_name"], "room/pass");
  EXPECT_EQ(median["aggregate_name"], "median");
  EXPECT_EQ(median["aggregate_unit"], "time");
  EXPECT_EQ(median["iterations"], 3);
  EXPECT_EQ(median["real_time"], 2.5e5);
  EXPECT_EQ(median["cpu_time"], 5e5);
  EXPECT_EQ(median["photon_rays_per_second"], 2e6);
  EXPECT_EQ(find("room/pass_mad")["real_time"], 1.25e5);
  // Mean 7/24 s, squared deviations 1/576, 25/576, 16/576, so that s^2 = 21/576.
  EXPECT_NEAR(find("room/pass_mean")["real_time"].get<double>(), 7e6 / 24.0, 1e-6);
  EXPECT_NEAR(find("room/pass_stddev")["real_time"].get<double>(), 1e6 * std::sqrt(21.0) / 24.0,
              1e-6);
  const json variation = find("room/pass_cv");
  EXPECT_EQ(variation["aggregate_unit"], "percentage");
  EXPECT_NEAR(variation["real_time"].get<double>(), std::sqrt(21.0) / 7.0, 1e-12);
  // Only the device's clock saw it.
  EXPECT_EQ(find("room/kernel:gather_median")["cpu_time"], 62500.0);
}

TEST(ResultsJson, NamesAreUniqueByRepetition) {
  std::set<std::string> names;
  const json entries = document()["benchmarks"];
  for (const json& entry : entries) {
    names.insert(entry["name"].get<std::string>() + "#" +
                 std::to_string(entry.value("repetition_index", -1)));
  }
  EXPECT_EQ(names.size(), entries.size());
}

TEST(ResultsJson, ReadsWhatItWrote) {
  const Results written = two_rows();
  const Results read = parse_results(results_json(written, some_machine()), "r.json");
  EXPECT_EQ(read.context.at("program"), "ppm-vk 1.2.3");
  EXPECT_EQ(read.context.at("device"), "a \"device\"\n");
  ASSERT_EQ(read.rows.size(), written.rows.size());
  for (std::size_t i = 0; i < read.rows.size(); ++i) {
    EXPECT_EQ(read.rows[i].name, written.rows[i].name);
    EXPECT_EQ(read.rows[i].iterations, written.rows[i].iterations);
    EXPECT_EQ(read.rows[i].seconds, written.rows[i].seconds);  // powers of two: exact in us
    EXPECT_EQ(read.rows[i].counters, written.rows[i].counters);
  }
}

/// The text after one change to the document.
template <class Change>
std::string changed(const Change& change) {
  json edited = document();
  change(edited);
  return edited.dump();
}

TEST(ResultsJson, RefusesWhatIsNotItsOwn) {
  const std::string whole = results_json(two_rows(), some_machine());
  const std::vector<std::string> texts = {
      "",
      "{",
      "[]",
      "null",
      "not json",
      whole.substr(0, whole.size() / 2),
      whole + "x",
      R"({"context": {}, "benchmarks": []})",
      R"({"context": [], "benchmarks": {}})",
      changed([](json& file) { file["context"]["program"] = "other 1.0"; }),
      changed([](json& file) { file["context"].erase("program"); }),
      changed([](json& file) { file["benchmarks"] = json::array(); }),
      changed([](json& file) { file["benchmarks"][0] = 7; }),
      changed([](json& file) { file["benchmarks"][0].erase("run_type"); }),
      changed([](json& file) { file["benchmarks"][1].erase("real_time"); }),
      changed([](json& file) { file["benchmarks"][1]["real_time"] = "fast"; }),
      changed([](json& file) { file["benchmarks"][1]["real_time"] = nullptr; }),
      changed([](json& file) { file["benchmarks"][1]["real_time"] = -1.0; }),
      changed([](json& file) { file["benchmarks"][0]["time_unit"] = "ns"; }),
      changed([](json& file) { file["benchmarks"][1]["run_name"] = "room/kernel:gather"; }),
      std::string(100000, '['),
  };
  for (const std::string& text : texts) {
    SCOPED_TRACE(text.substr(0, 200));
    try {
      parse_results(text, "old.json");
      ADD_FAILURE() << "was accepted";
    } catch (const Failure& failure) {
      EXPECT_EQ(std::string(failure.what()).find("old.json: "), 0u) << failure.what();
    }
  }
}

TEST(ResultsJson, FilesThatCannotBeReadAreNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(read_results(folder / "none.json"), Failure);
  EXPECT_THROW(read_results(folder.path()), Failure);
}

}  // namespace
}  // namespace ppm::bench
