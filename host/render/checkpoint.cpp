#include "checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "failure.hpp"
#include "sealed_file.hpp"

namespace ppm::render {
namespace {

using Json = nlohmann::ordered_json;

enum Section : std::size_t { kFacts, kWords, kPassSeconds, kState, kSections };

constexpr SealedKind kKind{"checkpoint of ppm-vk",
                           {'p', 'p', 'm', '-', 'v', 'k', ' ',  'c',  'h',    'e', 'c',
                            'k', 'p', 'o', 'i', 'n', 't', '\r', '\n', '\x1a', '\n'},
                           1,
                           kSections};

/// Calls `visit(name, member)` for each whole number and each length of the statistics.
template <class S, class Visit>
void for_each_number(S& statistics, const Visit& visit) {
  visit("triangles", statistics.triangles);
  visit("lights", statistics.lights);
  visit("hit_points", statistics.hit_points);
  visit("tiles", statistics.tiles);
  visit("passes", statistics.passes);
  visit("photons_emitted", statistics.photons_emitted);
  visit("photons_stored", statistics.photons_stored);
  visit("samples", statistics.samples);
  visit("mutations", statistics.mutations);
  visit("eye_rays", statistics.eye_rays);
  visit("photon_rays", statistics.photon_rays);
  visit("initial_radius_min", statistics.initial_radius_min);
  visit("initial_radius_median", statistics.initial_radius_median);
  visit("initial_radius_max", statistics.initial_radius_max);
  visit("map_photons", statistics.map_photons);
  visit("nearest_radius_min", statistics.nearest_radius_min);
  visit("nearest_radius_median", statistics.nearest_radius_median);
  visit("nearest_radius_max", statistics.nearest_radius_max);
  visit("paths_cut", statistics.paths_cut);
}

std::string facts_text(const Checkpoint& checkpoint) {
  Json json;
  json["program"] = checkpoint.program;
  json["device"] = checkpoint.device;
  json["driver"] = checkpoint.driver;
  json["scene"] = checkpoint.scene;
  json["integrator"] = checkpoint.integrator;
  json["width"] = checkpoint.width;
  json["height"] = checkpoint.height;
  for (const PartHash& part : checkpoint.parts) {
    json["parts"].push_back({{"part", part.part}, {"hash", part.value}});
  }
  json["seconds"] = checkpoint.seconds;
  const Statistics& statistics = checkpoint.statistics;
  Json& numbers = json["statistics"];
  for_each_number(statistics, [&](const char* name, const auto& value) { numbers[name] = value; });
  numbers["rejected"] = statistics.rejected;
  numbers["seconds"] = statistics.seconds;
  numbers["kernel_seconds"] = statistics.kernel_seconds;
  // Names come from files and drivers: what is no UTF-8 is replaced, not thrown at.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void read_facts(const std::vector<std::uint8_t>& bytes, Checkpoint& checkpoint) {
  const Json json = Json::parse(bytes.begin(), bytes.end());
  json.at("program").get_to(checkpoint.program);
  json.at("device").get_to(checkpoint.device);
  json.at("driver").get_to(checkpoint.driver);
  json.at("scene").get_to(checkpoint.scene);
  json.at("integrator").get_to(checkpoint.integrator);
  json.at("width").get_to(checkpoint.width);
  json.at("height").get_to(checkpoint.height);
  for (const Json& part : json.at("parts")) {
    checkpoint.parts.push_back(
        {part.at("part").get<std::string>(), part.at("hash").get<std::uint64_t>()});
  }
  json.at("seconds").get_to(checkpoint.seconds);
  Statistics& statistics = checkpoint.statistics;
  const Json& numbers = json.at("statistics");
  for_each_number(statistics,
                  [&](const char* name, auto& value) { numbers.at(name).get_to(value); });
  numbers.at("rejected").get_to(statistics.rejected);
  numbers.at("seconds").get_to(statistics.seconds);
  numbers.at("kernel_seconds").get_to(statistics.kernel_seconds);
}

/// Each with a zero byte behind it.
std::string words_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text.append(word).push_back('\0');
  return text;
}

std::vector<std::string> read_words(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::string> words;
  auto begin = bytes.begin();
  for (auto at = bytes.begin(); at != bytes.end(); ++at) {
    if (*at != 0) continue;
    words.emplace_back(begin, at);
    begin = at + 1;
  }
  return words;
}

std::string_view view(const auto& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]};
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  const std::string facts = facts_text(checkpoint);
  const std::string words = words_text(checkpoint.words);
  const std::string_view sections[kSections] = {
      facts, words, view(checkpoint.statistics.pass_seconds), view(checkpoint.state)};
  write_sealed(file, kKind, sections);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  const SealedFile sealed(file, kKind);
  Checkpoint checkpoint;
  try {
    read_facts(sealed.read(kFacts), checkpoint);
  } catch (const nlohmann::json::exception& error) {
    throw Failure(file.string(), "is a checkpoint that makes no sense", error.what(),
                  "use another one or render anew");
  }
  checkpoint.words = read_words(sealed.read(kWords));
  const std::vector<std::uint8_t> seconds = sealed.read(kPassSeconds);
  std::vector<double>& pass_seconds = checkpoint.statistics.pass_seconds;
  pass_seconds.resize(seconds.size() / sizeof pass_seconds[0]);
  if (!pass_seconds.empty()) {
    std::memcpy(pass_seconds.data(), seconds.data(), pass_seconds.size() * sizeof pass_seconds[0]);
  }
  checkpoint.state = sealed.read(kState);
  return checkpoint;
}

void check_continues(const std::filesystem::path& file, const Checkpoint& checkpoint,
                     const std::string& program, const std::vector<PartHash>& parts) {
  if (checkpoint.program != program) {
    throw Failure(file.string(), "",
                  fmt::format("was written by {}, this is {}", checkpoint.program, program),
                  "use the program that wrote it or render anew");
  }
  std::string changed;
  for (const PartHash& part : parts) {
    if (std::ranges::find(checkpoint.parts, part) != checkpoint.parts.end()) continue;
    changed += (changed.empty() ? "" : ", ") + part.part;
  }
  if (changed.empty() && checkpoint.parts.size() == parts.size()) return;
  throw Failure(file.string(), "",
                fmt::format("the scene {} has changed since: {}", checkpoint.scene, changed),
                "bring the old one back or render anew");
}

void check_device(const std::filesystem::path& file, const Checkpoint& checkpoint,
                  const std::string& device, const std::string& driver) {
  if (checkpoint.device == device && checkpoint.driver == driver) return;
  throw Failure(file.string(), "",
                fmt::format("was rendered on {}, {}; this is {}, {}", checkpoint.device,
                            checkpoint.driver, device, driver),
                "choose that one with --device or render anew");
}

}  // namespace ppm::render
