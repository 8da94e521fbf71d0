// How far a rendering is, told on stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "log.hpp"

namespace ppm::render {

/// One line that is rewritten when stderr is a terminal, at most ten times a second; else a plain
/// line after passes 1, 2, 4, 8 ... and the last, and whenever ten seconds went by without one.
/// Silent when the log is quiet.
class Progress {
 public:
  Progress(const Log& log, std::uint64_t passes);
  /// Ends the rewritten line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The work before the first pass has begun.
  void preparing();
  /// It has ended: passes are timed from here.
  void passing();
  /// `passes_done` passes have emitted `photons` photons in all.
  void passed(std::uint64_t passes_done, std::uint64_t photons);

 private:
  using Clock = std::chrono::steady_clock;
  void rewrite(const std::string& text);

  bool silent_, terminal_, line_open_ = false;
  std::uint64_t passes_;
  Clock::time_point start_, last_;
};

/// "1.25M", "310k", "42": three digits at most before the unit.
std::string short_count(double count);
/// "0:07", "12:34", "3:00:09".
std::string clock_time(double seconds);

}  // namespace ppm::render
