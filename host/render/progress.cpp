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

}  // namespace

Progress::Progress(const Log& log, std::uint64_t passes)
    : silent_(log.verbosity() == Verbosity::quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      passes_(passes) {}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stderr);
}

void Progress::preparing() {
  if (!silent_ && terminal_) rewrite("preparing");
}

void Progress::passing() {
  start_ = Clock::now();
}

void Progress::passed(std::uint64_t passes_done, std::uint64_t photons) {
  if (silent_) return;
  const Clock::time_point now = Clock::now();
  const bool last_pass = passes_done == passes_;
  const bool due = last_pass || now - last_ >= (terminal_ ? Clock::duration(kRewriteInterval)
                                                          : Clock::duration(kPlainInterval));
  if (!due && (terminal_ || !std::has_single_bit(passes_done))) return;
  last_ = now;

  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double done = static_cast<double>(passes_done);
  const double left = seconds / done * (static_cast<double>(passes_) - done);
  const std::string text =
      fmt::format("pass {} of {}, {} photons/s, {} {}", passes_done, passes_,
                  short_count(static_cast<double>(photons) / std::max(seconds, 1e-9)),
                  clock_time(last_pass ? seconds : left), last_pass ? "in all" : "left");
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
