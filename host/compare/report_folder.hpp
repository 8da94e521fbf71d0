// The folder of a comparison: what belongs to it, and what of it is there already.
//
// REPORT/comparison.json     what all its renderings have in common
// REPORT/runs/NAME/          a rendering: run.json and its pictures; appears whole or not at all
// REPORT/runs/.NAME.part/    one in the making, which is begun anew
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "run_record.hpp"

namespace ppm::compare {

class ReportFolder {
 public:
  /// Makes the folder, or takes up one whose `identity` (scene, device, size ...) is the same.
  /// Throws Failure where it is of another comparison, holds anything else, cannot be written or is
  /// in use by another process. `identity` names what must be equal.
  ReportFolder(const std::filesystem::path& path, const Options& identity);
  ~ReportFolder();
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path run_folder(const std::string& name) const;

  /// The rendering of that name, if it is there. Throws Failure where it was made otherwise than
  /// `wanted` says (options and budget_seconds).
  std::optional<RunRecord> find(const std::string& name, const RunRecord& wanted) const;

  /// Has `make` fill a folder with pictures and adds the record that it returns; all of it appears
  /// at once. Nothing is left where it returns nothing or throws.
  std::optional<RunRecord> add(
      const std::string& name,
      const std::function<std::optional<RunRecord>(const std::filesystem::path&)>& make) const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace ppm::compare
