// Curves as inline SVG.
#pragma once

#include <string>
#include <vector>

#include "metrics.hpp"

namespace ppm::compare {

struct Curve {
  std::string name;        ///< in the legend; empty: not there
  std::string note;        ///< behind the name, such as a slope
  std::size_t colour = 0;  ///< index of `curve_colour`
  bool thin = false;       ///< a single seed behind a median
  std::vector<Sample> points;
};

/// A horizontal line, such as the reference's own error.
struct Level {
  std::string name;
  double y = 0.0;
};

struct Plot {
  std::string title, x_label, y_label;
  bool x_logarithmic = true, y_logarithmic = true;
  std::vector<Curve> curves;
  std::vector<Level> levels;
};

/// Colours that the colour-blind can tell apart too [Okabe and Ito 2008]; they repeat after seven.
std::string curve_colour(std::size_t index);

/// One <svg> element with axes, grid, curves and legend. Points that are not finite, or not
/// positive on a logarithmic axis, are left out.
std::string svg_plot(const Plot& plot);

}  // namespace ppm::compare
