#include "machine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

namespace ppm::bench {
namespace {

namespace fs = std::filesystem;

const fs::path kProcessors = "/sys/devices/system/cpu";

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// What follows "KEY" and a colon in a file of such lines.
std::optional<std::string> value_of(const fs::path& file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (line.starts_with(key) && colon != std::string::npos) return line.substr(colon + 1);
  }
  return std::nullopt;
}

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S%z", &parts);
  std::string result = text.data();
  if (result.size() > 2) result.insert(result.size() - 2, ":");
  return result;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

int megahertz() {
  const std::string highest = first_line(kProcessors / "cpu0/cpufreq/cpuinfo_max_freq");
  if (!highest.empty()) return std::atoi(highest.c_str()) / 1000;
  return static_cast<int>(
      std::lround(std::atof(value_of("/proc/cpuinfo", "cpu MHz").value_or("0").c_str())));
}

/// "0,4-7" names five.
int count_listed(const std::string& list) {
  int count = 0;
  const char* at = list.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    const long first = std::strtol(at, &end, 10);
    if (end == at) return count;
    long last = first;
    if (*end == '-') last = std::strtol(end + 1, &end, 10);
    count += static_cast<int>(last - first + 1);
    at = *end == ',' ? end + 1 : end;
  }
  return count;
}

std::vector<Cache> caches() {
  std::vector<Cache> list;
  for (int i = 0; i < 16; ++i) {
    const fs::path folder = kProcessors / ("cpu0/cache/index" + std::to_string(i));
    const std::string type = first_line(folder / "type");
    if (type.empty()) break;
    const std::string size = first_line(folder / "size");  // "32K"
    const std::uint64_t unit = size.ends_with('K') ? 1024 : size.ends_with('M') ? 1u << 20 : 1;
    list.push_back({type, std::atoi(first_line(folder / "level").c_str()),
                    std::strtoull(size.c_str(), nullptr, 10) * unit,
                    count_listed(first_line(folder / "shared_cpu_list"))});
  }
  return list;
}

}  // namespace

Machine describe_machine() {
  Machine machine;
  machine.date = local_time();
  machine.host_name = host_name();
  std::error_code ignored;
  machine.executable = fs::read_symlink("/proc/self/exe", ignored).string();
  machine.processors = std::thread::hardware_concurrency();
  machine.megahertz = megahertz();
  const std::string governor = first_line(kProcessors / "cpu0/cpufreq/scaling_governor");
  machine.scaling_enabled = !governor.empty() && governor != "performance";
  machine.caches = caches();
  std::array<double, 3> load{};
  const int loads = getloadavg(load.data(), 3);
  for (int i = 0; i < loads; ++i) machine.load_average.push_back(load[static_cast<std::size_t>(i)]);
  return machine;
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t peak_memory_bytes() {
  if (const auto kilobytes = value_of("/proc/self/status", "VmHWM")) {
    return std::strtoull(kilobytes->c_str(), nullptr, 10) * 1024;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void forget_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace ppm::bench
