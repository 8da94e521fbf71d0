#include "report_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "failure.hpp"
#include "output_file.hpp"

namespace ppm::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIdentity = "comparison.json";
constexpr const char* kRecord = "run.json";
constexpr const char* kAnother = "name another folder, or give the options it was made with";

[[noreturn]] void fail(const fs::path& path, const char* what, const std::error_code& error) {
  throw Failure(path.string(), what, error.message(), "name a folder that can be written");
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail(path, "cannot create the folder", error);
}

void remove_tree(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) fail(path, "cannot remove", error);
}

/// What the folder was made for.
Options read_identity(const fs::path& file) {
  try {
    std::ifstream stream(file, std::ios::binary);
    return nlohmann::json::parse(stream).get<Options>();
  } catch (const nlohmann::json::exception&) {
    throw Failure(file.string(), "", "no comparison", "name another folder");
  }
}

/// So that a rename outlives a power failure.
void sync_folder(const fs::path& path) {
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  fsync(folder);
  close(folder);
}

}  // namespace

ReportFolder::ReportFolder(const fs::path& path, const Options& identity) : path_(path) {
  make_folder(path_);
  const fs::path file = path_ / kIdentity;
  const bool is_known = fs::exists(file);
  if (!is_known && !fs::is_empty(path_)) {
    throw Failure(path_.string(), "", "is not empty and holds no comparison",
                  "name another folder");
  }
  if (is_known) {
    const std::string difference = difference_of(read_identity(file), identity);
    if (!difference.empty()) {
      throw Failure(path_.string(), "holds another comparison", difference, kAnother);
    }
  }
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) fail(path_, "cannot open", {errno, std::generic_category()});
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    close(lock_);
    throw Failure(path_.string(), "", "another comparison is writing it", "wait for its end");
  }
  try {
    if (!is_known) {
      const nlohmann::json json = identity;
      write_whole(file, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    }
    check_creatable(file);
    make_folder(path_ / "runs");
  } catch (...) {
    close(lock_);
    throw;
  }
}

ReportFolder::~ReportFolder() {
  close(lock_);
}

fs::path ReportFolder::run_folder(const std::string& name) const {
  return path_ / "runs" / name;
}

std::optional<RunRecord> ReportFolder::find(const std::string& name,
                                            const RunRecord& wanted) const {
  const fs::path folder = run_folder(name);
  if (!fs::exists(folder)) return std::nullopt;
  RunRecord record = read_record(folder / kRecord);
  std::string difference = difference_of(record.options, wanted.options);
  if (difference.empty() && record.budget_seconds != wanted.budget_seconds) {
    difference =
        fmt::format("{:.6g} s instead of {:.6g} s", record.budget_seconds, wanted.budget_seconds);
  }
  if (!difference.empty()) {
    throw Failure(folder.string(), "was rendered with other options", difference, kAnother);
  }
  for (const KeptPicture& picture : record.pictures) {
    if (!fs::exists(folder / picture.file)) {
      throw Failure((folder / picture.file).string(), "", "is missing",
                    "remove its folder to have it rendered again");
    }
  }
  return record;
}

std::optional<RunRecord> ReportFolder::add(
    const std::string& name,
    const std::function<std::optional<RunRecord>(const fs::path&)>& make) const {
  const fs::path part = path_ / "runs" / ("." + name + ".part");
  remove_tree(part);
  make_folder(part);
  std::optional<RunRecord> record;
  try {
    record = make(part);
    if (record) write_whole(part / kRecord, record_json(*record));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
  if (!record) {
    remove_tree(part);
    return std::nullopt;
  }
  sync_folder(part);
  std::error_code error;
  fs::rename(part, run_folder(name), error);
  if (error) fail(run_folder(name), "cannot create", error);
  sync_folder(path_ / "runs");
  return record;
}

}  // namespace ppm::compare
