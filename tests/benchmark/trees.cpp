#include <fmt/core.h>

#include <array>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "bvh.hpp"
#include "embree_rays.hpp"
#include "embree_tree.hpp"
#include "kernel_rays.hpp"
#include "parts.hpp"
#include "room.hpp"
#include "terrain.hpp"
#include "timing.hpp"

namespace ppm::benchmark {
namespace {

// One builder's tree, and what was measured of it.
struct Candidate {
  const char* builder;
  bvh::Bvh tree{};
  std::vector<double> seconds{}, camera{}, bounces{};  // rays a second
};

enum { kOurs, kPlain, kSplit };

void build_all(const Bench& bench, std::span<const scene::Triangle> triangles,
               std::array<Candidate, 3>& candidates) {
  for (int i = 0; i < kRepeats; ++i) {
    candidates[kOurs].seconds.push_back(
        seconds_of([&] { candidates[kOurs].tree = bvh::build(triangles, bench.threads); }));
    for (const int k : {kPlain, kSplit}) {
      EmbreeTree built = build_embree_tree(bench.embree, triangles, k == kSplit);
      candidates[k].seconds.push_back(built.seconds);
      candidates[k].tree = std::move(built.tree);
    }
  }
}

// The same rays through all trees in turn.
void trace_all(const Bench& bench, std::span<const scene::Triangle> triangles,
               std::span<const Ray> rays, std::array<Candidate, 3>& candidates,
               std::vector<double> Candidate::*rates) {
  std::deque<KernelRays> kernels;
  for (const Candidate& candidate : candidates)
    kernels.emplace_back(bench.device, candidate.tree, triangles, rays).rays_per_second();
  for (int i = 0; i < kRayRepeats; ++i)
    for (std::size_t k = 0; k < kernels.size(); ++k)
      (candidates[k].*rates).push_back(kernels[k].rays_per_second());
}

double median_ratio(std::vector<double> values, const std::vector<double>& to) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] /= to[i];
  return median(std::move(values));
}

void compare_trees(const Bench& bench, const char* name, const scene::Scene& scene) {
  std::array<Candidate, 3> candidates{
      Candidate{"ours"}, {"Embree, objects only"}, {"Embree, spatial splits"}};
  build_all(bench, scene.triangles, candidates);
  const EmbreeScene embree(bench.embree, scene.triangles);
  const std::vector<Ray> camera = camera_rays(scene.cameras.front(), 640, 480);
  const std::vector<Ray> bounces = bounce_rays(embree, scene.triangles, camera);
  trace_all(bench, scene.triangles, camera, candidates, &Candidate::camera);
  trace_all(bench, scene.triangles, bounces, candidates, &Candidate::bounces);
  const Candidate& last = candidates[kSplit];
  for (const Candidate& c : candidates) {
    fmt::print("{:<16} {:<23} {:>7.1f} {:>7.2f} {:>7} {:>10} {:>6.2f} {:>6.3f} {:>7.3f} {:>7.3f}\n",
               name, c.builder, 1e3 * median(c.seconds), c.tree.sah_cost, c.tree.nodes.size(),
               c.tree.triangle_order.size(), median_ratio(c.seconds, last.seconds),
               c.tree.sah_cost / last.tree.sah_cost, median_ratio(c.camera, last.camera),
               median_ratio(c.bounces, last.bounces));
  }
}

}  // namespace

void measure_trees(const Bench& bench) {
  fmt::print("\nTrees built on {} threads, and rays a second through them by the kernels on {}\n",
             bench.threads, bench.device.description().name);
  fmt::print("{:>105}\n", "as a share of the last one's");
  fmt::print("{:<16} {:<23} {:>7} {:>7} {:>7} {:>10} {:>6} {:>6} {:>7} {:>7}\n", "scene", "builder",
             "ms", "SAH", "nodes", "references", "time", "SAH", "camera", "bounces");
  compare_trees(bench, "room", ppm::bench::make_room());
  compare_trees(bench, "large room", ppm::bench::make_room(ppm::bench::kLargeRoomTriangles));
  compare_trees(bench, "room of 1.5M", ppm::bench::make_room(1500000));
  compare_trees(bench, "terrain of 1.5M", make_terrain(1500000));
}

}  // namespace ppm::benchmark
