// Small scenes from bare triangles, for tests of kernels.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "integrator.hpp"
#include "scene.hpp"

namespace ppm::tests {

/// A triangle with its geometric normal in all corners (+z where it has no area).
inline scene::Triangle make_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c,
                                     std::uint32_t material = 0) {
  const glm::vec3 area_normal = glm::cross(b - a, c - a);
  const float length = glm::length(area_normal);
  const glm::vec3 normal = length > 0.0f ? area_normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
  scene::Triangle triangle;
  triangle.corners = {scene::Corner{a, normal}, scene::Corner{b, normal}, scene::Corner{c, normal}};
  triangle.material = material;
  return triangle;
}

/// A parallelogram of `columns` x `rows` cells, two triangles each, front side along
/// cross(edge0, edge1). Neighbouring triangles share their corners to the bit.
inline void add_plate(scene::Scene& scene, glm::vec3 corner, glm::vec3 edge0, glm::vec3 edge1,
                      std::uint32_t material, int columns = 1, int rows = 1) {
  const auto at = [&](int i, int j) {
    return corner + edge0 * (static_cast<float>(i) / static_cast<float>(columns)) +
           edge1 * (static_cast<float>(j) / static_cast<float>(rows));
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      scene.triangles.push_back(make_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), material));
      scene.triangles.push_back(make_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1), material));
    }
  }
}

/// Lambert's diffuse surface.
inline scene::Material diffuse_material(float albedo) {
  scene::Material material;
  material.base_color = glm::vec3(albedo);
  material.metallic = 0.0f;
  material.specular = 0.0f;
  return material;
}

/// A mirror that absorbs nothing.
inline scene::Material mirror_material() {
  scene::Material material;
  material.metallic = 1.0f;
  material.roughness = 0.0f;
  return material;
}

/// Sets the bounds from the triangles, and gives a scene without materials one.
inline scene::Scene finished(scene::Scene scene) {
  if (scene.materials.empty()) scene.materials.push_back(diffuse_material(0.5f));
  if (scene.triangles.empty()) return scene;
  scene.bounds_min = glm::vec3(1e30f);
  scene.bounds_max = glm::vec3(-1e30f);
  for (const scene::Triangle& triangle : scene.triangles) {
    for (const scene::Corner& corner : triangle.corners) {
      scene.bounds_min = glm::min(scene.bounds_min, corner.position);
      scene.bounds_max = glm::max(scene.bounds_max, corner.position);
    }
  }
  return scene;
}

inline scene::Scene scene_of(std::vector<scene::Triangle> triangles) {
  scene::Scene scene;
  scene.triangles = std::move(triangles);
  return finished(std::move(scene));
}

/// Settings that no kernel of a test minds.
inline render::Settings small_settings(std::uint32_t width = 16, std::uint32_t height = 16) {
  render::Settings settings;
  settings.width = width;
  settings.height = height;
  settings.samples_per_pixel = 1;
  return settings;
}

}  // namespace ppm::tests
