#include "info_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "checkpoint.hpp"
#include "exit_code.hpp"
#include "picture_facts.hpp"

namespace ppm::cli {
namespace {

using Json = nlohmann::ordered_json;

bool is_exr(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".exr";
}

Json checkpoint_json(const render::Checkpoint& checkpoint) {
  const render::Statistics& statistics = checkpoint.statistics;
  return {{"kind", "checkpoint"},          {"program", checkpoint.program},
          {"scene", checkpoint.scene},     {"integrator", checkpoint.integrator},
          {"device", checkpoint.device},   {"driver", checkpoint.driver},
          {"width", checkpoint.width},     {"height", checkpoint.height},
          {"passes", statistics.passes},   {"photons_emitted", statistics.photons_emitted},
          {"samples", statistics.samples}, {"mutations", statistics.mutations},
          {"seconds", checkpoint.seconds}, {"state_bytes", checkpoint.state.size()},
          {"options", checkpoint.words}};
}

Json picture_json(const image::PictureFacts& facts) {
  Json json = {{"kind", "picture"}, {"width", facts.width}, {"height", facts.height}};
  for (const auto& [name, type] : facts.channels) json["channels"][name] = type;
  for (const auto& [name, value] : facts.attributes) {
    Json& entry = json[name.substr(name.find(':') + 1)];
    std::visit([&](const auto& held) { entry = held; }, value);
    // EXR has no whole numbers as large as a seed.
    if (entry.is_number_float() && entry.get<double>() == std::floor(entry.get<double>())) {
      if (std::abs(entry.get<double>()) < 0x1p53) entry = entry.get<std::int64_t>();
    }
  }
  return json;
}

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, entry] : value.items()) {
    if (!text.empty()) text += " ";
    text += value.is_object() ? fmt::format("{} ({})", key, text_of(entry)) : text_of(entry);
  }
  return text;
}

/// A line for each entry, with nothing in it that a terminal would obey.
std::string lines_of(const Json& json) {
  std::string text;
  for (const auto& [key, value] : json.items()) {
    std::string line = fmt::format("{:<20}{}", key, text_of(value));
    std::ranges::replace_if(
        line, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    text += line + "\n";
  }
  return text;
}

}  // namespace

int info_command(const InfoOptions& options) {
  const Json json = is_exr(options.file) ? picture_json(image::read_facts(options.file))
                                         : checkpoint_json(render::read_checkpoint(options.file));
  // Names come from files: what is no UTF-8 is replaced, not thrown at.
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  std::fputs((options.json ? text : lines_of(json)).c_str(), stdout);
  return kDone;
}

}  // namespace ppm::cli
