// From a scene built in a test to what its picture is expected to be.
//
// Pictures are noisy, so that expectations are about means over windows of pixels, replicated over
// seeds: runs with seeds 0, 1, ... are independent, while passes of one run are not samples of one
// distribution. What a test allows is `sigmas` standard errors plus a bias bound that it derives.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "device_fixture.hpp"
#include "gltf_writer.hpp"
#include "integrator.hpp"

namespace ppm::test {

/// Base of the fixtures in this folder: the shared device under validation that must stay silent.
using RenderTest = tests::DeviceTest;

/// Writes the scene as a .glb file and loads that. A warning of the loader fails the test.
scene::Scene load(const GltfWriter& writer);

/// Settings for tests: the scene's first camera, few pixels, one eye path a pixel, few photons.
render::Settings small_settings(const scene::Scene& scene, std::uint32_t width = 16,
                                std::uint32_t height = 16, std::uint64_t photons = 20000);

struct Rendering {
  render::Picture picture;
  render::Statistics statistics;
};

/// Prepares, makes `passes` passes, resolves. Photons or hit points that were rejected as not
/// finite and sums that overflowed fail the test, and so do cut paths when there are more of them
/// than one in 5000 photons (glass with interpolated normals traps a few).
Rendering render_scene(gpu::Device& device, const scene::Scene& scene,
                       const render::Settings& settings, unsigned passes);

/// Pixels [x0, x1) x [y0, y1) from the top left corner.
struct Window {
  std::uint32_t x0, y0, x1, y1;
};
inline Window whole(const render::Settings& settings) {
  return {0, 0, settings.width, settings.height};
}

glm::dvec3 pixel(const render::Picture& picture, std::uint32_t x, std::uint32_t y);
glm::dvec3 window_mean(const render::Picture& picture, Window window);
/// Means of all blocks of `size` x `size` pixels, row by row; both edges are multiples of it.
std::vector<glm::dvec3> block_means(const render::Picture& picture, std::uint32_t size);

/// A quantity by channel: mean over seeds, and that mean's standard error.
struct Estimate {
  glm::dvec3 mean{0.0}, standard_error{0.0};
};

/// Mean and standard error of each quantity over runs; runs[i][j] is quantity j of run i. At least
/// two runs.
std::vector<Estimate> summarize(const std::vector<std::vector<glm::dvec3>>& runs);

/// Renders with seeds 0 .. seeds-1 and summarizes what `measure` makes of each picture.
std::vector<Estimate> replicate(
    gpu::Device& device, const scene::Scene& scene, render::Settings settings, unsigned passes,
    unsigned seeds, const std::function<std::vector<glm::dvec3>(const render::Picture&)>& measure);
/// The same for one window.
Estimate replicate(gpu::Device& device, const scene::Scene& scene, const render::Settings& settings,
                   unsigned passes, unsigned seeds, Window window);

/// |mean - expected| <= sigmas * standard error + bias in every channel, with a message that shows
/// all terms. `bias` is absolute.
::testing::AssertionResult agrees(const Estimate& estimate, glm::dvec3 expected, double sigmas,
                                  glm::dvec3 bias);
inline ::testing::AssertionResult agrees(const Estimate& estimate, glm::dvec3 expected,
                                         double sigmas, double bias) {
  return agrees(estimate, expected, sigmas, glm::dvec3(bias));
}

}  // namespace ppm::test
