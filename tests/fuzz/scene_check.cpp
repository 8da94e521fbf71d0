#include "scene_check.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace ppm::fuzz {
namespace {

using namespace scene;

constexpr float kRoundings = 1e-5f;

void require(bool holds, const char* promise, std::size_t position = 0) {
  if (!holds) broken(promise, "item " + std::to_string(position));
}

template <typename Vector>
bool is_finite(const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i) {
    if (!std::isfinite(v[i])) return false;
  }
  return true;
}

template <typename Vector>
bool lies_within(const Vector& v, double low, double high) {
  for (int i = 0; i < Vector::length(); ++i) {
    const double value = static_cast<double>(v[i]);
    if (!(value >= low && value <= high)) return false;
  }
  return true;
}

bool lies_within(float value, double low, double high) {
  return static_cast<double>(value) >= low && static_cast<double>(value) <= high;
}

template <typename Vector>
bool is_unit(const Vector& v) {
  return is_finite(v) && std::abs(glm::length(v) - 1) < kRoundings;
}

void check_details(const Scene& scene) {
  if (scene.details.empty()) return;
  require(scene.details.size() == scene.triangles.size(), "every triangle has details");
  for (std::size_t i = 0; i < scene.details.size(); ++i) {
    for (const CornerDetail& corner : scene.details[i]) {
      const glm::vec3 tangent(corner.tangent);
      require(is_unit(tangent) || tangent == glm::vec3(0.0f), "tangents are unit vectors", i);
      require(is_finite(corner.tangent) && is_finite(corner.texcoord1), "details are finite", i);
    }
  }
}

void check_triangles(const Scene& scene) {
  require(!scene.triangles.empty(), "there are triangles");
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Triangle& triangle = scene.triangles[i];
    require(triangle.material < scene.materials.size(), "triangles have materials", i);
    for (const Corner& corner : triangle.corners) {
      require(lies_within(corner.position, -1.0 - 1e-6, 1.0 + 1e-6), "corners lie in the frame", i);
      require(is_unit(corner.normal), "normals are unit vectors", i);
      require(is_finite(corner.texcoord), "texture coordinates are finite", i);
      require(lies_within(corner.color, 0.0, 1.0), "vertex colours lie in [0,1]", i);
    }
  }
}

void check_uses(const Scene& scene, const Material& m, std::size_t i) {
  for (const OptionalTextureUse* use : texture_uses(m)) {
    if (!*use) continue;
    require((*use)->texture < scene.textures.size(), "textures are there", i);
    require((*use)->texcoord_set <= 1, "sets are 0 or 1", i);
    require((*use)->texcoord_set == 0 || !scene.details.empty(), "set 1 is there if used", i);
    require(is_finite((*use)->row_s) && is_finite((*use)->row_t), "transforms are finite", i);
  }
}

void check_materials(const Scene& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    require(lies_within(m.base_color, 0.0, 1.0), "base colours lie in [0,1]", i);
    check_uses(scene, m, i);
    require(std::isfinite(m.normal_scale), "normal scales are finite", i);
    require(lies_within(m.alpha, 0.0, 1.0), "alpha lies in [0,1]", i);
    require(m.alpha_cutoff >= 0.0f && std::isfinite(m.alpha_cutoff), "cutoffs are positive", i);
    require(lies_within(m.clearcoat, 0.0, 1.0), "clearcoat lies in [0,1]", i);
    require(lies_within(m.clearcoat_roughness, 0.0, 1.0), "coats' roughness lies in [0,1]", i);
    require(m.dispersion >= 0.0f && std::isfinite(m.dispersion), "dispersion is positive", i);
    require(lies_within(m.metallic, 0.0, 1.0), "metallic lies in [0,1]", i);
    require(lies_within(m.roughness, 0.0, 1.0), "roughness lies in [0,1]", i);
    require(lies_within(m.specular, 0.0, 1.0), "specular lies in [0,1]", i);
    require(lies_within(m.transmission, 0.0, 1.0), "transmission lies in [0,1]", i);
    require(lies_within(m.attenuation_color, 0.0, 1.0), "attenuation lies in [0,1]", i);
    require(lies_within(m.specular_color, 0.0, 1e21), "specular colours are finite", i);
    require(lies_within(m.emission, 0.0, 1e21), "emission is finite", i);
    require(m.ior == 0.0f || lies_within(m.ior, 1.0, 1e4), "ior is 0 or at least 1", i);
    require(m.attenuation_distance > 0.0f, "attenuation distances are positive", i);
  }
}

void check_textures(const Scene& scene) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const Texture& texture = scene.textures[i];
    const std::size_t count = std::size_t{texture.width} * texture.height;
    const bool is_whole =
        texture.halves.empty() ? texture.rgba8.size() == count : texture.halves.size() == count;
    require(count > 0 && is_whole, "textures are whole", i);
    require(texture.rgba8.empty() || texture.halves.empty(), "texels are of one kind", i);
  }
}

void check_lights(const Scene& scene) {
  for (std::size_t i = 0; i < scene.punctual_lights.size(); ++i) {
    const PunctualLight& light = scene.punctual_lights[i];
    require(lies_within(light.intensity, 0.0, 1e31), "intensities are finite", i);
    require(is_finite(light.position), "lights are somewhere", i);
    require(light.range > 0.0f, "ranges are positive", i);
    if (light.kind == PunctualKind::point) continue;
    require(is_unit(light.direction), "directions are unit vectors", i);
    if (light.kind == PunctualKind::directional) continue;
    require(light.inner_cone_angle >= 0.0f && light.inner_cone_angle < light.outer_cone_angle &&
                light.outer_cone_angle <= 1.5707964f,
            "cone angles are in order", i);
  }
}

void check_camera(const Camera& camera, std::size_t i) {
  require(is_finite(camera.position), "cameras are somewhere", i);
  require(is_unit(camera.right) && is_unit(camera.up) && is_unit(camera.forward),
          "camera axes are unit vectors", i);
  require(std::abs(glm::dot(camera.right, camera.up)) < 1e-5 &&
              std::abs(glm::dot(camera.up, camera.forward)) < 1e-5 &&
              std::abs(glm::dot(camera.right, camera.forward)) < 1e-5,
          "camera axes are orthogonal", i);
  require(camera.yfov > 0.0 && camera.yfov < 3.1415927, "fields of view lie in (0, pi)", i);
  require(!camera.aspect || (*camera.aspect > 0.0 && *camera.aspect < 1e5), "aspects are sane", i);
}

}  // namespace

void broken(std::string_view promise, std::string_view detail) {
  std::fprintf(stderr, "broken promise: %.*s: %.*s\n", static_cast<int>(promise.size()),
               promise.data(), static_cast<int>(detail.size()), detail.data());
  std::abort();
}

void check_scene(const Scene& scene) {
  require(std::isfinite(scene.frame.scale) && scene.frame.scale > 0.0, "the frame has a scale");
  require(is_finite(scene.frame.centre), "the frame has a centre");
  check_triangles(scene);
  check_details(scene);
  check_materials(scene);
  check_textures(scene);
  check_lights(scene);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) check_camera(scene.cameras[i], i);
}

}  // namespace ppm::fuzz
