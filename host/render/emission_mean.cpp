#include "emission_mean.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host_texture.hpp"

namespace ppm::render {
namespace {

using Texcoords = std::array<glm::dvec2, 3>;

constexpr double kMostMidpoints = 1 << 22;   // of all triangles
constexpr int kLeastParts = 4;               // 16 midpoints
constexpr int kMostParts = 256;              // 65536 of them
constexpr std::int64_t kMostTexels = 65536;  // that are looked through for light
constexpr float kNextToNothing = 1e-6f;

/// At the corners of a triangle, as the texture has them.
Texcoords texcoords_of(const scene::Scene& scene, std::uint32_t triangle,
                       const scene::TextureUse& use) {
  Texcoords result;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool second = use.texcoord_set == 1 && !scene.details.empty();
    const glm::vec2 own = second ? scene.details[triangle][i].texcoord1
                                 : scene.triangles[triangle].corners[i].texcoord;
    result[i] = transformed(use, own);
  }
  return result;
}

/// A texture on a triangle.
class Overlay {
 public:
  Overlay(const scene::Scene& scene, std::uint32_t triangle, const scene::OptionalTextureUse& use) {
    if (!use) return;
    texture_ = &scene.textures[use->texture];
    texcoords_ = texcoords_of(scene, triangle, *use);
  }

  glm::dvec4 at(const glm::dvec3& weights) const {
    if (texture_ == nullptr) return glm::dvec4(1.0);
    return sample(*texture_, texcoords_[0] * weights.x + texcoords_[1] * weights.y +
                                 texcoords_[2] * weights.z);
  }

  /// Of the longest edge, in texels.
  double extent() const {
    if (texture_ == nullptr) return 0.0;
    const glm::dvec2 size(texture_->width, texture_->height);
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 edge = (texcoords_[(i + 1) % 3] - texcoords_[i]) * size;
      longest = std::max(longest, glm::length(edge));
    }
    return longest;
  }

  /// Whether some texel in the triangle's box is not black; true where there are too many.
  bool may_be_lit() const {
    if (texture_ == nullptr) return true;
    const glm::dvec2 size(texture_->width, texture_->height);
    const glm::dvec2 low =
        glm::floor(glm::min(glm::min(texcoords_[0], texcoords_[1]), texcoords_[2]) * size - 0.5);
    const glm::dvec2 high =
        glm::floor(glm::max(glm::max(texcoords_[0], texcoords_[1]), texcoords_[2]) * size + 0.5);
    const glm::dvec2 count = high - low + 1.0;
    if (!(count.x * count.y <= static_cast<double>(kMostTexels))) return true;
    for (auto y = static_cast<std::int64_t>(low.y); y <= static_cast<std::int64_t>(high.y); ++y) {
      for (auto x = static_cast<std::int64_t>(low.x); x <= static_cast<std::int64_t>(high.x); ++x) {
        const glm::dvec4 texel = texel_of(*texture_, wrapped(x, texture_->width, texture_->wrap_s),
                                          wrapped(y, texture_->height, texture_->wrap_t));
        if (glm::dvec3(texel) != glm::dvec3(0.0)) return true;
      }
    }
    return false;
  }

 private:
  const scene::Texture* texture_ = nullptr;
  Texcoords texcoords_{};
};

double coverage_of(const scene::Material& material, double alpha) {
  if (material.alpha_mode == scene::AlphaMode::blend) return alpha;
  if (material.alpha_mode == scene::AlphaMode::opaque) return 1.0;
  return alpha >= material.alpha_cutoff ? 1.0 : 0.0;
}

}  // namespace

bool has_textured_emission(const scene::Material& material) {
  return material.emission != glm::vec3(0.0f) &&
         (material.emissive_texture || material.clearcoat_texture ||
          material.alpha_mode != scene::AlphaMode::opaque);
}

EmissionMean::EmissionMean(const scene::Scene& scene) : scene_(scene) {
  const auto count = std::ranges::count_if(scene.triangles, [&](const scene::Triangle& triangle) {
    return has_textured_emission(scene.materials[triangle.material]);
  });
  const double parts =
      std::sqrt(kMostMidpoints / static_cast<double>(std::max<std::ptrdiff_t>(count, 1)));
  most_parts_ = std::clamp(static_cast<int>(parts), kLeastParts, kMostParts);
}

glm::vec3 EmissionMean::of(std::uint32_t triangle) const {
  const auto& corners = scene_.triangles[triangle].corners;
  const scene::Material& material = scene_.materials[scene_.triangles[triangle].material];
  if (!has_textured_emission(material)) return glm::vec3(1.0f);
  const Overlay emission(scene_, triangle, material.emissive_texture);
  const bool is_opaque = material.alpha_mode == scene::AlphaMode::opaque;
  const Overlay base(scene_, triangle,
                     is_opaque ? scene::OptionalTextureUse() : material.base_color_texture);
  const glm::dvec3 alphas = double{material.alpha} *
                            glm::dvec3(corners[0].color.w, corners[1].color.w, corners[2].color.w);
  const double extent = std::max(emission.extent(), base.extent());
  const int parts = static_cast<int>(
      std::clamp(std::ceil(extent), double{kLeastParts}, static_cast<double>(most_parts_)));
  // Centres of parts^2 small triangles of one size, upright ones and those between them.
  glm::dvec3 sum(0.0);
  const auto add = [&](double u, double v) {
    const glm::dvec3 weights = glm::dvec3(parts - u - v, u, v) / static_cast<double>(parts);
    const double alpha = glm::dot(alphas, weights) * base.at(weights).w;
    sum += glm::dvec3(emission.at(weights)) * coverage_of(material, alpha);
  };
  for (int j = 0; j < parts; ++j) {
    for (int i = 0; i < parts - j; ++i) {
      add(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j + 1 < parts) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
  }
  const glm::vec3 mean(sum / static_cast<double>(parts * parts));
  // Light that all midpoints missed still needs a chance.
  if (mean == glm::vec3(0.0f) && emission.may_be_lit()) return glm::vec3(kNextToNothing);
  return mean;
}

}  // namespace ppm::render
