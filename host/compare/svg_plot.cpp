#include "svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "page_text.hpp"

namespace ppm::compare {
namespace {

// Units of the picture, which is as wide as its place.
constexpr double kWidth = 560, kHeight = 380;
constexpr double kLeft = 66, kRight = 14, kTop = 30, kBottom = 46;
constexpr double kLegendLine = 16;

/// From values to places.
class Axis {
 public:
  Axis(bool logarithmic, double start, double end)
      : logarithmic_(logarithmic), start_(start), end_(end) {}

  bool takes(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0.0); }
  void include(double value) {
    if (!takes(value)) return;
    least_ = std::min(least_, shown(value));
    most_ = std::max(most_, shown(value));
  }
  /// Once all is included: some room at both ends.
  void settle() {
    if (least_ > most_) least_ = 0.0, most_ = 1.0;
    const double room = std::max(0.04 * (most_ - least_), 1e-6 * std::max(std::abs(most_), 1e-30));
    const bool from_zero = !logarithmic_ && least_ >= 0.0 && least_ - room < 0.0;
    least_ = from_zero ? 0.0 : least_ - room;
    most_ += room;
    if (logarithmic_ && most_ - least_ < 0.5) {
      const double middle = 0.5 * (least_ + most_);
      least_ = middle - 0.25;
      most_ = middle + 0.25;
    }
  }
  double place(double value) const {
    return start_ + (shown(value) - least_) / (most_ - least_) * (end_ - start_);
  }
  struct Tick {
    double value;
    bool labelled;
  };
  std::vector<Tick> ticks() const { return logarithmic_ ? decades() : steps(); }

 private:
  double shown(double value) const { return logarithmic_ ? std::log10(value) : value; }

  std::vector<Tick> decades() const {
    std::vector<Tick> ticks;
    const bool few = most_ - least_ < 2.2;
    // At most so many decades get a label each.
    const int stride = std::max(1, static_cast<int>((most_ - least_) / 8.0));
    for (int decade = static_cast<int>(std::floor(least_)); decade <= most_; ++decade) {
      for (int digit = 1; digit <= 9; ++digit) {
        const double value = digit * std::pow(10.0, decade);
        if (shown(value) < least_ || shown(value) > most_) continue;
        const bool named = digit == 1 ? decade % stride == 0 : few && (digit == 2 || digit == 5);
        if (named || (digit > 1 && most_ - least_ < 6.0)) ticks.push_back({value, named});
      }
    }
    return ticks;
  }
  std::vector<Tick> steps() const {
    const double rough = (most_ - least_) / 6.0;
    const double unit = std::pow(10.0, std::floor(std::log10(rough)));
    double step = unit;
    for (const double factor : {2.0, 5.0, 10.0}) {
      if (step < rough) step = factor * unit;
    }
    std::vector<Tick> ticks;
    for (double at = std::ceil(least_ / step); at * step <= most_; at += 1.0) {
      ticks.push_back({at * step, true});
    }
    return ticks;
  }

  bool logarithmic_;
  double start_, end_;
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
};

std::string text_at(double x, double y, const char* anchor, const std::string& text,
                    const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, more, escape_html(text));
}

std::string line(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x0, y0, x1,
      y1, kind);
}

std::string axes(const Plot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  for (const Axis::Tick& tick : x.ticks()) {
    const double at = x.place(tick.value);
    svg += line(at, kTop, at, kHeight - kBottom, tick.labelled ? "grid" : "fine");
    if (tick.labelled) {
      svg += text_at(at, kHeight - kBottom + 15, "middle", short_number(tick.value));
    }
  }
  for (const Axis::Tick& tick : y.ticks()) {
    const double at = y.place(tick.value);
    svg += line(kLeft, at, kWidth - kRight, at, tick.labelled ? "grid" : "fine");
    if (tick.labelled) svg += text_at(kLeft - 5, at + 4, "end", short_number(tick.value));
  }
  svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"frame\"/>\n",
                     kLeft, kTop, kWidth - kLeft - kRight, kHeight - kTop - kBottom);
  svg += text_at(0.5 * (kLeft + kWidth - kRight), kHeight - 10, "middle", plot.x_label);
  const double middle = 0.5 * (kTop + kHeight - kBottom);
  svg += text_at(14, middle, "middle", plot.y_label,
                 fmt::format(" transform=\"rotate(-90 14 {})\"", middle).c_str());
  svg += text_at(0.5 * (kLeft + kWidth - kRight), 18, "middle", plot.title, " class=\"title\"");
  return svg;
}

std::string drawn(const Curve& curve, const Axis& x, const Axis& y) {
  std::string places, dots;
  const std::string colour = curve_colour(curve.colour);
  for (const Sample& point : curve.points) {
    if (!x.takes(point.x) || !y.takes(point.y)) continue;
    places += fmt::format("{:.1f},{:.1f} ", x.place(point.x), y.place(point.y));
    if (!curve.thin && curve.points.size() <= 64) {
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"{}\"/>\n",
                          x.place(point.x), y.place(point.y), colour);
    }
  }
  if (places.empty()) return "";
  return fmt::format("<polyline points=\"{}\" class=\"{}\" stroke=\"{}\"/>\n", places,
                     curve.thin ? "seed" : "curve", colour) +
         dots;
}

std::size_t named_curves(const Plot& plot) {
  return static_cast<std::size_t>(
      std::count_if(plot.curves.begin(), plot.curves.end(),
                    [](const Curve& curve) { return !curve.name.empty(); }));
}

/// Below the axes, where it hides nothing.
std::string legend(const Plot& plot) {
  std::string entries;
  double at = kHeight + 6;
  for (const Curve& curve : plot.curves) {
    if (curve.name.empty()) continue;
    entries += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"curve\" "
        "stroke=\"{}\"/>\n",
        kLeft, at - 4, kLeft + 20, at - 4, curve_colour(curve.colour));
    entries += text_at(kLeft + 26, at, "start", curve.name + " " + curve.note);
    at += kLegendLine;
  }
  return entries;
}

}  // namespace

std::string curve_colour(std::size_t index) {
  constexpr std::array<const char*, 7> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                   "#e69f00", "#56b4e9", "#555555"};
  return kColours[index % kColours.size()];
}

std::string svg_plot(const Plot& plot) {
  Axis x(plot.x_logarithmic, kLeft, kWidth - kRight),
      y(plot.y_logarithmic, kHeight - kBottom, kTop);
  for (const Curve& curve : plot.curves) {
    for (const Sample& point : curve.points) {
      if (!x.takes(point.x) || !y.takes(point.y)) continue;
      x.include(point.x);
      y.include(point.y);
    }
  }
  for (const Level& level : plot.levels) y.include(level.y);
  x.settle();
  y.settle();

  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", kWidth,
      kHeight + kLegendLine * static_cast<double>(named_curves(plot)), escape_html(plot.title));
  svg += axes(plot, x, y);
  for (const Level& level : plot.levels) {
    if (!y.takes(level.y)) continue;
    svg += line(kLeft, y.place(level.y), kWidth - kRight, y.place(level.y), "level");
    svg += text_at(kLeft + 5, y.place(level.y) - 4, "start", level.name);
  }
  for (const Curve& curve : plot.curves) svg += drawn(curve, x, y);
  return svg + legend(plot) + "</svg>\n";
}

}  // namespace ppm::compare
