// The hierarchy by itself, without a device: what it promises, and rays through it against all
// triangles.
#include "bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bvh_scenes.hpp"

namespace ppm::bvh {
namespace {

using scene::Triangle;
using shared::BvhNode;
// ---- Reading a hierarchy
// --------------------------------------------------------------------------------

struct Planes {
  glm::uvec3 lower, upper;
};

Planes planes_of(const BvhNode& node, int slot) {
  const auto planes = [&](int word) {
    const glm::uvec3 words(node.box_x[word], node.box_y[word], node.box_z[word]);
    return slot % 2 == 0 ? words & 0xffffu : words >> 16u;
  };
  return {planes(slot / 2), planes(2 + slot / 2)};
}

bool is_leaf(std::uint32_t child) {
  return (child & PPM_BVH_LEAF) != 0;
}
std::uint32_t leaf_first(std::uint32_t child) {
  return child & 0x1fffffffu;
}
std::uint32_t leaf_count(std::uint32_t child) {
  return ((child >> 29) & 3u) + 1;
}

// Visits every child that is there with the bounds, in float, that all boxes on its way have in
// common.
struct Walk {
  const Bvh& bvh;
  std::function<void(std::uint32_t child, glm::vec3 lower, glm::vec3 upper)> leaf;
  std::vector<int> visits{};
  std::uint32_t stack = 0;

  // Entries that a traversal needs below this node if it pushes all children and pops them one by
  // one.
  std::uint32_t visit(std::uint32_t index, glm::vec3 lower, glm::vec3 upper) {
    visits.resize(bvh.nodes.size());
    ++visits.at(index);
    const BvhNode& node = bvh.nodes.at(index);
    std::uint32_t present = 0, deepest = 0;
    for (int slot = 0; slot < 4; ++slot) {
      const Planes planes = planes_of(node, slot);
      if (node.children[slot] == PPM_BVH_EMPTY) {
        EXPECT_TRUE(glm::all(glm::greaterThan(planes.lower, planes.upper)));
        continue;
      }
      ++present;
      const glm::vec3 l =
          glm::max(lower, bvh.grid_origin + glm::vec3(planes.lower) * bvh.grid_step);
      const glm::vec3 u =
          glm::min(upper, bvh.grid_origin + glm::vec3(planes.upper) * bvh.grid_step);
      const bool at_leaf = is_leaf(node.children[slot]);
      if (at_leaf) leaf(node.children[slot], l, u);
      deepest = std::max(deepest, at_leaf ? 1u : visit(node.children[slot], l, u));
    }
    return present == 0 ? 0 : present - 1 + deepest;
  }

