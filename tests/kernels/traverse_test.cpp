// Traversal on the device against brute force in double, and a closed mesh that lets nothing out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "brute_force_rays.hpp"
#include "buffer.hpp"
#include "bvh.hpp"
#include "device_fixture.hpp"
#include "kernel.hpp"
#include "ppm_pass_test_shaders.hpp"
#include "randoms.hpp"
#include "scene_buffers.hpp"
#include "scene_pieces.hpp"

namespace ppm::tests {
namespace {

using glm::vec3;

struct ProbePush {
  std::uint32_t first = 0, count = 0, refuse_odd = 0;
};

class Traverse : public DeviceTest {
 protected:
  std::vector<ProbeHit> trace(const scene::Scene& scene, std::span<const ProbeRay> rays,
                              bool refuse_odd = false) {
    const render::SceneBuffers buffers(scene, small_settings(), device(), 1);
    const gpu::Kernel kernel(device(), shaders::traverse_probe);
    const gpu::Buffer ray_buffer =
        gpu::make_buffer(device(), "probe rays", rays, gpu::Usage::storage);
    const gpu::Buffer hits(device(), "probe hits", rays.size() * sizeof(ProbeHit),
                           gpu::Usage::storage);
    gpu::BindingTable table;
    buffers.bind(table);
    table.set(PPM_BIND_TEST_0, ray_buffer);
    table.set(PPM_BIND_TEST_1, hits);
    device().run([&](gpu::Recorder& recorder) {
      recorder.dispatch(kernel, table, ProbePush{0, 0, refuse_odd ? 1u : 0u}, rays.size());
    });
    return hits.download<ProbeHit>(rays.size());
  }

  /// Corners in the order of the slots that the kernel reports.
  static std::vector<Corners> in_slot_order(const scene::Scene& scene) {
    std::vector<Corners> corners;
    for (const std::uint32_t index : bvh::build(scene.triangles, 1).triangle_order) {
      const auto& of = scene.triangles[index].corners;
      corners.push_back({{of[0].position, of[1].position, of[2].position}});
    }
    return corners;
  }

  Agreement check(const scene::Scene& scene, std::span<const ProbeRay> rays,
                  bool refuse_odd = false) {
    const std::vector<Corners> triangles = in_slot_order(scene);
    const Agreement agreement =
        compare_with_brute_force(rays, trace(scene, rays, refuse_odd), triangles, refuse_odd);
    EXPECT_EQ(agreement.faults, 0u) << agreement.first_fault;
    return agreement;
  }
};

ProbeRay make_ray(vec3 origin, vec3 direction, float t_max = 1e30f,
                  std::uint32_t skip = PPM_NO_TRIANGLE) {
  return {origin, t_max, direction, skip};
}

std::vector<ProbeRay> inner_rays(std::size_t count, Randoms& random) {
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    rays.push_back(make_ray(random.in_cube(1.2f), random.direction(), random.in(0.0f, 1.0f)));
  }
  return rays;
}

// Along the axes, with zeros of both signs.
std::vector<ProbeRay> axis_rays(std::size_t count, Randoms& random) {
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const int axis = static_cast<int>(i % 3);
    vec3 direction(i % 4 < 2 ? 0.0f : -0.0f);
    direction[axis] = i % 2 == 0 ? 1.0f : -1.0f;
    rays.push_back(make_ray(random.in_cube(1.0f), direction, random.in(0.0f, 1.0f)));
  }
  return rays;
}

// From a thousand scene sizes away, aimed at points within.
std::vector<ProbeRay> far_rays(std::size_t count, Randoms& random) {
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const vec3 origin = random.direction() * 1000.0f;
    const vec3 direction = glm::normalize(random.in_cube(0.8f) - origin);
    rays.push_back(make_ray(origin, direction, random.in(999.0f, 1001.0f)));
  }
  return rays;
}

// From points on triangles, which they skip.
std::vector<ProbeRay> surface_rays(std::size_t count, std::span<const Corners> triangles,
                                   Randoms& random) {
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t slot = random.below(triangles.size());
    const auto& corner = triangles[slot].corner;
    const float u = random.in(0.0f, 1.0f);
    const float v = random.in(0.0f, 1.0f - u);
    const vec3 origin = corner[0] * (1.0f - u - v) + corner[1] * u + corner[2] * v;
    rays.push_back(make_ray(origin, random.direction(), random.in(0.0f, 1.0f), slot));
  }
  return rays;
}

std::vector<ProbeRay> all_rays(std::span<const Corners> triangles, std::uint32_t seed) {
  Randoms random(seed);
  std::vector<ProbeRay> rays;
  const auto add = [&](std::vector<ProbeRay> more) {
    rays.insert(rays.end(), more.begin(), more.end());
  };
  add(inner_rays(1500, random));
  add(axis_rays(600, random));
  add(far_rays(600, random));
  add(surface_rays(600, triangles, random));
  return rays;
}

