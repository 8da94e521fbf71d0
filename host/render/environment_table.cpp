#include "environment_table.hpp"

#include <cmath>
#include <numbers>

#include "alias_table.hpp"

namespace ppm::render {
namespace {

constexpr double kPi = std::numbers::pi;

/// Integral of (a + b * angle) * sine from one angle to another.
double linear_times_sine(double a, double b, double from, double to) {
  const auto at = [&](double angle) {
    return -a * std::cos(angle) + b * (std::sin(angle) - angle * std::cos(angle));
  };
  return at(to) - at(from);
}

/// What a row's tent, constant beyond the poles' rows, covers of the sphere's height.
double tent_of_row(std::uint32_t row, std::uint32_t height) {
  const double step = kPi / height;
  const double middle = (row + 0.5) * step;
  const double above = row == 0 ? linear_times_sine(1.0, 0.0, 0.0, middle)
                                : linear_times_sine(0.5 - row, 1.0 / step, middle - step, middle);
  const double below = row + 1 == height
                           ? linear_times_sine(1.0, 0.0, middle, kPi)
                           : linear_times_sine(row + 1.5, -1.0 / step, middle, middle + step);
  return above + below;
}

}  // namespace

EnvironmentTable make_environment_table(const scene::Environment& environment) {
  EnvironmentTable table;
  const std::uint32_t width = environment.width, height = environment.height;
  table.texels.resize(environment.texels.size());
  std::vector<double> weights(environment.texels.size());
  double sum = 0.0;
  std::size_t at = 0;
  for (std::uint32_t row = 0; row < height; ++row) {
    const double sine = std::sin(kPi * (row + 0.5) / height);
    const double solid_angle = 2.0 * kPi / width * tent_of_row(row, height);
    for (std::uint32_t column = 0; column < width; ++column, ++at) {
      const glm::uvec2 packed =
          shared::pack_radiance(environment.texels[at] * environment.strength);
      const glm::dvec3 radiance = shared::unpack_radiance(packed);
      table.texels[at] = {packed, 0u, 0u};
      table.irradiance += radiance * solid_angle;
      weights[at] = (radiance.x + radiance.y + radiance.z) / 3.0 * sine;
      sum += weights[at];
    }
  }
  if (!(sum > 0.0)) return {};
  const AliasTable alias = make_alias_table(weights);
  for (std::size_t i = 0; i < table.texels.size(); ++i) {
    table.texels[i].z = alias.threshold[i];
    table.texels[i].w = alias.alias[i];
  }
  table.shape = {width, height, static_cast<float>(environment.rotation / (2.0 * kPi)),
                 static_cast<float>(static_cast<double>(width) * height / (2.0 * kPi * kPi * sum))};
  return table;
}

}  // namespace ppm::render
