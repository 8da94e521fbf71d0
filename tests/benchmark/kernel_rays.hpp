// The renderer's own traversal, by itself.
#pragma once

#include <span>

#include "bvh.hpp"
#include "embree_rays.hpp"
#include "kernel.hpp"

namespace ppm::benchmark {

/// Traces given rays through a tree with the kernels' traversal.
class KernelRays {
 public:
  KernelRays(gpu::Device& device, const bvh::Bvh& tree, std::span<const scene::Triangle> triangles,
             std::span<const Ray> rays);
  KernelRays(const KernelRays&) = delete;
  KernelRays& operator=(const KernelRays&) = delete;

  /// Closest hits a second, by the wall clock.
  double rays_per_second();
  /// Distances of the hits found last, 1e30 where nothing was hit.
  std::vector<float> distances() const;

 private:
  gpu::Device& device_;
  std::size_t count_;
  gpu::Kernel kernel_;
  gpu::Buffer constants_, nodes_, positions_, rays_, hits_;
  gpu::BindingTable table_;
};

}  // namespace ppm::benchmark
