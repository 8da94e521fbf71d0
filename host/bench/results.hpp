// What a benchmark found, as plain values: what is printed, written, read back and compared.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ppm::bench {

/// One thing that was timed, and what was counted beside it.
struct Row {
  std::string name;              ///< "room/pass", "room/kernel:gather"; unique
  std::uint64_t iterations = 1;  ///< that each of the times is the mean of
  std::vector<double> seconds;   ///< one entry a repetition, never empty
  /// Of the processor; as many, or none where only the device's clock saw it.
  std::vector<double> cpu_seconds;
  /// By name, one entry a repetition. A name that ends in `_per_second` is a rate (more is better),
  /// in `_memory_bytes` an amount of memory (less is better); "share" is the part that the row has
  /// of the whole it belongs to; all others tell what was measured.
  std::map<std::string, std::vector<double>> counters;
};

/// Where and how, by name, as text.
using Context = std::map<std::string, std::string>;

struct Results {
  Context context;
  std::vector<Row> rows;

  /// The row of that name, or null.
  const Row* find(const std::string& name) const;
};

enum class Quantity { time, rate, memory };

/// One number of a row that can be better or worse.
struct Figure {
  std::string name;  ///< that of the row, for rates and memory with the counter's: "room/pass X"
  Quantity quantity = Quantity::time;
  double value = 0.0;  ///< median; seconds, 1/s or bytes
  double share = 1.0;  ///< median of the row's share; 1 where it is a whole
};

/// All figures of the results, in their order.
std::vector<Figure> figures(const Results& results);

}  // namespace ppm::bench
