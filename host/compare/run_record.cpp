#include "run_record.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "failure.hpp"

namespace ppm::compare {

// Names in the file are those of the members.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(KeptPicture, file, seconds, resolve_seconds, passes, samples,
                                   mutations, photons_emitted, photons_stored, rays)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunRecord, label, seed, options, budget_seconds, start_seconds,
                                   prepare_seconds, complete, pictures, hit_points, paths_cut,
                                   initial_radius, rejected, warnings)

std::string record_json(const RunRecord& record) {
  const nlohmann::json json = record;
  // Names come from files and drivers: what is no UTF-8 is replaced, not thrown at.
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

RunRecord read_record(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& why) {
    return Failure(file.string(), "", why, "remove its folder to have it rendered again");
  };
  try {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw refuse("cannot be read");
    RunRecord record = nlohmann::json::parse(stream).get<RunRecord>();
    if (record.pictures.empty()) throw refuse("no record of a rendering");
    for (const KeptPicture& picture : record.pictures) {
      // A name of the same folder, whatever the file says.
      if (std::filesystem::path(picture.file).filename().string() != picture.file) {
        throw refuse("no record of a rendering");
      }
    }
    return record;
  } catch (const nlohmann::json::exception&) {
    throw refuse("no record of a rendering");
  }
}

std::string difference_of(const Options& found, const Options& wanted) {
  for (const auto& [name, value] : wanted) {
    const auto entry = found.find(name);
    if (entry == found.end()) return fmt::format("no {} instead of {}", name, value);
    if (entry->second != value) {
      return fmt::format("{} {} instead of {}", name, entry->second, value);
    }
  }
  for (const auto& [name, value] : found) {
    if (!wanted.contains(name)) return fmt::format("{} {} instead of none", name, value);
  }
  return "";
}

}  // namespace ppm::compare
