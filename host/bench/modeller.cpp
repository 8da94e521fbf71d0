#include "modeller.hpp"

#include <cmath>
#include <numbers>

namespace ppm::bench {

std::uint32_t Modeller::material(const scene::Material& material) {
  scene_.materials.push_back(material);
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

std::uint32_t Modeller::diffuse(const char* name, glm::vec3 color) {
  scene::Material result;
  result.name = name;
  result.base_color = color;
  result.metallic = 0.0f;
  result.specular = 0.0f;
  return material(result);
}

std::uint32_t Modeller::emitter(const char* name, glm::vec3 radiance) {
  const std::uint32_t index = diffuse(name, glm::vec3(0.0f));
  scene_.materials[index].emission = radiance;
  return index;
}

void Modeller::sheet(std::uint32_t columns, std::uint32_t rows, std::uint32_t material,
                     const std::function<Surface(double u, double v)>& surface) {
  const auto at = [&](std::uint32_t column, std::uint32_t row) {
    return surface(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
  };
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const Surface a = at(column, row), b = at(column + 1, row);
      const Surface c = at(column + 1, row + 1), d = at(column, row + 1);
      triangle(a, b, c, material);
      triangle(a, c, d, material);
    }
  }
}

void Modeller::panel(glm::vec3 corner, glm::vec3 right, glm::vec3 up, std::uint32_t cuts,
                     std::uint32_t material) {
  const glm::vec3 normal = glm::normalize(glm::cross(right, up));
  sheet(cuts, cuts, material, [=](double u, double v) {
    return Surface{corner + static_cast<float>(u) * right + static_cast<float>(v) * up, normal};
  });
}

void Modeller::box(glm::vec3 centre, glm::vec3 half, float angle, float side, std::uint32_t cuts,
                   const std::array<std::uint32_t, 6>& materials) {
  const glm::vec3 x{std::cos(angle), 0.0f, -std::sin(angle)}, y{0.0f, 1.0f, 0.0f};
  const std::array<glm::vec3, 3> axes = {half.x * x, half.y * y, half.z * glm::cross(x, y)};
  for (std::size_t face = 0; face < 6; ++face) {
    const float sign = face % 2 == 0 ? -1.0f : 1.0f;
    const glm::vec3 out = sign * axes[face / 2];
    const glm::vec3 right = axes[(face / 2 + 1) % 3], up = side * sign * axes[(face / 2 + 2) % 3];
    panel(centre + out - right - up, 2.0f * right, 2.0f * up, cuts, materials[face]);
  }
}

void Modeller::ball(glm::vec3 centre, double radius, std::uint32_t rows, std::uint32_t material) {
  sheet(2 * rows, rows, material, [=](double u, double v) {
    const double azimuth = 2.0 * std::numbers::pi * (u < 1.0 ? u : 0.0),
                 height = std::numbers::pi * v;
    const double ring = v > 0.0 && v < 1.0 ? std::sin(height) : 0.0;
    const glm::dvec3 normal(ring * std::sin(azimuth), -std::cos(height), ring * std::cos(azimuth));
    return Surface{glm::vec3(glm::dvec3(centre) + radius * normal), glm::vec3(normal)};
  });
}

void Modeller::ring(glm::vec3 centre, double radius, double thickness, std::uint32_t columns,
                    std::uint32_t rows, std::uint32_t material) {
  sheet(columns, rows, material, [=](double u, double v) {
    const double around = 2.0 * std::numbers::pi * (u < 1.0 ? u : 0.0);
    const double across = 2.0 * std::numbers::pi * (v < 1.0 ? v : 0.0);
    const glm::dvec3 out(std::sin(around), 0.0, std::cos(around));
    const glm::dvec3 normal = std::cos(across) * out + glm::dvec3(0.0, std::sin(across), 0.0);
    return Surface{glm::vec3(glm::dvec3(centre) + radius * out + thickness * normal),
                   glm::vec3(normal)};
  });
}

void Modeller::find_bounds() {
  scene_.bounds_min = glm::vec3(1.0f);
  scene_.bounds_max = glm::vec3(-1.0f);
  for (const scene::Triangle& triangle : scene_.triangles) {
    for (const scene::Corner& corner : triangle.corners) {
      scene_.bounds_min = glm::min(scene_.bounds_min, corner.position);
      scene_.bounds_max = glm::max(scene_.bounds_max, corner.position);
    }
  }
}

void Modeller::triangle(const Surface& a, const Surface& b, const Surface& c,
                        std::uint32_t material) {
  if (a.position == b.position || b.position == c.position || c.position == a.position) return;
  scene::Triangle result;
  result.material = material;
  const std::array<const Surface*, 3> corners = {&a, &b, &c};
  for (std::size_t i = 0; i < 3; ++i) {
    result.corners[i].position = corners[i]->position;
    result.corners[i].normal = corners[i]->normal;
  }
  scene_.triangles.push_back(result);
}

}  // namespace ppm::bench