  std::uint32_t run() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    return visit(0, glm::vec3(-kInfinity), glm::vec3(kInfinity));
  }
};

void expect_sound(const Triangles& triangles, const Bvh& bvh) {
  ASSERT_FALSE(bvh.nodes.empty());
  EXPECT_TRUE(glm::all(glm::greaterThan(bvh.grid_step, glm::vec3(0.0f))));
  ASSERT_EQ(bvh.triangle_order.size(), triangles.size());
  std::vector<int> slots(triangles.size()), seen(triangles.size());
  std::size_t outside = 0;
  Walk walk{bvh, [&](std::uint32_t child, glm::vec3 lower, glm::vec3 upper) {
              for (std::uint32_t i = 0; i < leaf_count(child); ++i) {
                const std::uint32_t slot = leaf_first(child) + i;
                ++slots.at(slot);
                ++seen.at(bvh.triangle_order.at(slot));
                for (const scene::Corner& corner : triangles[bvh.triangle_order[slot]].corners) {
                  outside += glm::any(glm::lessThan(corner.position, lower)) ||
                             glm::any(glm::greaterThan(corner.position, upper));
                }
              }
            }};
  EXPECT_EQ(walk.run(), bvh.stack_depth);
  EXPECT_LE(bvh.stack_depth, std::uint32_t{PPM_BVH_STACK});
  EXPECT_EQ(outside, 0u);
  EXPECT_TRUE(std::ranges::all_of(slots, [](int n) { return n == 1; }));
  EXPECT_TRUE(std::ranges::all_of(seen, [](int n) { return n == 1; }));
  EXPECT_TRUE(std::ranges::all_of(walk.visits, [](int n) { return n == 1; }));
}

bool same(const Bvh& a, const Bvh& b) {
  return a.triangle_order == b.triangle_order && a.grid_origin == b.grid_origin &&
         a.grid_step == b.grid_step && a.stack_depth == b.stack_depth && a.sah_cost == b.sah_cost &&
         std::ranges::equal(a.nodes, b.nodes, [](const BvhNode& m, const BvhNode& n) {
           return m.box_x == n.box_x && m.box_y == n.box_y && m.box_z == n.box_z &&
                  m.children == n.children;
         });
}

// ---- Rays
// -----------------------------------------------------------------------------------------------

struct Ray {
  glm::dvec3 origin, direction;
};

// Moeller and Trumbore 1997, in double.
std::optional<double> intersect(const Ray& ray, const Triangle& t) {
  const glm::dvec3 corner(t.corners[0].position);
  const glm::dvec3 edge1 = glm::dvec3(t.corners[1].position) - corner;
  const glm::dvec3 edge2 = glm::dvec3(t.corners[2].position) - corner;
  const glm::dvec3 p = glm::cross(ray.direction, edge2);
  const double determinant = glm::dot(edge1, p);
  if (determinant == 0.0) return {};
  const glm::dvec3 s = ray.origin - corner;
  const double u = glm::dot(s, p) / determinant;
  const glm::dvec3 q = glm::cross(s, edge1);
  const double v = glm::dot(ray.direction, q) / determinant;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return {};
  const double distance = glm::dot(edge2, q) / determinant;
  return distance > 0.0 ? std::optional(distance) : std::nullopt;
}

// Slabs in double; the margin covers its rounding.
bool meets(const Ray& ray, const Bvh& bvh, const Planes& planes, double nearest) {
  double enter = 0.0, leave = nearest;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = bvh.grid_origin[axis], step = bvh.grid_step[axis];
    const double margin = 1e-9 * step + 1e-14 * std::abs(ray.origin[axis]);
    const double lower = origin + planes.lower[axis] * step - margin - ray.origin[axis];
    const double upper = origin + planes.upper[axis] * step + margin - ray.origin[axis];
    if (ray.direction[axis] == 0.0) {
      if (lower > 0.0 || upper < 0.0) return false;
      continue;
    }
    const double a = lower / ray.direction[axis], b = upper / ray.direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave * (1.0 + 1e-12);
}

constexpr double kMiss = std::numeric_limits<double>::infinity();

// Distance of the closest hit before `limit`, or of any if `any`; kMiss for none.
double trace(const Ray& ray, const Triangles& triangles, const Bvh& bvh, double limit, bool any) {
  double nearest = limit;
  bool found = false;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const BvhNode& node = bvh.nodes[stack.back()];
    stack.pop_back();
    for (int slot = 0; slot < 4; ++slot) {
      const std::uint32_t child = node.children[slot];
      if (child == PPM_BVH_EMPTY || !meets(ray, bvh, planes_of(node, slot), nearest)) continue;
      if (!is_leaf(child)) {
        stack.push_back(child);
        continue;
      }
      for (std::uint32_t i = 0; i < leaf_count(child); ++i) {
        const auto t = intersect(ray, triangles[bvh.triangle_order[leaf_first(child) + i]]);
        if (!t || *t >= nearest) continue;
        nearest = *t;
        found = true;
        if (any) return nearest;
      }
    }
  }
  return found ? nearest : kMiss;
}

double trace_all(const Ray& ray, const Triangles& triangles, double limit) {
  double nearest = limit;
  for (const Triangle& t : triangles) {
    const auto distance = intersect(ray, t);
    if (distance) nearest = std::min(nearest, *distance);
  }
  return nearest < limit ? nearest : kMiss;
}

