#include "kernel_rays.hpp"

#include <chrono>

#include "ppm_benchmark_shaders.hpp"

namespace ppm::benchmark {
namespace {

struct RayTexels {
  glm::vec4 origin, direction;
};

std::vector<RayTexels> texels_of(std::span<const Ray> rays) {
  std::vector<RayTexels> texels;
  for (const Ray& ray : rays)
    texels.push_back({glm::vec4(ray.origin, 0.0f), glm::vec4(ray.direction, 0.0f)});
  return texels;
}

std::vector<shared::TrianglePositions> positions_of(const bvh::Bvh& tree,
                                                    std::span<const scene::Triangle> triangles) {
  std::vector<shared::TrianglePositions> positions;
  for (const std::uint32_t index : tree.triangle_order) {
    const auto& corners = triangles[index].corners;
    positions.push_back({corners[0].position, triangles[index].material, corners[1].position, 0,
                         corners[2].position, 0});
  }
  return positions;
}

shared::SceneConstants constants_of(const bvh::Bvh& tree) {
  shared::SceneConstants constants{};
  constants.grid_origin = tree.grid_origin;
  constants.grid_step = tree.grid_step;
  return constants;
}

template <class T>
gpu::Buffer texel_buffer(gpu::Device& device, const char* name, const std::vector<T>& values) {
  return gpu::make_buffer(device, name, std::span<const T>(values), gpu::Usage::texels);
}

}  // namespace

KernelRays::KernelRays(gpu::Device& device, const bvh::Bvh& tree,
                       std::span<const scene::Triangle> triangles, std::span<const Ray> rays)
    : device_(device),
      count_(rays.size()),
      kernel_(device, shaders::trace),
      constants_(device, "constants", sizeof(shared::SceneConstants), gpu::Usage::uniform),
      nodes_(texel_buffer(device, "nodes", tree.nodes)),
      positions_(texel_buffer(device, "positions", positions_of(tree, triangles))),
      rays_(texel_buffer(device, "rays", texels_of(rays))),
      hits_(device, "hits", count_ * sizeof(glm::uvec2), gpu::Usage::storage) {
  const shared::SceneConstants constants = constants_of(tree);
  constants_.upload(&constants, sizeof(constants));
  table_.set(PPM_BIND_SCENE_CONSTANTS, constants_);
  table_.set(PPM_BIND_BVH_NODES, nodes_);
  table_.set(PPM_BIND_TRIANGLE_POSITIONS, positions_);
  table_.set(PPM_BIND_TEST_0, rays_);
  table_.set(PPM_BIND_TEST_1, hits_);
}

double KernelRays::rays_per_second() {
  struct Push {
    std::uint32_t first, count;
  };
  const auto start = std::chrono::steady_clock::now();
  device_.run([&](gpu::Recorder& recorder) { recorder.dispatch(kernel_, table_, Push{}, count_); });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return static_cast<double>(count_) / seconds.count();
}

std::vector<float> KernelRays::distances() const {
  std::vector<float> distances;
  for (const glm::uvec2 hit : hits_.download<glm::uvec2>(count_))
    distances.push_back(glm::uintBitsToFloat(hit.y));
  return distances;
}

}  // namespace ppm::benchmark
