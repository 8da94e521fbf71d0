#include "machine_memory.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace ppm {
namespace {

constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

std::optional<std::uint64_t> first_number(const std::string& text) {
  const std::size_t digits = text.find_first_of("0123456789");
  if (digits == std::string::npos) return std::nullopt;
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data() + digits, text.data() + text.size(), value);
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

/// The number on the first line of `file` that begins with `key`.
std::optional<std::uint64_t> number_at(const std::filesystem::path& file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(key)) return first_number(line.substr(key.size()));
  }
  return std::nullopt;
}

/// Version 2 or 1, as a container sees its own group. What is only cached can be given back.
std::uint64_t left_in_group(const std::filesystem::path& group, const char* limit, const char* used,
                            const char* reclaimable) {
  const auto most = number_at(group / limit, "");
  const auto now = number_at(group / used, "");
  if (!most || !now) return kUnknown;
  const std::uint64_t cached = number_at(group / "memory.stat", reclaimable).value_or(0);
  const std::uint64_t held = *now > cached ? *now - cached : 0;
  return *most > held ? *most - held : 0;
}

}  // namespace

std::uint64_t available_memory(const std::filesystem::path& root) {
  std::uint64_t bytes = kUnknown;
  if (const auto kilobytes = number_at(root / "proc/meminfo", "MemAvailable:")) {
    bytes = *kilobytes * 1024;
  }
  const std::filesystem::path groups = root / "sys/fs/cgroup";
  bytes = std::min(bytes, left_in_group(groups, "memory.max", "memory.current", "inactive_file "));
  return std::min(bytes, left_in_group(groups / "memory", "memory.limit_in_bytes",
                                       "memory.usage_in_bytes", "total_inactive_file "));
}

}  // namespace ppm
