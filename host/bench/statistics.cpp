#include "statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "failure.hpp"

namespace ppm::bench {

double mean(const std::vector<double>& values) {
  PPM_ASSERT(!values.empty(), "no values");
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  PPM_ASSERT(!values.empty(), "no values");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double median_absolute_deviation(const std::vector<double>& values) {
  const double centre = median(values);
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - centre));
  return median(distances);
}

double least(const std::vector<double>& values) {
  PPM_ASSERT(!values.empty(), "no values");
  return *std::min_element(values.begin(), values.end());
}

double most(const std::vector<double>& values) {
  PPM_ASSERT(!values.empty(), "no values");
  return *std::max_element(values.begin(), values.end());
}

}  // namespace ppm::bench
