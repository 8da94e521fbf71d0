// Triangles of all kinds for the hierarchy's tests; the same on every run.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "scene.hpp"

namespace ppm::bvh {

using Triangles = std::vector<scene::Triangle>;

/// Uniform in the cube [-size, size]^3.
glm::vec3 random_point(std::mt19937& random, float size = 1.0f);

/// Triangles of about `size`, anywhere in the unit cube.
Triangles random_soup(std::size_t count, float size);
/// Nearly or exactly without area.
Triangles slivers(std::size_t count);
Triangles coincident(std::size_t count);
/// Sizes from the scene's own to the finest that float tells apart.
Triangles huge_and_tiny(std::size_t count);
/// Halving distances tempt the heuristic into splitting off one triangle at a time.
Triangles exponentially_spaced(std::size_t count);
/// All in the plane where the coordinate `axis` is `height`.
Triangles flat(std::size_t count, int axis, float height);

struct Case {
  std::string name;
  Triangles triangles;
};

/// One of each kind, small enough for brute force.
std::vector<Case> cases();

}  // namespace ppm::bvh
