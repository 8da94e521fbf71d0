#include "preview.hpp"

#include <algorithm>
#include <utility>

#include "stopwatch.hpp"

namespace ppm::render {
namespace {

/// A tenth of the time at most is spent on what is only looked at.
constexpr double kPassesToPreviews = 9.0;

}  // namespace

Preview::Preview(std::filesystem::path file, double every_seconds)
    : file_(std::move(file)), every_seconds_(every_seconds) {}

bool Preview::due() const {
  return wanted() && clock_seconds() >= next_;
}

void Preview::show(const std::function<void(const std::filesystem::path&)>& write) {
  const double start = clock_seconds();
  next_ = start + every_seconds_;
  write(file_);
  const double end = clock_seconds();
  next_ = std::max(next_, end + kPassesToPreviews * (end - start));
}

}  // namespace ppm::render