scene::Triangle random_triangle(vec3 centre, float size, Randoms& random) {
  return make_triangle(centre + random.in_cube(size), centre + random.in_cube(size),
                       centre + random.in_cube(size));
}

scene::Scene random_scene() {
  Randoms random(1);
  std::vector<scene::Triangle> triangles;
  for (int i = 0; i < 1000; ++i)
    triangles.push_back(random_triangle(random.in_cube(0.9f), random.in(0.02f, 0.2f), random));
  return scene_of(std::move(triangles));
}

// Slivers, triangles without area, huge ones among tiny ones.
scene::Scene hostile_scene() {
  Randoms random(2);
  std::vector<scene::Triangle> triangles;
  for (int i = 0; i < 300; ++i) {
    const vec3 a = random.in_cube(1.0f);
    const vec3 b = random.in_cube(1.0f);
    const vec3 centre = random.in_cube(0.9f);
    const vec3 thin = a + (b - a) * random.in(0.0f, 1.0f) + random.in_cube(1e-4f);
    triangles.push_back(make_triangle(a, b, thin));
    triangles.push_back(make_triangle(a, b, i % 2 == 0 ? a : 0.5f * (a + b)));
    triangles.push_back(make_triangle(centre, centre, centre));
    triangles.push_back(random_triangle(centre, 1e-4f, random));
    triangles.push_back(random_triangle(centre, 0.05f, random));
  }
  for (int i = 0; i < 6; ++i) triangles.push_back(random_triangle(vec3(0.0f), 1.0f, random));
  return scene_of(std::move(triangles));
}

TEST_F(Traverse, RandomTriangles) {
  const scene::Scene scene = random_scene();
  const std::vector<ProbeRay> rays = all_rays(in_slot_order(scene), 11);
  const Agreement agreement = check(scene, rays);
  // The band must leave most rays no choice, or the comparison means nothing.
  EXPECT_GT(agreement.hits, rays.size() / 3);
  EXPECT_GT(agreement.any, rays.size() / 6);
  EXPECT_GT(agreement.sure, agreement.hits * 3 / 4);
}

TEST_F(Traverse, SliversPointsHugeAndTinyTriangles) {
  const scene::Scene scene = hostile_scene();
  const std::vector<ProbeRay> rays = all_rays(in_slot_order(scene), 12);
  const Agreement agreement = check(scene, rays);
  EXPECT_GT(agreement.hits, rays.size() / 5);
  EXPECT_GT(agreement.sure, agreement.hits / 3);
}

TEST_F(Traverse, TinyTrianglesAreHit) {
  const scene::Scene scene = hostile_scene();
  const std::vector<Corners> triangles = in_slot_order(scene);
  Randoms random(13);
  std::vector<ProbeRay> rays;
  for (const auto& [corner] : triangles) {
    const vec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0f;
    const vec3 direction = random.direction();
    rays.push_back(make_ray(middle - direction * 0.01f, direction, 0.02f));
  }
  EXPECT_GT(check(scene, rays).hits, 600u);
}

TEST_F(Traverse, FilterRefusesHits) {
  const scene::Scene scene = random_scene();
  const std::vector<ProbeRay> rays = all_rays(in_slot_order(scene), 14);
  const Agreement all = check(scene, rays);
  const Agreement even = check(scene, rays, true);
  EXPECT_LT(even.any, all.any);
  EXPECT_LT(even.hits, all.hits);
  EXPECT_GT(even.hits, rays.size() / 5);
}

TEST_F(Traverse, FlatScene) {
  scene::Scene scene;
  add_plate(scene, {-1, -1, 0.25f}, {2, 0, 0}, {0, 2, 0}, 0, 24, 24);
  scene = finished(scene);
  Randoms random(15);
  std::vector<ProbeRay> rays = all_rays(in_slot_order(scene), 16);
  for (int i = 0; i < 500; ++i) {  // within the plane itself: nothing may be made of it
    const float angle = random.in(0.0f, 6.28f);
    rays.push_back(make_ray({random.in(-2.0f, 2.0f), random.in(-2.0f, 2.0f), 0.25f},
                            {std::cos(angle), std::sin(angle), 0.0f}));
  }
  EXPECT_GT(check(scene, rays).hits, rays.size() / 6);
}

TEST_F(Traverse, SingleTriangle) {
  const scene::Scene scene = scene_of({make_triangle({-1, -1, -1}, {1, -0.5f, 0}, {0, 1, 1})});
  const std::vector<ProbeRay> rays = all_rays(in_slot_order(scene), 17);
  EXPECT_GT(check(scene, rays).hits, rays.size() / 20);
  std::vector<ProbeRay> skipping(rays.begin(), rays.end());
  for (ProbeRay& ray : skipping) ray.skip = 0;
  EXPECT_EQ(check(scene, skipping).hits, 0u);
}

