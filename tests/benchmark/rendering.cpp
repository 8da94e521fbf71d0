#include <fmt/core.h>

#include "embree_rays.hpp"
#include "parts.hpp"
#include "passes.hpp"
#include "room.hpp"
#include "timing.hpp"

namespace ppm::benchmark {
namespace {

// The unit: closest hits of diffuse-bounce rays in the large room, in camera order.
class Unit {
 public:
  Unit(RTCDevice device, unsigned threads)
      : threads_(threads),
        room_(ppm::bench::make_room(ppm::bench::kLargeRoomTriangles)),
        embree_(device, room_.triangles),
        rays_(
            bounce_rays(embree_, room_.triangles, camera_rays(room_.cameras.front(), 1280, 960))) {}

  double rays_per_second() const { return benchmark::rays_per_second(embree_, rays_, threads_); }

 private:
  unsigned threads_;
  scene::Scene room_;
  EmbreeScene embree_;
  std::vector<Ray> rays_;
};

double product_median(const std::vector<double>& seconds,
                      const std::vector<double>& rays_per_second) {
  std::vector<double> millions;
  for (std::size_t i = 0; i < seconds.size(); ++i)
    millions.push_back(1e-6 * seconds[i] * rays_per_second[i]);
  return median(millions);
}

}  // namespace

void measure_rendering(const Bench& bench) {
  const Unit unit(bench.embree, bench.threads);
  const scene::Scene room = ppm::bench::make_room();
  const PassTimes times = measure_passes(bench.device, room, bench.threads, kRepeats,
                                         [&] { return unit.rays_per_second(); });
  fmt::print("\nRoom of {} triangles on {}: 640x480, 1 eye path a pixel, 100000 photons a pass\n",
             room.triangles.size(), bench.device.description().name);
  fmt::print(
      "Embree's diffuse bounces in the large room, {} threads: {:.2f} million rays a second\n",
      bench.threads, 1e-6 * median(times.unit_at_first));
  fmt::print("{:<34} {:>8} {:>20}\n", "", "ms", "million Embree rays");
  const auto row = [](const char* name, const std::vector<double>& seconds,
                      const std::vector<double>& units) {
    fmt::print("{:<34} {:>8.1f} {:>20.2f}\n", name, 1e3 * median(seconds),
               product_median(seconds, units));
  };
  row("before the first pass, all told", times.prepare, times.unit_at_start);
  row("eye pass", times.eye, times.unit_at_start);
  row("pass at the start", times.first, times.unit_at_first);
  row("pass once radii have halved", times.shrunk, times.unit_at_shrunk);
  fmt::print("of a pass at the start, by kernel, mean ms:");
  for (const auto& [kernel, seconds] : times.kernels)
    fmt::print("  {} {:.1f}", kernel, 1e3 * seconds);
  fmt::print("\n");
}

}  // namespace ppm::benchmark