// Rays of all sorts: through the middle of triangles, between random points, along the axes.
std::vector<Ray> rays_for(const Triangles& triangles, int count) {
  std::mt19937 random(17);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 a(random_point(random, 1.5f)), b(random_point(random, 1.5f));
    Ray ray{a, b - a};
    if (i % 4 == 1) ray.direction = glm::dvec3(i % 3 == 0, i % 3 == 1, i % 3 == 2);
    if (i % 4 >= 2 && !triangles.empty()) {
      const auto& corners = triangles[random() % triangles.size()].corners;
      const glm::dvec3 middle = glm::dvec3(corners[0].position) * 0.25 +
                                glm::dvec3(corners[1].position) * 0.25 +
                                glm::dvec3(corners[2].position) * 0.5;
      ray.direction = middle - ray.origin;
      if (i % 4 == 3) ray.origin = middle + 0.1 * glm::dvec3(random_point(random));
    }
    rays.push_back(ray);
  }
  return rays;
}

// ---- The heuristic's yardstick
// --------------------------------------------------------------------------

double half_area(glm::dvec3 size) {
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

// Cost of a four-wide tree that splits a random axis at the median, leaves of at most four.
double median_cost(Triangles& triangles, std::size_t begin, std::size_t end, std::mt19937& random) {
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (std::size_t i = begin; i < end; ++i)
    for (const scene::Corner& corner : triangles[i].corners) {
      lower = glm::min(lower, corner.position);
      upper = glm::max(upper, corner.position);
    }
  const double area = half_area(glm::dvec3(upper - lower));
  if (end - begin <= 4) return area * static_cast<double>(end - begin);
  double cost = area;
  std::vector<std::size_t> cuts{begin, end};
  for (int level = 0; level < 2; ++level) {
    std::vector<std::size_t> finer;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const int axis = static_cast<int>(random() % 3);
      const std::size_t middle = (cuts[i] + cuts[i + 1]) / 2;
      const auto at = [&](std::size_t k) {
        return triangles.begin() + static_cast<std::ptrdiff_t>(k);
      };
      std::nth_element(at(cuts[i]), at(middle), at(cuts[i + 1]),
                       [&](const Triangle& a, const Triangle& b) {
                         return a.corners[0].position[axis] < b.corners[0].position[axis];
                       });
      finer.insert(finer.end(), {cuts[i], middle});
    }
    finer.push_back(end);
    cuts = finer;
  }
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    if (cuts[i] < cuts[i + 1]) cost += median_cost(triangles, cuts[i], cuts[i + 1], random);
  return cost;
}

// ---- Tests
// ----------------------------------------------------------------------------------------------

TEST(Bvh, HoldsEveryTriangleOnceWithinItsBoxes) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    expect_sound(c.triangles, build(c.triangles));
  }
}

TEST(Bvh, EmptySceneGivesOneEmptyRoot) {
  const Bvh bvh = build({});
  ASSERT_EQ(bvh.nodes.size(), 1u);
  EXPECT_EQ(bvh.nodes[0].children, glm::uvec4(PPM_BVH_EMPTY));
  EXPECT_EQ(bvh.stack_depth, 0u);
}

TEST(Bvh, ManyCoincidentTrianglesStayShallow) {
  const Triangles triangles = coincident(100000);
  const Bvh bvh = build(triangles);
  expect_sound(triangles, bvh);
  // Halved by count until four are left: 15 binary levels are 8 wide ones, with three siblings
  // each.
  EXPECT_LE(bvh.stack_depth, 3u * 9u + 1u);
}

TEST(Bvh, StackIsBoundedWhereTheHeuristicWouldPeelOneByOne) {
  const Triangles triangles = exponentially_spaced(140);
  const Bvh bvh = build(triangles);
  expect_sound(triangles, bvh);
  // Deeper than a tree of 140 halved by count (4 wide levels), or else the scene tempts nobody.
  EXPECT_GT(bvh.stack_depth, 13u);
}

