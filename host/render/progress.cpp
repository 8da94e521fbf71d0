#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace ppm::render {
namespace {

constexpr std::chrono::milliseconds kRewriteInterval{100};
constexpr std::chrono::seconds kPlainInterval{10};

/// What a method does most of, and what it calls a pass.
struct Rate {
  const char* one;
  const char* many;
  double count;
  bool of_each_pixel;
};

Rate rate_of(const Statistics& statistics) {
  if (statistics.mutations > 0) {
    return {"mutation", "mutations", static_cast<double>(statistics.mutations), true};
  }
  if (statistics.samples > 0) {
    return {"sample", "samples", static_cast<double>(statistics.samples), true};
  }
  return {"pass", "photons", static_cast<double>(statistics.photons_emitted), false};
}

}  // namespace

Progress::Progress(const Log& log, std::optional<std::uint64_t> passes, std::uint64_t pixels)
    : silent_(log.verbosity() == Verbosity::quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      passes_(passes),
      pixels_(pixels) {}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stderr);
}

void Progress::preparing() {
  if (!silent_ && terminal_) rewrite("preparing");
}

void Progress::passing() {
  start_ = Clock::now();
}

void Progress::passed(const Statistics& statistics, std::optional<double> seconds_left, bool last) {
  if (silent_) return;
  const std::uint64_t passes_done = statistics.passes;
  const Clock::time_point now = Clock::now();
  const bool due = last || now - last_ >= (terminal_ ? Clock::duration(kRewriteInterval)
                                                     : Clock::duration(kPlainInterval));
  const bool milestone = !terminal_ && passes_done >= milestone_;
  if (!due && !milestone) return;
  last_ = now;
  milestone_ = 2 * std::bit_floor(passes_done);

  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double done = static_cast<double>(passes_done);
  double left = seconds_left.value_or(1e9);
  if (passes_) left = std::min(left, seconds / done * (static_cast<double>(*passes_) - done));
  const Rate rate = rate_of(statistics);
  const double a_second = rate.count * (rate.of_each_pixel ? static_cast<double>(pixels_) : 1.0) /
                          std::max(seconds, 1e-9);
  const bool open = !passes_ && !seconds_left;  // until the method is complete
  const std::string text =
      fmt::format("{} {}{}, {} {}/s, {} {}", rate.one, passes_done,
                  passes_ ? fmt::format(" of {}", *passes_) : "", short_count(a_second), rate.many,
                  clock_time(last || open ? seconds : left),
                  last   ? "in all"
                  : open ? "so far"
                         : "left");
  if (terminal_) {
    rewrite(text);
  } else {
    std::fprintf(stderr, "ppm-vk: %s\n", text.c_str());
  }
}

void Progress::rewrite(const std::string& text) {
  std::fprintf(stderr, "\rppm-vk: %s\x1b[K", text.c_str());
  std::fflush(stderr);
  line_open_ = true;
}

const char* pass_names(const Statistics& statistics) {
  const Rate rate = rate_of(statistics);
  return rate.of_each_pixel ? rate.many : "passes";
}

std::string short_count(double count) {
  if (count >= 999.5e6) return fmt::format("{:.3g}G", count / 1e9);
  if (count >= 999.5e3) return fmt::format("{:.3g}M", count / 1e6);
  if (count >= 999.5) return fmt::format("{:.3g}k", count / 1e3);
  return fmt::format("{:.3g}", count);
}

std::string clock_time(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::llround(std::clamp(seconds, 0.0, 1e9)));
  const std::uint64_t minutes = whole / 60;
  if (minutes < 60) return fmt::format("{}:{:02}", minutes, whole % 60);
  return fmt::format("{}:{:02}:{:02}", minutes / 60, minutes % 60, whole % 60);
}

}  // namespace ppm::render
