// Rows in the making: repetition after repetition adds its values.
#pragma once

#include <list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results.hpp"

namespace ppm::bench {

class RowSet {
 public:
  /// Adds a repetition to the row of that name, which is made where there is none yet. References
  /// stay valid.
  Row& add(const std::string& name, double seconds,
           std::optional<double> cpu_seconds = std::nullopt);
  /// Adds a value of the same repetition.
  void count(Row& row, const std::string& counter, double value);

  /// All rows, in the order in which they were made. One that lacks a repetition (a kernel that did
  /// not run every time) keeps what it has.
  std::vector<Row> take();

 private:
  std::list<Row> rows_;
  std::map<std::string, Row*> by_name_;
};

}  // namespace ppm::bench
