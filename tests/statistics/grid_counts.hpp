// Chi-squared of samples with two coordinates against a density given in them.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "chi_squared.hpp"
#include "quadrature.hpp"

namespace ppm::statistics {

/// columns x rows rectangles that cover [low, high]; whatever lies outside is one more cell.
struct Rectangles {
  glm::dvec2 low, high;
  int columns = 16, rows = 16;
};

/// Draws `count` samples (a glm::dvec2 each) and compares them with `density` per unit of the
/// coordinates' area, integrated over every rectangle. What density lacks to 1 is expected outside.
template <typename Sampler, typename Density>
void expect_density(const Rectangles& domain, int count, const Sampler& sampler,
                    const Density& density, const std::string& what) {
  const auto cells = static_cast<std::size_t>(domain.columns * domain.rows);
  std::vector<double> observed(cells + 1, 0.0);
  std::vector<double> expected(cells + 1, 0.0);
  const glm::dvec2 shape(domain.columns, domain.rows);
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 cell =
        glm::floor((sampler() - domain.low) / (domain.high - domain.low) * shape);
    const bool inside = glm::all(glm::greaterThanEqual(cell, glm::dvec2(0.0))) &&
                        glm::all(glm::lessThan(cell, shape));
    const double index = cell.y * shape.x + cell.x;
    ++observed[inside ? static_cast<std::size_t>(index) : cells];
  }
  const glm::dvec2 step = (domain.high - domain.low) / shape;
  double inside = 0.0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto columns = static_cast<std::size_t>(domain.columns);
    const glm::dvec2 low = domain.low + step * glm::dvec2(static_cast<double>(cell % columns),
                                                          static_cast<double>(cell / columns));
    const auto row = [&](double y) {
      return integrate([&](double x) { return double(density(glm::dvec2(x, y))); }, low.x,
                       low.x + step.x);
    };
    expected[cell] = count * integrate(row, low.y, low.y + step.y);
    inside += expected[cell];
  }
  // 1e-6 of the samples is far below what the test resolves and above the densities' rounding.
  const double rest = count - inside;
  EXPECT_GT(rest, -1e-6 * count) << what << ": the density integrates to more than 1";
  expected[cells] = rest > 1e-6 * count ? rest : 0.0;
  expect_counts(observed, expected, what);
}

}  // namespace ppm::statistics
