#include "analysis.hpp"

#include <algorithm>
#include <cmath>

#include "failure.hpp"
#include "picture_reader.hpp"

namespace ppm::compare {
namespace {

std::optional<double> median_slope(const std::vector<std::vector<Sample>>& curves) {
  std::vector<double> slopes;
  for (const auto& curve : curves) {
    if (const auto slope = log_log_slope(curve)) slopes.push_back(*slope);
  }
  if (slopes.empty()) return std::nullopt;
  return median(slopes);
}

std::vector<Sample> points_of(const SeedResult& seed, double Errors::*error) {
  std::vector<Sample> points;
  for (std::size_t i = 0; i < seed.errors.size(); ++i) {
    points.push_back({seed.record.pictures[i].seconds, seed.errors[i].*error});
  }
  return points;
}

bool overlap(const Crop& a, const Crop& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

}  // namespace

SeedResult measure_seed(const ReportFolder& folder, const std::string& run, RunRecord record,
                        const Reference& reference, double epsilon, std::uint32_t width,
                        std::uint32_t height) {
  SeedResult seed{std::move(record), run, {}};
  for (const KeptPicture& picture : seed.record.pictures) {
    const auto rgb = image::read_rgb(folder.run_folder(run) / picture.file, width, height);
    seed.errors.push_back(errors_of(rgb, reference.rgb, epsilon));
  }
  return seed;
}

std::vector<Sample> rmse_points(const SeedResult& seed) {
  return points_of(seed, &Errors::rmse);
}

std::vector<Sample> relative_points(const SeedResult& seed) {
  return points_of(seed, &Errors::relative_mse);
}

std::vector<Sample> trimmed_points(const SeedResult& seed) {
  return points_of(seed, &Errors::trimmed_relative_mse);
}

std::vector<Sample> median_curve(const std::vector<std::vector<Sample>>& curves) {
  if (curves.empty()) return {};
  std::size_t shortest = curves.front().size();
  for (const auto& curve : curves) shortest = std::min(shortest, curve.size());
  std::vector<Sample> medians;
  for (std::size_t from_end = shortest; from_end > 0; --from_end) {
    std::vector<double> x, y;
    for (const auto& curve : curves) {
      x.push_back(curve[curve.size() - from_end].x);
      y.push_back(curve[curve.size() - from_end].y);
    }
    medians.push_back({median(x), median(y)});
  }
  return medians;
}

void summarise(MethodResult& result, const PictureMean& last_pictures) {
  if (result.seeds.empty()) return;
  std::vector<double> rmse, relative, trimmed, squares;
  std::vector<std::vector<Sample>> rmse_curves, relative_curves, trimmed_curves;
  for (const SeedResult& seed : result.seeds) {
    rmse.push_back(seed.errors.back().rmse);
    squares.push_back(rmse.back() * rmse.back());
    relative.push_back(seed.errors.back().relative_mse);
    trimmed.push_back(seed.errors.back().trimmed_relative_mse);
    rmse_curves.push_back(rmse_points(seed));
    trimmed_curves.push_back(trimmed_points(seed));
    relative_curves.push_back(relative_points(seed));
  }
  result.rmse = median(rmse);
  result.relative_mse = median(relative);
  result.trimmed_relative_mse = median(trimmed);
  result.rmse_slope = median_slope(rmse_curves);
  result.relative_slope = median_slope(relative_curves);
  result.trimmed_slope = median_slope(trimmed_curves);
  result.trimmed_curve = median_curve(trimmed_curves);
  result.rmse_curve = median_curve(rmse_curves);
  result.relative_curve = median_curve(relative_curves);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    std::vector<double> means, differences;
    for (const SeedResult& seed : result.seeds) {
      means.push_back(seed.errors.back().mean[channel]);
      differences.push_back(seed.errors.back().mean_difference[channel]);
    }
    result.mean[channel] = estimate(means);
    result.mean_difference[channel] = estimate(differences);
  }
  if (last_pictures.count() > 1) {
    const double variance = last_pictures.mean_variance();
    result.noise = std::sqrt(variance);
    result.bias = std::sqrt(std::max(0.0, estimate(squares).mean - variance));
  }
}

double share_of_light(const MethodResult& result) {
  double found = 0.0, there = 0.0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    found += result.mean[channel].mean;
    there += result.mean[channel].mean - result.mean_difference[channel].mean;
  }
  return there > 0.0 ? found / there : 1.0;
}

std::vector<Crop> crops_of_interest(const std::vector<std::vector<float>>& maps,
                                    std::uint32_t width, std::uint32_t height, unsigned count) {
  const std::uint32_t side = std::max(1u, std::min({width, height, std::max(16u, width / 6)}));
  const std::uint32_t step = std::max(1u, side / 4);
  struct Place {
    Crop crop;
    double interest;
  };
  std::vector<Place> places;
  for (std::uint32_t y = 0; y + side <= height; y += step) {
    for (std::uint32_t x = 0; x + side <= width; x += step) {
      // By how many percent the methods' errors spread; bounded, so that no single pixel decides.
      double least = 1e30, most = 0.0;
      for (const auto& map : maps) {
        double sum = 0.0;
        for (std::uint32_t row = y; row < y + side; ++row) {
          for (std::uint32_t column = x; column < x + side; ++column) {
            const float error = map[std::size_t{row} * width + column];
            if (error > 0.0f) sum += std::min(error, 2.0f);
          }
        }
        least = std::min(least, sum);
        most = std::max(most, sum);
      }
      places.push_back({{x, y, side, side}, most - least + 1e-3 * most});
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.interest > b.interest; });
  std::vector<Crop> crops;
  for (const Place& place : places) {
    if (crops.size() == count) break;
    const bool is_free = std::none_of(crops.begin(), crops.end(),
                                      [&](const Crop& crop) { return overlap(crop, place.crop); });
    if (is_free) crops.push_back(place.crop);
  }
  return crops;
}

double suitable_exposure(std::span<const float> rgb) {
  std::vector<float> brightest;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const float value = std::max({rgb[i], rgb[i + 1], rgb[i + 2]});
    if (std::isfinite(value)) brightest.push_back(value);
  }
  if (brightest.empty()) return 0.0;
  const auto place = brightest.begin() + static_cast<std::ptrdiff_t>(brightest.size() * 9 / 10);
  const auto at = place == brightest.end() ? place - 1 : place;
  std::nth_element(brightest.begin(), at, brightest.end());
  if (!(*at > 0.0f)) return 0.0;
  const double exposure = -std::log2(static_cast<double>(*at) / 0.8);
  return std::clamp(std::round(10.0 * exposure) / 10.0, -100.0, 100.0);
}

}  // namespace ppm::compare
