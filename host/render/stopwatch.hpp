// Wall time, for reports.
#pragma once

#include <chrono>

namespace ppm::render {

inline double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Adds the time it lives to `total`.
class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total), start_(clock_seconds()) {}
  ~Stopwatch() { total_ += clock_seconds() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_;
  double start_;
};

}  // namespace ppm::render
