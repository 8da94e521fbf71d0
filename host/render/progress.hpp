// How far a rendering is, told on stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "integrator.hpp"
#include "log.hpp"

namespace ppm::render {

/// One line that is rewritten when stderr is a terminal, at most ten times a second; else a plain
/// line once passes 1, 2, 4, 8 ... and the last are done, and whenever ten seconds went by without
/// one. Silent when the log is quiet.
class Progress {
 public:
  /// `passes` there will be, if that is known.
  Progress(const Log& log, std::optional<std::uint64_t> passes, std::uint64_t pixels);
  /// Ends the rewritten line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The work before the first pass has begun.
  void preparing();
  /// It has ended: passes are timed from here.
  void passing();
  /// What has been done so far. `seconds_left`: of the time that was given, if any was; `last`: no
  /// pass will follow.
  void passed(const Statistics& statistics, std::optional<double> seconds_left, bool last);

 private:
  using Clock = std::chrono::steady_clock;
  void rewrite(const std::string& text);

  bool silent_, terminal_, line_open_ = false;
  std::optional<std::uint64_t> passes_;
  std::uint64_t pixels_;
  std::uint64_t milestone_ = 1;  // passes at which a plain line is due
  Clock::time_point start_, last_;
};

/// "passes", "samples" or "mutations": what this method's passes are called.
const char* pass_names(const Statistics& statistics);
/// "1.25M", "310k", "42": three digits at most before the unit.
std::string short_count(double count);
/// "0:07", "12:34", "3:00:09".
std::string clock_time(double seconds);

}  // namespace ppm::render
