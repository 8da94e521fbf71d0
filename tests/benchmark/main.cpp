// The developer's benchmark: measured beside Embree in the same run, alternately, so that figures
// hold on machines whose speed wanders. Medians of five repeats. Run it on an idle machine:
// ppm_benchmark [THREADS]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "bvh.hpp"
#include "device.hpp"
#include "embree_rays.hpp"
#include "embree_tree.hpp"
#include "failure.hpp"
#include "kernel_rays.hpp"
#include "passes.hpp"
#include "room.hpp"
#include "terrain.hpp"

namespace ppm::benchmark {
namespace {

constexpr int kRepeats = 5;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

template <typename Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Rays whose hit lies elsewhere than Embree says. Both work in float, and what is nearer than
// Embree's rays start does not count.
std::size_t count_different(const EmbreeScene& embree, std::span<const Ray> rays,
                            const std::vector<float>& distances) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    float expected = 1e30f;
    embree.intersect(rays[i], expected);
    const float tolerance = 1e-4f * std::max(1.0f, expected);
    count += std::abs(distances[i] - expected) > tolerance && distances[i] > 2e-5f;
  }
  return count;
}

// Traversal by itself: the same rays through the kernels and through Embree.
void compare_rays(gpu::Device& device, const EmbreeScene& embree, const bvh::Bvh& tree,
                  const char* scene_name, const char* name,
                  std::span<const scene::Triangle> triangles, std::span<const Ray> rays,
                  unsigned threads) {
  KernelRays kernel(device, tree, triangles, rays);
  kernel.rays_per_second();  // compiles
  std::vector<double> theirs, ours, ratio;
  for (int i = 0; i < kRepeats; ++i) {
    const double before = rays_per_second(embree, rays, threads);
    ours.push_back(kernel.rays_per_second());
    theirs.push_back(0.5 * (before + rays_per_second(embree, rays, threads)));
    ratio.push_back(ours.back() / theirs.back());
  }
  fmt::print("{:<20} {:<18} {:>8.2f} {:>8.2f} {:>8.2f} {:>10}\n", scene_name, name,
             1e-6 * median(ours), 1e-6 * median(theirs), median(ratio),
             count_different(embree, rays, kernel.distances()));
}

void measure_traversal(gpu::Device& device, RTCDevice embree_device, unsigned threads) {
  fmt::print("\nClosest hits, million a second: kernels on {}, rtcIntersect1 on {} threads\n",
             device.description().name, threads);
  fmt::print("{:<20} {:<18} {:>8} {:>8} {:>8} {:>10}\n", "scene", "rays", "kernels", "Embree",
             "ratio", "different");
  struct View {
    const char* name;
    scene::Scene scene;
  };
  for (const View& view : {View{"large room", bench::make_room(bench::kLargeRoomTriangles)},
                           View{"terrain of 1.5M", make_terrain(1500000)}}) {
    const std::span<const scene::Triangle> triangles = view.scene.triangles;
    const EmbreeScene embree(embree_device, triangles);
    const bvh::Bvh tree = bvh::build(triangles, threads);
    const std::vector<Ray> camera = camera_rays(view.scene.cameras.front(), 640, 480);
    std::vector<Ray> bounces = bounce_rays(embree, triangles, camera);
    compare_rays(device, embree, tree, view.name, "camera", triangles, camera, threads);
    compare_rays(device, embree, tree, view.name, "diffuse bounce", triangles, bounces, threads);
    std::shuffle(bounces.begin(), bounces.end(), std::mt19937(1));
    compare_rays(device, embree, tree, view.name, "the same, shuffled", triangles, bounces,
                 threads);
  }
}

void compare_trees(RTCDevice embree, const char* name, const scene::Scene& scene,
                   unsigned threads) {
  std::vector<double> ours, plain, split;
  bvh::Bvh tree;
  EmbreeTree plain_tree, split_tree;
  for (int i = 0; i < kRepeats; ++i) {
    ours.push_back(seconds_of([&] { tree = bvh::build(scene.triangles, threads); }));
    plain_tree = build_embree_tree(embree, scene.triangles, false);
    plain.push_back(plain_tree.seconds);
    split_tree = build_embree_tree(embree, scene.triangles, true);
    split.push_back(split_tree.seconds);
  }
  const auto row = [&](const char* builder, double seconds, double cost, std::size_t nodes) {
    fmt::print("{:<22} {:>9} {:<26} {:>8.1f} {:>8.2f} {:>9} {:>8.2f} {:>8.3f}\n", name,
               scene.triangles.size(), builder, 1e3 * seconds, cost, nodes, seconds / median(split),
               cost / split_tree.sah_cost);
  };
  row("ours", median(ours), tree.sah_cost, tree.nodes.size());
  row("Embree, objects only", median(plain), plain_tree.sah_cost, plain_tree.nodes);
  row("Embree, spatial splits", median(split), split_tree.sah_cost, split_tree.nodes);
}

// The unit: closest hits of diffuse-bounce rays in the large room, in camera order.
class Unit {
 public:
  Unit(RTCDevice device, unsigned threads)
      : threads_(threads),
        room_(bench::make_room(bench::kLargeRoomTriangles)),
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

void measure_rendering(gpu::Device& device, const Unit& unit, unsigned threads) {
  const scene::Scene room = bench::make_room();
  const PassTimes times =
      measure_passes(device, room, threads, kRepeats, [&] { return unit.rays_per_second(); });
  fmt::print("\nRoom of {} triangles on {}: 640x480, 1 eye path a pixel, 100000 photons a pass\n",
             room.triangles.size(), device.description().name);
  fmt::print(
      "Embree's diffuse bounces in the large room, {} threads: {:.2f} million rays a second\n",
      threads, 1e-6 * median(times.unit_at_first));
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

void measure_trees(RTCDevice embree, unsigned threads) {
  fmt::print("\nBuilding trees on {} threads\n{:<22} {:>9} {:<26} {:>8} {:>8} {:>9} {:>8} {:>8}\n",
             threads, "scene", "triangles", "builder", "ms", "SAH", "nodes", "time", "SAH");
  fmt::print("{:>101}\n", "as a share of the last");
  compare_trees(embree, "room", bench::make_room(), threads);
  compare_trees(embree, "large room", bench::make_room(bench::kLargeRoomTriangles), threads);
  compare_trees(embree, "room of 1.5M", bench::make_room(1500000), threads);
  compare_trees(embree, "terrain of 1.5M", make_terrain(1500000), threads);
}

int run(unsigned threads) {
  const RTCDevice embree = rtcNewDevice(fmt::format("threads={}", threads).c_str());
  gpu::Device device({});
  measure_rendering(device, Unit(embree, threads), threads);
  measure_traversal(device, embree, threads);
  measure_trees(embree, threads);
  rtcReleaseDevice(embree);
  return 0;
}

}  // namespace
}  // namespace ppm::benchmark

int main(int argc, char** argv) {
  const long wanted =
      argc > 1 ? std::strtol(argv[1], nullptr, 10) : std::thread::hardware_concurrency();
  if (argc > 2 || wanted < 1 || wanted > 1024) {
    fmt::print(stderr, "usage: ppm_benchmark [THREADS]\n");
    return 2;
  }
  try {
    return ppm::benchmark::run(static_cast<unsigned>(wanted));
  } catch (const ppm::Failure& failure) {
    fmt::print(stderr, "ppm_benchmark: {}\n", failure.what());
    return 1;
  }
}
