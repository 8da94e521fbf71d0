#include "passes.hpp"

#include <memory>

#include "integrator.hpp"
#include "measure.hpp"
#include "timing.hpp"

namespace ppm::benchmark {
namespace {

bool never() {
  return false;
}

}  // namespace

PassTimes measure_passes(gpu::Device& device, const scene::Scene& scene, unsigned threads,
                         int repeats, const std::function<double()>& unit) {
  render::Settings settings;
  settings.samples_per_pixel = 1;
  settings.camera = scene.cameras.front();
  Log log(Verbosity::quiet);
  PassTimes times;
  std::unique_ptr<render::Integrator> integrator;
  // The mean of the unit before and after, lest it wander meanwhile.
  const auto beside_unit = [&](std::vector<double>& units, const auto& work) {
    const double before = unit();
    work();
    units.push_back(0.5 * (before + unit()));
  };
  for (int i = 0; i < repeats; ++i) {
    integrator.reset();
    integrator = render::make_integrator(settings, scene, device, log, threads);
    beside_unit(times.unit_at_start,
                [&] { times.prepare.push_back(seconds_of([&] { integrator->prepare(never); })); });
    times.eye.push_back(integrator->statistics().seconds.at("eye"));
    integrator->advance(never);
    const auto before = device.times();
    beside_unit(times.unit_at_first,
                [&] { times.first.push_back(seconds_of([&] { integrator->advance(never); })); });
    for (const auto& [kernel, time] : device.times()) {
      const double earlier = before.count(kernel) > 0 ? before.at(kernel).seconds : 0.0;
      if (time.seconds > earlier) times.kernels[kernel] += (time.seconds - earlier) / repeats;
    }
  }
  const std::uint64_t half = bench::passes_until_half(settings.alpha);
  for (std::uint64_t pass = 2; pass < half; ++pass) integrator->advance(never);
  for (int i = 0; i < repeats; ++i) {
    beside_unit(times.unit_at_shrunk,
                [&] { times.shrunk.push_back(seconds_of([&] { integrator->advance(never); })); });
  }
  return times;
}

}  // namespace ppm::benchmark
