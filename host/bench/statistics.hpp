// What a handful of measurements says: where they lie and how far they spread.
#pragma once

#include <vector>

namespace ppm::bench {

/// All take at least one value. `median` is the mean of the two in the middle where their number is
/// even; `standard_deviation` divides by n - 1 and is 0 for one value.
double mean(const std::vector<double>& values);
double median(std::vector<double> values);
double standard_deviation(const std::vector<double>& values);
/// Median of the distances from the median.
double median_absolute_deviation(const std::vector<double>& values);
double least(const std::vector<double>& values);
double most(const std::vector<double>& values);

}  // namespace ppm::bench
