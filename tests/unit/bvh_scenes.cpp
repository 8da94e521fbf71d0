#include "bvh_scenes.hpp"

#include <cmath>

namespace ppm::bvh {

using scene::Triangle;

namespace {

Triangle triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  Triangle result;
  result.corners[0].position = a;
  result.corners[1].position = b;
  result.corners[2].position = c;
  return result;
}

}  // namespace

glm::vec3 random_point(std::mt19937& random, float size) {
  std::uniform_real_distribution<float> coordinate(-size, size);
  const float x = coordinate(random), y = coordinate(random);
  return {x, y, coordinate(random)};
}

Triangles random_soup(std::size_t count, float size) {
  std::mt19937 random(7);
  Triangles result;
  while (result.size() < count) {
    const glm::vec3 centre = random_point(random, 1.0f - size);
    result.push_back(triangle(centre + random_point(random, size),
                              centre + random_point(random, size),
                              centre + random_point(random, size)));
  }
  return result;
}

Triangles slivers(std::size_t count) {
  std::mt19937 random(11);
  Triangles result;
  while (result.size() < count) {
    const glm::vec3 a = random_point(random), b = random_point(random);
    switch (result.size() % 4) {
      case 0:
        result.push_back(triangle(a, b, a + 0.5f * (b - a)));
        break;
      case 1:
        result.push_back(triangle(a, a, b));
        break;
      case 2:
        result.push_back(triangle(a, a, a));
        break;
      default:
        result.push_back(triangle(a, b, b + random_point(random, 1e-6f)));
    }
  }
  return result;
}

Triangles coincident(std::size_t count) {
  return Triangles(count, triangle({-0.5f, 0.0f, 0.1f}, {0.5f, 0.1f, 0.2f}, {0.0f, 0.7f, -0.3f}));
}

Triangles huge_and_tiny(std::size_t count) {
  std::mt19937 random(13);
  std::uniform_real_distribution<float> exponent(-22.0f, 0.0f);
  Triangles result;
  while (result.size() < count) {
    const float size = std::exp2(exponent(random));
    const glm::vec3 centre = random_point(random, 0.5f);
    result.push_back(triangle(centre + random_point(random, size),
                              centre + random_point(random, size),
                              centre + random_point(random, size)));
  }
  return result;
}

Triangles exponentially_spaced(std::size_t count) {
  Triangles result;
  float x = 0x1p30f;
  for (std::size_t i = 0; i < count; ++i, x *= 0.5f)
    result.push_back(triangle({x, 0.0f, 0.0f}, {x * 1.01f, 0.1f * x, 0.0f}, {x, 0.0f, 0.1f * x}));
  return result;
}

Triangles flat(std::size_t count, int axis, float height) {
  Triangles result = random_soup(count, 0.05f);
  for (Triangle& t : result)
    for (scene::Corner& corner : t.corners) corner.position[axis] = height;
  return result;
}

std::vector<Case> cases() {
  return {{"empty", {}},
          {"one", random_soup(1, 0.5f)},
          {"two", random_soup(2, 0.5f)},
          {"five", random_soup(5, 0.5f)},
          {"nine", random_soup(9, 0.2f)},
          {"small soup", random_soup(3000, 0.05f)},
          {"large overlapping soup", random_soup(2000, 0.6f)},
          {"slivers", slivers(2000)},
          {"coincident", coincident(3000)},
          {"huge and tiny", huge_and_tiny(3000)},
          {"exponentially spaced", exponentially_spaced(200)},
          {"flat in x", flat(1000, 0, 0.3f)},
          {"flat in y", flat(1000, 1, 0.0f)},
          {"flat in z", flat(1000, 2, -1.0f)},
          {"far from the origin", [] {
             Triangles moved = random_soup(500, 0.05f);
             for (Triangle& t : moved)
               for (scene::Corner& corner : t.corners)
                 corner.position = corner.position * 1e-4f + glm::vec3(1e3f, 1.0f, 0.0f);
             return moved;
           }()}};
}

}  // namespace ppm::bvh
