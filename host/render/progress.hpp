// How far a rendering is, told on stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "integrator.hpp"
#include "log.hpp"
#include "picture_change.hpp"

namespace ppm::render {

enum class ProgressStyle {
  text,  ///< for people
  json,  ///< an object a line, whether the log is quiet or not
};

/// Text: one line that is rewritten when stderr is a terminal, at most ten times a second; else a
/// plain line once passes 1, 2, 4, 8 ... and the last are done, and whenever ten seconds went by
/// without one; silent when the log is quiet. JSON: a line for each of these passes, and otherwise
/// at most ten a second.
class Progress {
 public:
  /// What there is to tell between two passes.
  struct Moment {
    double seconds = 0.0;                ///< of rendering
    std::optional<double> seconds_left;  ///< of the time that was given, if any was
    std::optional<ChangeMeter::Change> change;
    bool last = false;  ///< no pass will follow
  };

  /// `passes` there will be, if that is known.
  Progress(const Log& log, ProgressStyle style, std::optional<std::uint64_t> passes,
           std::uint64_t pixels);
  ~Progress() { end(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  bool silent() const { return silent_; }
  /// The work before the first pass has begun.
  void preparing();
  /// It has ended: passes are timed from here, where so much was done already.
  void passing(const Statistics& statistics);
  void passed(const Statistics& statistics, const Moment& moment);
  /// Ends the rewritten line, so that others can write.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  bool due(std::uint64_t passes, bool last);
  void tell(const std::string& text);

  bool silent_, terminal_, json_, line_open_ = false;
  std::optional<std::uint64_t> passes_;
  std::uint64_t pixels_;
  std::uint64_t passes_before_ = 0;
  double count_before_ = 0.0;    // of what the rate is of
  std::uint64_t milestone_ = 1;  // passes at which a line is due
  Clock::time_point start_, last_;
};

/// "passes", "samples" or "mutations": what this method's passes are called.
const char* pass_names(const Statistics& statistics);
/// "1.25M", "310k", "42": three digits at most before the unit.
std::string short_count(double count);
/// "0:07", "12:34", "3:00:09".
std::string clock_time(double seconds);

}  // namespace ppm::render
