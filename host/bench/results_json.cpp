#include "results_json.hpp"

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "failure.hpp"
#include "statistics.hpp"

namespace ppm::bench {
namespace {

using Json = nlohmann::ordered_json;
using Statistic = std::function<double(const std::vector<double>&)>;

constexpr double kUnits = 1e6;  // a second
constexpr const char* kUnit = "us";
constexpr const char* kProgram = "ppm-vk";

/// What an entry has that is not a counter.
const std::set<std::string> kOwnKeys = {
    "name",           "family_index",     "per_family_instance_index",
    "run_name",       "run_type",         "repetitions",
    "threads",        "repetition_index", "iterations",
    "real_time",      "cpu_time",         "time_unit",
    "aggregate_name", "aggregate_unit"};

Json context_json(const Results& results, const Machine& machine) {
  Json json;
  json["date"] = machine.date;
  json["host_name"] = machine.host_name;
  json["executable"] = machine.executable;
  json["num_cpus"] = machine.processors;
  json["mhz_per_cpu"] = machine.megahertz;
  json["cpu_scaling_enabled"] = machine.scaling_enabled;
  json["caches"] = Json::array();
  for (const Cache& cache : machine.caches) {
    json["caches"].push_back({{"type", cache.type},
                              {"level", cache.level},
                              {"size", cache.bytes},
                              {"num_sharing", cache.sharing}});
  }
  json["load_avg"] = machine.load_average;
#ifdef NDEBUG
  json["library_build_type"] = "release";
#else
  json["library_build_type"] = "debug";
#endif
  json["json_schema_version"] = 1;
  for (const auto& [key, value] : results.context) json[key] = value;
  return json;
}

/// What iterations and aggregates of a row have in common; `index` is the row's.
Json entry_json(const Row& row, std::size_t index, const std::string& suffix) {
  Json json;
  json["name"] = row.name + suffix;
  json["family_index"] = index;
  json["per_family_instance_index"] = 0;
  json["run_name"] = row.name;
  json["run_type"] = suffix.empty() ? "iteration" : "aggregate";
  json["repetitions"] = row.seconds.size();
  return json;
}

Json iteration_json(const Row& row, std::size_t index, std::size_t repetition) {
  Json json = entry_json(row, index, "");
  json["repetition_index"] = repetition;
  json["threads"] = 1;
  json["iterations"] = row.iterations;
  json["real_time"] = kUnits * row.seconds[repetition];
  const std::vector<double>& cpu = row.cpu_seconds.empty() ? row.seconds : row.cpu_seconds;
  json["cpu_time"] = kUnits * cpu[repetition];
  json["time_unit"] = kUnit;
  for (const auto& [name, values] : row.counters) json[name] = values[repetition];
  return json;
}

Json aggregate_json(const Row& row, std::size_t index, const std::string& name, bool is_ratio,
                    const Statistic& statistic) {
  Json json = entry_json(row, index, "_" + name);
  json["threads"] = 1;
  json["aggregate_name"] = name;
  json["aggregate_unit"] = is_ratio ? "percentage" : "time";
  json["iterations"] = row.seconds.size();
  const double unit = is_ratio ? 1.0 : kUnits;
  json["real_time"] = unit * statistic(row.seconds);
  json["cpu_time"] = unit * statistic(row.cpu_seconds.empty() ? row.seconds : row.cpu_seconds);
  json["time_unit"] = kUnit;
  for (const auto& [counter, values] : row.counters) json[counter] = statistic(values);
  return json;
}

double variation(const std::vector<double>& values) {
  const double centre = mean(values);
  return centre == 0.0 ? 0.0 : standard_deviation(values) / centre;
}

void append(Json& list, const Row& row, std::size_t index) {
  for (std::size_t i = 0; i < row.seconds.size(); ++i) {
    list.push_back(iteration_json(row, index, i));
  }
  list.push_back(aggregate_json(row, index, "mean", false, mean));
  list.push_back(aggregate_json(row, index, "median", false,
                                [](const std::vector<double>& values) { return median(values); }));
  list.push_back(aggregate_json(row, index, "stddev", false, standard_deviation));
  list.push_back(aggregate_json(row, index, "cv", true, variation));
  list.push_back(aggregate_json(row, index, "mad", false, median_absolute_deviation));
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw Failure(file, "", what, "give a file that ppm-vk bench --json wrote");
}

double number_of(const Json& entry, const char* key, const std::string& file) {
  const auto value = entry.find(key);
  if (value == entry.end() || !value->is_number()) {
    refuse(file, std::string("an entry of \"benchmarks\" has no number \"") + key + "\"");
  }
  if (!(value->get<double>() >= 0.0)) refuse(file, std::string("a negative \"") + key + "\"");
  return value->get<double>();
}

std::string text_of(const Json& entry, const char* key, const std::string& file) {
  const auto value = entry.find(key);
  if (value == entry.end() || !value->is_string()) {
    refuse(file, std::string("an entry of \"benchmarks\" has no text \"") + key + "\"");
  }
  return value->get<std::string>();
}

void add_iteration(Results& results, const Json& entry, const std::string& file) {
  const std::string name = text_of(entry, "run_name", file);
  if (text_of(entry, "time_unit", file) != kUnit) refuse(file, "its times are not in microseconds");
  // Repetitions of a row stand together.
  if (results.rows.empty() || results.rows.back().name != name) {
    if (results.find(name)) refuse(file, "\"" + name + "\" is there twice");
    results.rows.push_back({name, 1, {}, {}, {}});
  }
  Row& row = results.rows.back();
  row.iterations = static_cast<std::uint64_t>(number_of(entry, "iterations", file));
  row.seconds.push_back(number_of(entry, "real_time", file) / kUnits);
  row.cpu_seconds.push_back(number_of(entry, "cpu_time", file) / kUnits);
  for (const auto& [key, value] : entry.items()) {
    if (!kOwnKeys.contains(key) && value.is_number()) {
      row.counters[key].push_back(value.get<double>());
    }
  }
}

}  // namespace

std::string results_json(const Results& results, const Machine& machine) {
  Json json;
  json["context"] = context_json(results, machine);
  json["benchmarks"] = Json::array();
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    append(json["benchmarks"], results.rows[i], i);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Results parse_results(const std::string& text, const std::string& file) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) refuse(file, "it is not JSON, or broken off");
  const auto has = [&](const char* key, bool (*is)(const Json&)) {
    return json.is_object() && json.contains(key) && is(json[key]);
  };
  if (!has("context", [](const Json& value) { return value.is_object(); }) ||
      !has("benchmarks", [](const Json& value) { return value.is_array(); })) {
    refuse(file, "it has no \"context\" and \"benchmarks\"");
  }
  Results results;
  for (const auto& [key, value] : json["context"].items()) {
    if (value.is_string()) results.context[key] = value.get<std::string>();
  }
  if (!results.context["program"].starts_with(kProgram)) {
    refuse(file, "it is of another program's benchmark");
  }
  for (const Json& entry : json["benchmarks"]) {
    if (!entry.is_object()) refuse(file, "an entry of \"benchmarks\" is no object");
    if (text_of(entry, "run_type", file) == "iteration") add_iteration(results, entry, file);
  }
  if (results.rows.empty()) refuse(file, "it has no measurements");
  return results;
}

Results read_results(const std::filesystem::path& file) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file, ignored)) {
    throw Failure(file.string(), "", "cannot be read",
                  "give a file that ppm-vk bench --json wrote");
  }
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return parse_results(text, file.string());
}

}  // namespace ppm::bench
