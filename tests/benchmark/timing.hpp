// What all parts measure with.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace ppm::benchmark {

inline constexpr int kRepeats = 5;
inline constexpr int kRayRepeats = 11;  ///< of what takes some ten milliseconds

inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

template <typename Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace ppm::benchmark
