#include "live_display.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "stopwatch.hpp"

namespace ppm::render {
namespace {

constexpr double kLeastSeconds = 1.0;  // between two pictures
constexpr double kMostShare = 0.1;     // of the time that making them may take
constexpr double kFarewell = 3.0;      // seconds that the last one may take to be sent

}  // namespace

LiveDisplay::LiveDisplay(const std::optional<display::TevAddress>& address,
                         const std::string& title, Log& log)
    : log_(log) {
  if (!address) return;
  place_ = fmt::format("{}:{}", address->host, address->port);
  viewer_.emplace(*address, title);
}

bool LiveDisplay::due() {
  if (!viewer_) return false;
  warn();
  return clock_seconds() >= next_ && viewer_->idle();
}

void LiveDisplay::show(const Picture& picture, double seconds) {
  viewer_->show(picture.width, picture.height, picture.rgb);
  next_ = clock_seconds() + std::max(kLeastSeconds, seconds * (1.0 / kMostShare - 1.0));
}

void LiveDisplay::last(const Picture& picture) {
  if (!viewer_) return;
  viewer_->show(picture.width, picture.height, picture.rgb);
  viewer_->finish(kFarewell);
  warn();
}

void LiveDisplay::warn() {
  if (const std::optional<std::string> problem = viewer_->problem()) {
    log_.warn(fmt::format("--display tev:{}: {}; the rendering goes on without", place_, *problem));
  }
}

}  // namespace ppm::render