TEST_F(Traverse, EmptyScene) {
  const scene::Scene scene = scene_of({});
  Randoms random(18);
  std::vector<ProbeRay> rays = inner_rays(100, random);
  for (const ProbeRay& ray : far_rays(100, random)) rays.push_back(ray);
  const Agreement agreement = check(scene, rays);
  EXPECT_EQ(agreement.hits + agreement.any, 0u);
}

// A sphere of 20 * 4^levels triangles; neighbours share corners to the bit.
class Icosphere {
 public:
  Icosphere(int levels, float radius, vec3 centre) : radius_(radius), centre_(centre) {
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    for (int i = 0; i < 12; ++i) {
      const double one = i % 2 == 0 ? 1.0 : -1.0;
      const double g = i / 2 % 2 == 0 ? golden : -golden;
      const int axis = i / 4;
      glm::dvec3 v(0.0);
      v[(axis + 1) % 3] = one;
      v[(axis + 2) % 3] = g;
      unit_.push_back(glm::normalize(v));
    }
    add_icosahedron();
    for (int level = 0; level < levels; ++level) refine();
  }

  std::size_t vertex_count() const { return unit_.size(); }
  vec3 vertex(std::size_t index) const { return centre_ + radius_ * vec3(unit_[index]); }
  const std::vector<glm::uvec3>& faces() const { return faces_; }

  scene::Scene scene() const {
    std::vector<scene::Triangle> triangles;
    for (const glm::uvec3& face : faces_)
      triangles.push_back(make_triangle(vertex(face.x), vertex(face.y), vertex(face.z)));
    return scene_of(std::move(triangles));
  }

 private:
  void add_icosahedron() {
    // All triples of vertices at the shortest distance from each other.
    const double edge = 2.0 / std::sqrt(0.5 * (5.0 + std::sqrt(5.0)));
    const auto near = [&](std::uint32_t i, std::uint32_t j) {
      return glm::length(unit_[i] - unit_[j]) < 1.01 * edge;
    };
    for (std::uint32_t i = 0; i < 12; ++i) {
      for (std::uint32_t j = i + 1; j < 12; ++j) {
        for (std::uint32_t k = j + 1; k < 12; ++k) {
          if (near(i, j) && near(j, k) && near(i, k)) faces_.push_back({i, j, k});
        }
      }
    }
  }

  std::uint32_t middle(std::uint32_t i, std::uint32_t j) {
    const auto [entry, fresh] =
        middles_.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(unit_.size()));
    if (fresh) unit_.push_back(glm::normalize(unit_[i] + unit_[j]));
    return entry->second;
  }

  void refine() {
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& f : faces_) {
      const std::uint32_t a = middle(f.y, f.z), b = middle(f.z, f.x), c = middle(f.x, f.y);
      finer.insert(finer.end(), {{f.x, c, b}, {f.y, a, c}, {f.z, b, a}, {a, b, c}});
    }
    faces_ = std::move(finer);
    middles_.clear();
  }

  float radius_;
  vec3 centre_;
  std::vector<glm::dvec3> unit_;
  std::vector<glm::uvec3> faces_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

TEST_F(Traverse, NothingEscapesAClosedMesh) {
  const Icosphere sphere(5, 0.9f, {0.03f, -0.02f, 0.05f});
  const scene::Scene scene = sphere.scene();
  ASSERT_EQ(scene.triangles.size(), 20480u);
  ASSERT_EQ(sphere.vertex_count(), 10242u);  // closed: V - E + F = 2
  Randoms random(19);
  std::vector<ProbeRay> rays;
  for (int i = 0; i < 1000000; ++i) {
    const vec3 origin = random.direction() * random.in(0.0f, 0.8f);
    const glm::uvec3 face = sphere.faces()[random.below(sphere.faces().size())];
    const vec3 a = sphere.vertex(face.x);
    const vec3 target = i % 2 == 0 ? a : 0.5f * (a + sphere.vertex(face.y));
    rays.push_back(make_ray(origin, glm::normalize(target - origin), 3.0f));
  }
  const std::vector<ProbeHit> hits = trace(scene, rays);
  std::size_t escaped = 0, unseen = 0, astray = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].triangle == PPM_NO_TRIANGLE) {
      ++escaped;
      continue;
    }
    unseen += hits[i].any == 0 ? 1 : 0;
    // All of the mesh lies within half a sagitta of its sphere.
    const vec3 at = rays[i].origin + rays[i].direction * hits[i].t;
    const float off = glm::length(at - vec3(0.03f, -0.02f, 0.05f)) - 0.9f;
    astray += std::abs(off) > 1e-3f ? 1 : 0;
  }
  EXPECT_EQ(escaped, 0u);
  EXPECT_EQ(unseen, 0u);
  EXPECT_EQ(astray, 0u);
}

}  // namespace
}  // namespace ppm::tests
