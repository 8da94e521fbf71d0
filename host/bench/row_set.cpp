#include "row_set.hpp"

#include <utility>

namespace ppm::bench {

Row& RowSet::add(const std::string& name, double seconds, std::optional<double> cpu_seconds) {
  Row*& row = by_name_[name];
  if (!row) {
    row = &rows_.emplace_back();
    row->name = name;
  }
  row->seconds.push_back(seconds);
  if (cpu_seconds) row->cpu_seconds.push_back(*cpu_seconds);
  return *row;
}

void RowSet::count(Row& row, const std::string& counter, double value) {
  row.counters[counter].push_back(value);
}

std::vector<Row> RowSet::take() {
  by_name_.clear();
  return {std::make_move_iterator(rows_.begin()), std::make_move_iterator(rows_.end())};
}

}  // namespace ppm::bench
