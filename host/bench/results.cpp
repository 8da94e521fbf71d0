#include "results.hpp"

#include <algorithm>
#include <optional>

#include "statistics.hpp"

namespace ppm::bench {
namespace {

std::optional<Quantity> quantity_of(const std::string& counter) {
  if (counter.ends_with("_per_second")) return Quantity::rate;
  if (counter.ends_with("_memory_bytes")) return Quantity::memory;
  return std::nullopt;
}

}  // namespace

const Row* Results::find(const std::string& name) const {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const Row& each) { return each.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

std::vector<Figure> figures(const Results& results) {
  std::vector<Figure> list;
  for (const Row& row : results.rows) {
    const auto entry = row.counters.find("share");
    const double share = entry == row.counters.end() ? 1.0 : median(entry->second);
    list.push_back({row.name, Quantity::time, median(row.seconds), share});
    for (const auto& [counter, values] : row.counters) {
      if (const auto quantity = quantity_of(counter)) {
        list.push_back({row.name + " " + counter, *quantity, median(values), share});
      }
    }
  }
  return list;
}

}  // namespace ppm::bench
