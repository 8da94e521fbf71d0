// What is asked of the machine that the benchmark runs on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ppm::bench {

/// A cache of the first processor.
struct Cache {
  std::string type;  ///< Data, Instruction or Unified
  int level = 0;
  std::uint64_t bytes = 0;
  int sharing = 0;  ///< processors that share it
};

/// What cannot be found out is empty or 0.
struct Machine {
  std::string date;  ///< local time with its offset, ISO 8601
  std::string host_name, executable;
  unsigned processors = 0;
  int megahertz = 0;
  bool scaling_enabled = false;  ///< the processor's speed follows the load
  std::vector<Cache> caches;
  std::vector<double> load_average;  ///< over 1, 5 and 15 minutes
};

Machine describe_machine();

/// Processor time that this process has used, all threads, seconds.
double processor_seconds();

/// Most memory that this process has held at one time, bytes, since it began or since the last
/// forget_peak_memory, where the system lets that be forgotten.
std::uint64_t peak_memory_bytes();
void forget_peak_memory();

}  // namespace ppm::bench
