#include "progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

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

/// So that a line of the terminal does not become two, of which only the second is rewritten.
std::string cut_to_terminal(std::string text) {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    text.resize(std::min<std::size_t>(text.size(), size.ws_col - 1u));
  }
  return text;
}

/// What is known of a moment, whoever is told.
struct State {
  Rate rate;
  double a_second = 0.0;
  std::optional<double> seconds_left;
};

std::string text_of(const Statistics& statistics, const std::optional<std::uint64_t>& passes,
                    const State& state, const Progress::Moment& moment) {
  const Rate& rate = state.rate;
  std::string text = fmt::format("{} {}{}, ", rate.one, statistics.passes,
                                 passes ? fmt::format(" of {}", *passes) : "");
  if (!rate.of_each_pixel) text += fmt::format("{} {}, ", short_count(rate.count), rate.many);
  text += fmt::format("{} {}/s, {} {}", short_count(state.a_second), rate.many,
                      clock_time(moment.seconds), moment.last ? "in all" : "so far");
  if (!moment.last && state.seconds_left) {
    text += fmt::format(", {} left", clock_time(*state.seconds_left));
  }
  if (moment.change) text += fmt::format(", change {:.2g} %", 100.0 * moment.change->value);
  return text;
}

std::string json_of(const Statistics& statistics, const std::optional<std::uint64_t>& passes,
                    const State& state, const Progress::Moment& moment) {
  nlohmann::ordered_json json;
  json["stage"] = moment.last ? "done" : "passes";
  json["passes"] = statistics.passes;
  if (passes) json["passes_wanted"] = *passes;
  json["photons"] = statistics.photons_emitted;
  json["samples"] = statistics.samples;
  json["mutations"] = statistics.mutations;
  json[fmt::format("{}_per_second", state.rate.many)] = state.a_second;
  json["seconds"] = moment.seconds;
  if (state.seconds_left) json["seconds_left"] = std::max(0.0, *state.seconds_left);
  if (moment.change) {
    json["change"] = moment.change->value;
    json["change_since"] = moment.change->since;
  }
  return json.dump();
}

}  // namespace

Progress::Progress(const Log& log, ProgressStyle style, std::optional<std::uint64_t> passes,
                   std::uint64_t pixels)
    : silent_(log.verbosity() == Verbosity::quiet && style != ProgressStyle::json),
      terminal_(isatty(STDERR_FILENO) == 1 && style != ProgressStyle::json),
      json_(style == ProgressStyle::json),
      passes_(passes),
      pixels_(pixels) {}

void Progress::end() {
  if (line_open_) std::fputc('\n', stderr);
  line_open_ = false;
}

void Progress::preparing() {
  if (json_) tell(R"({"stage":"preparing"})");
  if (!silent_ && terminal_) tell("preparing");
}

void Progress::passing(const Statistics& statistics) {
  start_ = Clock::now();
  passes_before_ = statistics.passes;
  count_before_ = rate_of(statistics).count;
}

bool Progress::due(std::uint64_t passes, bool last) {
  if (silent_) return false;
  const Clock::time_point now = Clock::now();
  const Clock::duration interval =
      terminal_ || json_ ? Clock::duration(kRewriteInterval) : Clock::duration(kPlainInterval);
  const bool milestone = !terminal_ && passes >= milestone_;
  if (!last && !milestone && now - last_ < interval) return false;
  last_ = now;
  milestone_ = 2 * std::bit_floor(passes);
  return true;
}

void Progress::passed(const Statistics& statistics, const Moment& moment) {
  if (!due(statistics.passes, moment.last)) return;
  const double seconds = std::chrono::duration<double>(last_ - start_).count();
  const auto made = static_cast<double>(statistics.passes - passes_before_);
  State state{rate_of(statistics), 0.0, moment.seconds_left};
  state.a_second = (state.rate.count - count_before_) *
                   (state.rate.of_each_pixel ? static_cast<double>(pixels_) : 1.0) /
                   std::max(seconds, 1e-9);
  if (passes_) {
    const double to_make = static_cast<double>(*passes_) - static_cast<double>(statistics.passes);
    state.seconds_left = std::min(moment.seconds_left.value_or(1e9), seconds / made * to_make);
  }
  tell(json_ ? json_of(statistics, passes_, state, moment)
             : text_of(statistics, passes_, state, moment));
}

void Progress::tell(const std::string& text) {
  if (json_) {
    std::fprintf(stderr, "%s\n", text.c_str());
  } else if (terminal_) {
    std::fprintf(stderr, "\r%s\x1b[K", cut_to_terminal("ppm-vk: " + text).c_str());
    line_open_ = true;
  } else {
    std::fprintf(stderr, "ppm-vk: %s\n", text.c_str());
  }
  std::fflush(stderr);
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
