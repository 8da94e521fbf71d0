#include "render_harness.hpp"

#include <cmath>
#include <stdexcept>

#include "load_gltf.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

bool never() {
  return false;
}

}  // namespace

scene::Scene load(const GltfWriter& writer) {
  const TemporaryFolder folder;
  writer.write(folder / "scene.glb");
  Log log(Verbosity::quiet);
  scene::Scene scene = scene::load_gltf(folder / "scene.glb", log);
  for (const std::string& warning : log.warnings()) ADD_FAILURE() << warning;
  return scene;
}

render::Settings small_settings(const scene::Scene& scene, std::uint32_t width,
                                std::uint32_t height, std::uint64_t photons) {
  render::Settings settings;
  settings.width = width;
  settings.height = height;
  settings.photons_per_pass = photons;
  settings.samples_per_pixel = 1;
  settings.camera = scene.cameras.at(0);
  settings.photon_capacity = 1u << 19;
  return settings;
}

Rendering render_scene(gpu::Device& device, const scene::Scene& scene,
                       const render::Settings& settings, unsigned passes) {
  Log log(Verbosity::quiet);
  const auto integrator = render::make_integrator(settings, scene, device, log, 2);
  if (!integrator->prepare(never)) throw std::logic_error("prepare was interrupted by nobody");
  for (std::uint64_t made = 0, now = 0; made < passes; made += now) {
    now = integrator->advance_up_to(passes - made, never);
    if (now == 0) throw std::logic_error("a pass was interrupted by nobody");
  }
  Rendering rendering{integrator->resolve(), integrator->statistics()};
  const auto& rejected = rendering.statistics.rejected;
  for (const char* kind : {"non_finite", "overflow"}) {
    const auto entry = rejected.find(kind);
    EXPECT_TRUE(entry == rejected.end() || entry->second == 0) << kind << " was rejected";
  }
  EXPECT_LE(rendering.statistics.paths_cut, rendering.statistics.photons_emitted / 5000);
  return rendering;
}

glm::dvec3 pixel(const render::Picture& picture, std::uint32_t x, std::uint32_t y) {
  const std::size_t first = 3 * (std::size_t{y} * picture.width + x);
  return {picture.rgb.at(first), picture.rgb.at(first + 1), picture.rgb.at(first + 2)};
}

glm::dvec3 window_mean(const render::Picture& picture, Window window) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t y = window.y0; y < window.y1; ++y)
    for (std::uint32_t x = window.x0; x < window.x1; ++x) sum += pixel(picture, x, y);
  return sum / (static_cast<double>(window.x1 - window.x0) * (window.y1 - window.y0));
}

std::vector<glm::dvec3> block_means(const render::Picture& picture, std::uint32_t size) {
  if (size == 0 || picture.width % size != 0 || picture.height % size != 0)
    throw std::invalid_argument("blocks must tile the picture");
  std::vector<glm::dvec3> means;
  for (std::uint32_t y = 0; y < picture.height; y += size)
    for (std::uint32_t x = 0; x < picture.width; x += size)
      means.push_back(window_mean(picture, {x, y, x + size, y + size}));
  return means;
}

std::vector<Estimate> summarize(const std::vector<std::vector<glm::dvec3>>& runs) {
  const double count = static_cast<double>(runs.size());
  if (runs.size() < 2) throw std::invalid_argument("a standard error needs two runs");
  std::vector<Estimate> estimates(runs[0].size());
  for (std::size_t j = 0; j < estimates.size(); ++j) {
    glm::dvec3 squares(0.0);
    for (const auto& run : runs) estimates[j].mean += run.at(j) / count;
    for (const auto& run : runs) {
      const glm::dvec3 difference = run[j] - estimates[j].mean;
      squares += difference * difference;
    }
    estimates[j].standard_error = glm::sqrt(squares / (count * (count - 1.0)));
  }
  return estimates;
}

std::vector<Estimate> replicate(
    gpu::Device& device, const scene::Scene& scene, render::Settings settings, unsigned passes,
    unsigned seeds, const std::function<std::vector<glm::dvec3>(const render::Picture&)>& measure) {
  std::vector<std::vector<glm::dvec3>> runs;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    settings.seed = seed;
    runs.push_back(measure(render_scene(device, scene, settings, passes).picture));
  }
  return summarize(runs);
}

Estimate replicate(gpu::Device& device, const scene::Scene& scene, const render::Settings& settings,
                   unsigned passes, unsigned seeds, Window window) {
  return replicate(device, scene, settings, passes, seeds,
                   [window](const render::Picture& picture) {
                     return std::vector<glm::dvec3>{window_mean(picture, window)};
                   })
      .at(0);
}

::testing::AssertionResult agrees(const Estimate& estimate, glm::dvec3 expected, double sigmas,
                                  glm::dvec3 bias) {
  for (int channel = 0; channel < 3; ++channel) {
    const double error = estimate.mean[channel] - expected[channel];
    const double allowed = sigmas * estimate.standard_error[channel] + bias[channel];
    if (std::isfinite(error) && std::abs(error) <= allowed) continue;
    return ::testing::AssertionFailure()
           << "channel " << channel << ": " << estimate.mean[channel] << " instead of "
           << expected[channel] << ", off by " << error << "; allowed are " << sigmas << " * "
           << estimate.standard_error[channel] << " + " << bias[channel];
  }
  return ::testing::AssertionSuccess();
}

}  // namespace ppm::test
