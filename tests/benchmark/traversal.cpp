#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "bvh.hpp"
#include "embree_rays.hpp"
#include "kernel_rays.hpp"
#include "parts.hpp"
#include "room.hpp"
#include "terrain.hpp"
#include "timing.hpp"

namespace ppm::benchmark {
namespace {

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

void compare_rays(const Bench& bench, const EmbreeScene& embree, const bvh::Bvh& tree,
                  const char* scene_name, const char* name,
                  std::span<const scene::Triangle> triangles, std::span<const Ray> rays) {
  KernelRays kernel(bench.device, tree, triangles, rays);
  kernel.rays_per_second();  // compiles
  std::vector<double> theirs, ours, ratio;
  for (int i = 0; i < kRayRepeats; ++i) {
    const double before = rays_per_second(embree, rays, bench.threads);
    ours.push_back(kernel.rays_per_second());
    theirs.push_back(0.5 * (before + rays_per_second(embree, rays, bench.threads)));
    ratio.push_back(ours.back() / theirs.back());
  }
  fmt::print("{:<20} {:<18} {:>8.2f} {:>8.2f} {:>8.2f} {:>10}\n", scene_name, name,
             1e-6 * median(ours), 1e-6 * median(theirs), median(ratio),
             count_different(embree, rays, kernel.distances()));
}

}  // namespace

void measure_traversal(const Bench& bench) {
  fmt::print("\nClosest hits, million a second: kernels on {}, rtcIntersect1 on {} threads\n",
             bench.device.description().name, bench.threads);
  fmt::print("{:<20} {:<18} {:>8} {:>8} {:>8} {:>10}\n", "scene", "rays", "kernels", "Embree",
             "ratio", "different");
  struct View {
    const char* name;
    scene::Scene scene;
  };
  for (const View& view :
       {View{"large room", ppm::bench::make_room(ppm::bench::kLargeRoomTriangles)},
        View{"terrain of 1.5M", make_terrain(1500000)}}) {
    const std::span<const scene::Triangle> triangles = view.scene.triangles;
    const EmbreeScene embree(bench.embree, triangles);
    const bvh::Bvh tree = bvh::build(triangles, bench.threads);
    const std::vector<Ray> camera = camera_rays(view.scene.cameras.front(), 640, 480);
    std::vector<Ray> bounces = bounce_rays(embree, triangles, camera);
    compare_rays(bench, embree, tree, view.name, "camera", triangles, camera);
    compare_rays(bench, embree, tree, view.name, "diffuse bounce", triangles, bounces);
    std::shuffle(bounces.begin(), bounces.end(), std::mt19937(1));
    compare_rays(bench, embree, tree, view.name, "the same, shuffled", triangles, bounces);
  }
}

}  // namespace ppm::benchmark
