// Numbers as colours: one scale for all methods.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ppm::compare {

using Srgb = std::array<std::uint8_t, 3>;

/// Relative errors from `kLeastError` (dark) to `kMostError` (light), on a logarithmic scale.
constexpr double kLeastError = 0.01, kMostError = 10.0;

/// Below the scale its dark end, above its light end; grey for NaN. Brightness grows with the error
/// (anchors of the "inferno" map of matplotlib, CC0).
Srgb error_colour(double relative_error);

/// 3 bytes a value.
std::vector<std::uint8_t> error_colours(std::span<const float> relative_errors);

/// A CSS gradient of the scale.
std::string error_gradient();

}  // namespace ppm::compare
