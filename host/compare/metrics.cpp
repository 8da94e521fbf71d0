#include "metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "failure.hpp"

namespace ppm::compare {
namespace {

void require_same_size(std::size_t a, std::size_t b) {
  PPM_ASSERT(a == b && a % 3 == 0 && a > 0, std::to_string(a) + " and " + std::to_string(b));
}

double square(double x) {
  return x * x;
}

/// Of squared relative errors, one a pixel; NaN and infinities are left out.
double trimmed_mean(std::vector<double> squares) {
  constexpr std::size_t kPart = 1000;
  std::erase_if(squares, [](double value) { return !std::isfinite(value); });
  const std::size_t worst = (squares.size() + kPart - 1) / kPart;
  const std::size_t rest = squares.size() - worst;
  if (rest == 0) return 0.0;
  const auto end = squares.begin() + static_cast<std::ptrdiff_t>(rest);
  std::nth_element(squares.begin(), end, squares.end());
  double sum = 0.0;
  for (auto value = squares.begin(); value != end; ++value) sum += *value;
  return sum / static_cast<double>(rest);
}

}  // namespace

double relative_epsilon(std::span<const float> reference) {
  double sum = 0.0;
  std::uint64_t count = 0;
  for (const float value : reference) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? square(0.1 * sum / static_cast<double>(count)) : 0.0;
}

Errors errors_of(std::span<const float> picture, std::span<const float> reference, double epsilon) {
  require_same_size(picture.size(), reference.size());
  Errors errors;
  Rgb count{};
  double squares = 0.0, relative = 0.0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (!std::isfinite(picture[i]) || !std::isfinite(reference[i])) {
      ++errors.left_out;
      continue;
    }
    const double value = picture[i], wanted = reference[i];
    const double difference = value - wanted;
    squares += square(difference);
    const double scale = square(wanted) + epsilon;
    if (epsilon > 0.0) relative += square(difference) / scale;
    errors.mean[i % 3] += value;
    errors.mean_difference[i % 3] += difference;
    count[i % 3] += 1.0;
  }
  const double all = count[0] + count[1] + count[2];
  if (all == 0.0) return errors;
  errors.rmse = std::sqrt(squares / all);
  errors.relative_mse = relative / all;
  std::vector<double> pixels;
  for (const float error : relative_error_map(picture, reference, epsilon)) {
    pixels.push_back(square(error));
  }
  errors.trimmed_relative_mse = epsilon > 0.0 ? trimmed_mean(std::move(pixels)) : 0.0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    errors.mean[channel] /= std::max(count[channel], 1.0);
    errors.mean_difference[channel] /= std::max(count[channel], 1.0);
  }
  return errors;
}

std::vector<float> relative_error_map(std::span<const float> picture,
                                      std::span<const float> reference, double epsilon) {
  require_same_size(picture.size(), reference.size());
  std::vector<float> map(picture.size() / 3);
  for (std::size_t pixel = 0; pixel < map.size(); ++pixel) {
    double sum = 0.0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      if (!std::isfinite(picture[i]) || !std::isfinite(reference[i])) {
        sum = std::numeric_limits<double>::quiet_NaN();
        break;
      }
      const double wanted = reference[i];
      const double scale = square(wanted) + epsilon;
      if (scale > 0.0) sum += square(picture[i] - wanted) / scale;
    }
    map[pixel] = static_cast<float>(std::sqrt(sum / 3.0));
  }
  return map;
}

void PictureMean::add(std::span<const float> picture) {
  if (count_ == 0) {
    mean_.assign(picture.size(), 0.0);
    squares_.assign(picture.size(), 0.0);
  }
  require_same_size(picture.size(), mean_.size());
  ++count_;
  const double share = 1.0 / static_cast<double>(count_);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double before = picture[i] - mean_[i];
    mean_[i] += share * before;
    squares_[i] += before * (picture[i] - mean_[i]);
  }
}

std::vector<float> PictureMean::mean() const {
  std::vector<float> values(mean_.size());
  std::transform(mean_.begin(), mean_.end(), values.begin(),
                 [](double value) { return static_cast<float>(value); });
  return values;
}

std::vector<float> PictureMean::standard_error() const {
  std::vector<float> values(squares_.size(), 0.0f);
  if (count_ < 2) return values;
  const auto n = static_cast<double>(count_);
  std::transform(squares_.begin(), squares_.end(), values.begin(),
                 [&](double sum) { return static_cast<float>(std::sqrt(sum / (n * (n - 1.0)))); });
  return values;
}

double PictureMean::mean_variance() const {
  if (count_ < 2) return 0.0;
  double sum = 0.0;
  std::size_t finite = 0;
  for (const double value : squares_) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++finite;
  }
  if (finite == 0) return 0.0;
  return sum / (static_cast<double>(count_ - 1) * static_cast<double>(finite));
}

std::optional<double> log_log_slope(std::span<const Sample> points) {
  double n = 0.0, sum_x = 0.0, sum_y = 0.0;
  const auto usable = [](const Sample& point) {
    return point.x > 0.0 && point.y > 0.0 && std::isfinite(point.x) && std::isfinite(point.y);
  };
  for (const Sample& point : points) {
    if (!usable(point)) continue;
    n += 1.0;
    sum_x += std::log(point.x);
    sum_y += std::log(point.y);
  }
  if (n < 2.0) return std::nullopt;
  double xx = 0.0, xy = 0.0;
  for (const Sample& point : points) {
    if (!usable(point)) continue;
    const double dx = std::log(point.x) - sum_x / n;
    xx += dx * dx;
    xy += dx * (std::log(point.y) - sum_y / n);
  }
  if (!(xx > 1e-12)) return std::nullopt;
  return xy / xx;
}

double median(std::vector<double> values) {
  PPM_ASSERT(!values.empty(), "no values");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Estimate estimate(std::span<const double> values) {
  PPM_ASSERT(!values.empty(), "no values");
  const auto n = static_cast<double>(values.size());
  Estimate result;
  for (const double value : values) result.mean += value / n;
  if (values.size() < 2) return result;
  double sum = 0.0;
  for (const double value : values) sum += square(value - result.mean);
  result.standard_error = std::sqrt(sum / (n * (n - 1.0)));
  return result;
}

}  // namespace ppm::compare
