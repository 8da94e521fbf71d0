// Integrals in double precision: Gauss-Legendre rules, panel by panel.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace ppm::statistics {

/// Nodes and weights on [0, 1]; exact for polynomials of degree 2n - 1.
struct GaussRule {
  explicit GaussRule(int n) {
    for (int k = 0; k < n; ++k) {
      double x = std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5));
      double derivative = 0.0;
      for (int iteration = 0; iteration < 20; ++iteration) {
        double previous = 1.0;
        double value = x;
        for (int degree = 2; degree <= n; ++degree) {
          const double next = ((2 * degree - 1) * x * value - (degree - 1) * previous) / degree;
          previous = value;
          value = next;
        }
        derivative = n * (x * value - previous) / (x * x - 1.0);
        x -= value / derivative;
      }
      nodes.push_back(0.5 * (1.0 - x));
      weights.push_back(1.0 / ((1.0 - x * x) * derivative * derivative));
    }
  }

  std::vector<double> nodes, weights;
};

inline const GaussRule& rule16() {
  static const GaussRule rule(16);
  return rule;
}

/// Integral of f over [a, b] by `panels` equal panels of 16 nodes. f may yield any linear type.
template <typename F>
auto integrate(const F& f, double a, double b, int panels = 1) {
  const GaussRule& rule = rule16();
  const double width = (b - a) / panels;
  auto sum = f(a) * 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      sum += f(a + width * (panel + rule.nodes[k])) * (width * rule.weights[k]);
    }
  }
  return sum;
}

}  // namespace ppm::statistics
