#include "plate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ppm::test {
namespace {

// Samples along a block's edge, and the irradiance's means over it. A midpoint rule with steps h
// errs by h^2/24 times the mean Laplacian: with h = 0.3/16 and the Laplacian of a light half a unit
// away, below 30 E, that is 5e-4.
constexpr int kSamples = 16;
constexpr double kQuadratureError = 5e-4;
// Standard errors allowed. Pooled over blocks they have tens of degrees of freedom, so that five of
// them are passed once in a million comparisons.
constexpr double kSigmas = 5.0;

struct Expected {
  glm::dvec3 mean{0.0};  // over the block
  glm::dvec3 bias{0.0};  // at most, by discs of finite size
};

// The mean over a disc of radius R is E + R^2/8 Laplacian(E) to second order, and Laplacian(E) is
// the sum of E at four points a distance R away, less 4 E, over R^2. Radii only shrink from R, so
// the bias over passes is less. Half as much again covers higher orders and the kinks of spots.
Expected expected_radiance(const PlateView& view, glm::dvec3 albedo, const Irradiance& irradiance,
                           std::uint32_t block_x, std::uint32_t block_y) {
  Expected result;
  const double r = view.radius;
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const glm::dvec2 p = view.point(view.block * (block_x + (i + 0.5) / kSamples),
                                      view.block * (block_y + (j + 0.5) / kSamples));
      const glm::dvec3 here = irradiance(p);
      const glm::dvec3 around =
          irradiance(p + glm::dvec2(r, 0.0)) + irradiance(p - glm::dvec2(r, 0.0)) +
          irradiance(p + glm::dvec2(0.0, r)) + irradiance(p - glm::dvec2(0.0, r));
      result.mean += here;
      result.bias += (around - 4.0 * here) / 8.0;
    }
  }
  const glm::dvec3 scale = albedo / std::numbers::pi / static_cast<double>(kSamples * kSamples);
  result.mean *= scale;
  result.bias = 1.5 * glm::abs(result.bias * scale);
  return result;
}

// Photons of about equal flux make the variance of a block proportional to its mean; the constant
// from all blocks is known better than any one variance of a few seeds. Each block gets the larger.
void pool(std::vector<Estimate>& estimates, const std::vector<Expected>& expected) {
  const std::size_t blocks = expected.size();
  for (int channel = 0; channel < 3; ++channel) {
    double variance = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < blocks; ++i) {
      const double error = estimates[i].standard_error[channel];
      variance += error * error;
      mean += expected[i].mean[channel];
    }
    for (std::size_t i = 0; i < blocks && mean > 0.0; ++i) {
      double& error = estimates[i].standard_error[channel];
      error = std::max(error, std::sqrt(variance / mean * expected[i].mean[channel]));
    }
  }
}

}  // namespace

void PlateView::add_camera(GltfWriter& writer) const {
  const double distance = std::abs(eye.y - plate_height);
  writer.camera("plate", eye, {eye.x, plate_height, eye.z}, 2.0 * std::atan(half / distance),
                std::nullopt, {0.0, 0.0, eye.y > plate_height ? -1.0 : 1.0});
}

render::Settings PlateView::settings(const scene::Scene& scene, std::uint32_t max_depth) const {
  render::Settings settings = small_settings(scene, pixels, pixels, photons);
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = radius;
  settings.samples_per_pixel = samples_per_pixel;
  settings.max_depth = max_depth;
  settings.integrator = integrator;
  settings.nearest = nearest;
  return settings;
}

glm::dvec2 PlateView::point(double film_x, double film_y) const {
  const double up = eye.y > plate_height ? 1.0 : -1.0;
  return {eye.x + half * (2.0 * film_x / pixels - 1.0),
          eye.z + up * half * (2.0 * film_y / pixels - 1.0)};
}

Mesh plate(float height, float half, bool front_up) {
  const Mesh up = quad({-half, height, -half}, {0.0f, 0.0f, 2 * half}, {2 * half, 0.0f, 0.0f});
  return front_up ? up : inside_out(up);
}

void expect_irradiance(gpu::Device& device, const GltfWriter& writer, const PlateView& view,
                       glm::dvec3 albedo, const Irradiance& irradiance, std::uint32_t max_depth,
                       double slack) {
  expect_irradiance(device, load(writer), view, albedo, irradiance, max_depth, slack);
}

void expect_irradiance(gpu::Device& device, const scene::Scene& scene, const PlateView& view,
                       glm::dvec3 albedo, const Irradiance& irradiance, std::uint32_t max_depth,
                       double slack) {
  const std::uint32_t blocks = view.pixels / view.block;
  std::vector<Expected> expected;
  Expected all;
  for (std::uint32_t y = 0; y < blocks; ++y) {
    for (std::uint32_t x = 0; x < blocks; ++x) {
      expected.push_back(expected_radiance(view, albedo, irradiance, x, y));
      all.mean += expected.back().mean / static_cast<double>(blocks * blocks);
      all.bias += expected.back().bias / static_cast<double>(blocks * blocks);
    }
  }
  const render::Settings settings = view.settings(scene, max_depth);
  const Window window = whole(settings);
  auto estimates = replicate(device, scene, settings, view.passes, view.seeds,
                             [&](const render::Picture& picture) {
                               auto means = block_means(picture, view.block);
                               means.push_back(window_mean(picture, window));
                               return means;
                             });
  pool(estimates, expected);
  expected.push_back(all);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const glm::dvec3 bias = expected[i].bias + (slack + kQuadratureError) * expected[i].mean;
    EXPECT_TRUE(agrees(estimates[i], expected[i].mean, kSigmas, bias))
        << (i + 1 < expected.size() ? "block " + std::to_string(i) : "the whole picture");
  }
}

}  // namespace ppm::test
