// A partition of the directions into cells that gather where a lobe does, and integrals over them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "quadrature.hpp"

namespace ppm::statistics {

/// Polar coordinates about `axis` (unit): rings whose widths grow from about scale / 3 in
/// proportion to their distance, cut into sectors. With `upper` only directions with z > 0 belong
/// to cells; their edge cuts through the rings where it lies, so that integrands may jump there.
/// The axis then has z > 0.
class DirectionChart {
 public:
  DirectionChart(glm::dvec3 axis, double scale, bool upper) : axis_(axis), upper_(upper) {
    const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    tangent_ = glm::normalize(glm::cross(other, axis));
    bitangent_ = glm::cross(axis, tangent_);
    const double step = std::asinh(std::numbers::pi / scale) / kRings;
    for (int ring = 0; ring <= kRings; ++ring) edges_.push_back(scale * std::sinh(step * ring));
  }

  /// Cells, and one more for whatever is in none of them.
  std::size_t bins() const { return kRings * kSectors + 1; }

  std::size_t bin(glm::dvec3 direction) const {
    if (direction == glm::dvec3(0.0) || (upper_ && direction.z <= 0.0)) return bins() - 1;
    const double x = glm::dot(direction, tangent_);
    const double y = glm::dot(direction, bitangent_);
    const double angle = std::atan2(std::hypot(x, y), glm::dot(direction, axis_));
    const double turn = std::atan2(y, x) / (2.0 * std::numbers::pi) + 0.5;
    const auto ring = std::upper_bound(edges_.begin(), edges_.end(), angle) - edges_.begin() - 1;
    const int sector = std::min(static_cast<int>(turn * kSectors), kSectors - 1);
    return static_cast<std::size_t>(std::min<long>(ring, kRings - 1) * kSectors + sector);
  }

  /// Integral of f(direction) over each cell, per steradian.
  template <typename F>
  auto integrate_cells(const F& f) const {
    std::vector<decltype(f(axis_))> result;
    const double sector = 2.0 * std::numbers::pi / kSectors;
    for (int ring = 0; ring < kRings; ++ring) {
      for (int k = 0; k < kSectors; ++k) {
        const auto along = [&](double turn) { return integrate_ray(f, ring, turn); };
        result.push_back(integrate(along, sector * k - std::numbers::pi,
                                   sector * (k + 1) - std::numbers::pi, 2));
      }
    }
    return result;
  }

  /// Integral of f(direction) over all cells.
  template <typename F>
  auto integrate_all(const F& f) const {
    auto sum = f(axis_) * 0.0;
    for (const auto& cell : integrate_cells(f)) sum += cell;
    return sum;
  }

 private:
  static constexpr int kRings = 24;
  static constexpr int kSectors = 16;

  // Over one ring at a fixed angle around the axis, down to the horizon.
  template <typename F>
  auto integrate_ray(const F& f, int ring, double turn) const {
    const glm::dvec3 side = tangent_ * std::cos(turn) + bitangent_ * std::sin(turn);
    const double low = edges_[static_cast<std::size_t>(ring)];
    double high = edges_[static_cast<std::size_t>(ring) + 1];
    if (upper_) {
      // z = A cos(angle - shift) vanishes a quarter turn beyond the shift.
      const double shift = std::atan2(side.z, axis_.z);
      high = std::clamp(shift + 0.5 * std::numbers::pi, low, high);
    }
    const auto at = [&](double angle) {
      return f(axis_ * std::cos(angle) + side * std::sin(angle)) * std::sin(angle);
    };
    return integrate(at, low, high);
  }

  glm::dvec3 axis_, tangent_, bitangent_;
  bool upper_;
  std::vector<double> edges_;
};

}  // namespace ppm::statistics