TEST(Bvh, IsTheSameForAnyNumberOfThreads) {
  std::vector<Case> all = cases();
  all.push_back({"many", random_soup(200000, 0.01f)});
  all.push_back({"many coincident", coincident(100000)});
  for (const Case& c : all) {
    SCOPED_TRACE(c.name);
    const Bvh one = build(c.triangles, 1);
    EXPECT_TRUE(same(one, build(c.triangles, 2)));
    EXPECT_TRUE(same(one, build(c.triangles, 7)));
  }
}

TEST(Bvh, LargeSceneIsSound) {
  const Triangles triangles = random_soup(200000, 0.01f);
  expect_sound(triangles, build(triangles));
}

// Both sides use one triangle test, so that distances must be equal to the last bit.
TEST(Bvh, ClosestHitsAreThoseOfBruteForce) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Bvh bvh = build(c.triangles);
    int hits = 0, different = 0;
    for (const Ray& ray : rays_for(c.triangles, 2000)) {
      const double expected = trace_all(ray, c.triangles, kMiss);
      hits += expected < kMiss;
      different += trace(ray, c.triangles, bvh, kMiss, false) != expected;
    }
    EXPECT_EQ(different, 0);
    if (c.name.find("soup") != std::string::npos) {
      EXPECT_GT(hits, 500);
    }
  }
}

TEST(Bvh, AnyHitsAreThoseOfBruteForce) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Bvh bvh = build(c.triangles);
    int different = 0;
    for (const Ray& ray : rays_for(c.triangles, 2000)) {
      const bool expected = trace_all(ray, c.triangles, 0.9) < kMiss;
      different += (trace(ray, c.triangles, bvh, 0.9, true) < kMiss) != expected;
    }
    EXPECT_EQ(different, 0);
  }
}

TEST(Bvh, CostIsThatOfItsBoxes) {
  const Triangles triangles = random_soup(20000, 0.02f);
  const Bvh bvh = build(triangles);
  // By the quantised boxes, each at most two steps wider an axis and side than its triangles.
  double cost = 0.0, root_area = 0.0;
  glm::uvec3 lower(65535u), upper(0u);
  for (int slot = 0; slot < 4; ++slot) {
    lower = glm::min(lower, planes_of(bvh.nodes[0], slot).lower);
    upper = glm::max(upper, planes_of(bvh.nodes[0], slot).upper);
  }
  root_area = half_area(glm::dvec3(upper - lower) * glm::dvec3(bvh.grid_step));
  cost = 1.0;
  for (const BvhNode& node : bvh.nodes) {
    for (int slot = 0; slot < 4; ++slot) {
      const std::uint32_t child = node.children[slot];
      if (child == PPM_BVH_EMPTY) continue;
      const Planes planes = planes_of(node, slot);
      const double area =
          half_area(glm::dvec3(planes.upper - planes.lower) * glm::dvec3(bvh.grid_step));
      cost += area / root_area * (is_leaf(child) ? leaf_count(child) : 1.0);
    }
  }
  // Edges of a leaf are some 600 steps long, so that four more on an edge are below 1.5 % of an
  // area.
  EXPECT_NEAR(cost / bvh.sah_cost, 1.0, 0.015);
}

TEST(Bvh, CostIsFarBelowThatOfRandomMedians) {
  Triangles triangles = random_soup(20000, 0.02f);
  for (std::size_t i = 0; i < 100; ++i) triangles.push_back(random_soup(100, 0.5f)[i]);
  const Bvh bvh = build(triangles);
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (const Triangle& t : triangles)
    for (const scene::Corner& corner : t.corners) {
      lower = glm::min(lower, corner.position);
      upper = glm::max(upper, corner.position);
    }
  std::mt19937 random(19);
  const double median =
      median_cost(triangles, 0, triangles.size(), random) / half_area(glm::dvec3(upper - lower));
  EXPECT_LT(bvh.sah_cost, 0.7 * median);
}

}  // namespace
}  // namespace ppm::bvh
