#include "false_colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ppm::compare {
namespace {

constexpr std::array<Srgb, 9> kAnchors = {{{0, 0, 4},
                                           {31, 12, 72},
                                           {85, 15, 109},
                                           {136, 34, 106},
                                           {186, 54, 85},
                                           {227, 89, 51},
                                           {249, 140, 10},
                                           {249, 201, 50},
                                           {252, 255, 164}}};
constexpr Srgb kNoNumber = {128, 128, 128};

}  // namespace

Srgb error_colour(double relative_error) {
  if (std::isnan(relative_error)) return kNoNumber;
  const double decades = std::log10(kMostError / kLeastError);
  const double place = relative_error > 0.0 ? std::log10(relative_error / kLeastError) : 0.0;
  const double at = std::clamp(place / decades, 0.0, 1.0) * (kAnchors.size() - 1);
  const std::size_t below =
      std::min<std::size_t>(static_cast<std::size_t>(at), kAnchors.size() - 2);
  const double share = at - static_cast<double>(below);
  Srgb colour{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = (1.0 - share) * kAnchors[below][i] + share * kAnchors[below + 1][i];
    colour[i] = static_cast<std::uint8_t>(std::lround(value));
  }
  return colour;
}

std::vector<std::uint8_t> error_colours(std::span<const float> relative_errors) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * relative_errors.size());
  for (const float value : relative_errors) {
    const Srgb colour = error_colour(value);
    bytes.insert(bytes.end(), colour.begin(), colour.end());
  }
  return bytes;
}

std::string error_gradient() {
  std::string css = "linear-gradient(to right";
  for (const Srgb& colour : kAnchors) {
    css += fmt::format(",rgb({},{},{})", colour[0], colour[1], colour[2]);
  }
  return css + ")";
}

}  // namespace ppm::compare
