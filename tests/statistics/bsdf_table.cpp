#include "bsdf_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ppm::statistics {
namespace {

using glm::dvec3;
using glm::vec3;
using shared::Bsdf;

enum class Glass { thin, entering, leaving };

// A surface in glTF's terms.
struct Surface {
  vec3 base{1.0f};
  float metallic = 0.0f;
  float roughness = 0.5f;
  vec3 f0{0.04f};
  float f90 = 1.0f;
  float transmission = 0.0f;
  Glass glass = Glass::thin;
  float ior = 1.5f;
};

Bsdf bsdf_of(const Surface& s) {
  const float opaque = (1.0f - s.metallic) * (1.0f - s.transmission);
  Bsdf bsdf{};
  bsdf.diffuse.albedo = s.base * opaque;
  bsdf.diffuse.coat_f0 = std::max({s.f0.x, s.f0.y, s.f0.z});
  bsdf.diffuse.coat_f90 = s.f90;
  bsdf.glossy.f0 = s.base * s.metallic + s.f0 * opaque;
  bsdf.glossy.f90 = s.metallic + s.f90 * opaque;
  bsdf.glossy.alpha = s.roughness * s.roughness;
  bsdf.glass = (1.0f - s.metallic) * s.transmission;
  bsdf.glass_tint = s.base;
  bsdf.eta = s.glass == Glass::thin ? 1.0f : s.glass == Glass::entering ? s.ior : 1.0f / s.ior;
  bsdf.thin_ior = s.glass == Glass::thin ? s.ior : 0.0f;
  return bsdf;
}

std::vector<BsdfRow> make_table() {
  const vec3 none(0.0f), white(1.0f), colour(0.2f, 0.5f, 0.8f), gold(1.0f, 0.78f, 0.34f);
  std::vector<BsdfRow> rows;
  const auto add = [&](const char* name, const Surface& surface, bool lossless = false) {
    rows.push_back({name, bsdf_of(surface), lossless});
  };
  add("black", {.base = none, .f0 = none, .f90 = 0.0f});
  add("lambert_white", {.f0 = none, .f90 = 0.0f}, true);
  add("lambert_colour", {.base = colour, .f0 = none, .f90 = 0.0f});
  add("plastic_rough_1", {.roughness = 1.0f});
  add("plastic_rough_05", {.roughness = 0.5f});
  add("plastic_rough_02", {.roughness = 0.2f});
  add("plastic_rough_005", {.roughness = 0.05f});
  add("plastic_dim_coat", {.base = colour, .roughness = 0.3f, .f0 = vec3(0.02f), .f90 = 0.5f});
  add("plastic_tinted_coat", {.roughness = 0.4f, .f0 = vec3(0.01f, 0.04f, 0.17f)});
  add("plastic_dense_coat", {.roughness = 0.6f, .f0 = vec3(0.17f)});
  add("plastic_black", {.base = none, .roughness = 0.3f});
  add("plastic_smooth", {.roughness = 0.0f}, true);
  add("plastic_smooth_dense", {.roughness = 0.0f, .f0 = vec3(0.3f)}, true);
  add("metal_rough_1", {.metallic = 1.0f, .roughness = 1.0f});
  add("metal_rough_05", {.metallic = 1.0f, .roughness = 0.5f});
  add("metal_rough_01", {.metallic = 1.0f, .roughness = 0.1f});
  add("metal_rough_005", {.metallic = 1.0f, .roughness = 0.05f});
  add("gold_rough_03", {.base = gold, .metallic = 1.0f, .roughness = 0.3f});
  add("half_metal", {.metallic = 0.5f, .roughness = 0.4f});
  add("half_metal_smooth", {.base = colour, .metallic = 0.5f, .roughness = 0.0f});
  add("mirror", {.metallic = 1.0f, .roughness = 0.0f}, true);
  add("mirror_gold", {.base = gold, .metallic = 1.0f, .roughness = 0.0f});
  add("glass_thin", {.transmission = 1.0f}, true);
  add("glass_entering", {.transmission = 1.0f, .glass = Glass::entering}, true);
  add("glass_leaving", {.transmission = 1.0f, .glass = Glass::leaving}, true);
  add("diamond_leaving", {.transmission = 1.0f, .glass = Glass::leaving, .ior = 2.4f}, true);
  add("glass_tinted", {.base = colour, .transmission = 1.0f, .glass = Glass::entering});
  add("half_glass_thin", {.roughness = 0.3f, .transmission = 0.5f});
  add("half_glass_entering", {.transmission = 0.5f, .glass = Glass::entering});
  add("half_glass_leaving", {.base = colour, .transmission = 0.5f, .glass = Glass::leaving});
  add("half_glass_smooth", {.roughness = 0.0f, .transmission = 0.5f, .glass = Glass::entering},
      true);
  add("half_metal_glass",
      {.base = gold, .metallic = 0.3f, .roughness = 0.2f, .transmission = 0.7f});
  return rows;
}

double schlick(double f0, double f90, double cosine) {
  return f0 + (f90 - f0) * std::pow(1.0 - cosine, 5.0);
}

double reference_diffuse(const shared::DiffuseLobe& lobe, double cos_o, double cos_i) {
  const auto f = [&](double cosine) { return schlick(lobe.coat_f0, lobe.coat_f90, cosine); };
  const double average = integrate([&](double c) { return 2.0 * c * f(c); }, 0.0, 1.0);
  return (1.0 - f(cos_o)) * (1.0 - f(cos_i)) / ((1.0 - average) * std::numbers::pi);
}

// D and G2 / (4 cos cos).
double reference_microfacets(double alpha, dvec3 wo, dvec3 wi) {
  const double a2 = alpha * alpha;
  const dvec3 h = glm::normalize(wo + wi);
  const double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
  const double d = a2 / (std::numbers::pi * std::pow(h.z, 4.0) * std::pow(a2 + tan2, 2.0));
  const double visible = 2.0 * (wi.z * std::sqrt(a2 + (1.0 - a2) * wo.z * wo.z) +
                                wo.z * std::sqrt(a2 + (1.0 - a2) * wi.z * wi.z));
  return d / visible;
}

}  // namespace

const std::vector<BsdfRow>& bsdf_table() {
  static const std::vector<BsdfRow> table = make_table();
  return table;
}

std::vector<vec3> outgoing_directions() {
  std::vector<vec3> result;
  double azimuth = 0.3;
  for (const double cosine : {1.0, 0.85, 0.5, 0.2, 0.05}) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    result.emplace_back(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
    azimuth += 1.7;
  }
  return result;
}

DirectionChart chart_for(const Bsdf& bsdf, vec3 wo) {
  const bool sharp = bsdf.glossy.alpha > 0.0f && bsdf.glossy.alpha < 1.0f;
  const dvec3 mirror(-wo.x, -wo.y, wo.z);
  return {glm::normalize(mirror), sharp ? double(bsdf.glossy.alpha) : 1.0, true};
}

dvec3 non_specular_albedo(const Bsdf& bsdf, vec3 wo) {
  return chart_for(bsdf, wo).integrate_all(
      [&](dvec3 wi) { return dvec3(shared::bsdf_eval(bsdf, wo, vec3(wi))) * wi.z; });
}

dvec3 directional_albedo(const Bsdf& bsdf, vec3 wo) {
  const shared::SpecularLobes specular = shared::specular_lobes(bsdf, wo.z);
  return non_specular_albedo(bsdf, wo) + dvec3(specular.reflected) + dvec3(specular.transmitted);
}

dvec3 reference_eval(const Bsdf& bsdf, dvec3 wo, dvec3 wi) {
  dvec3 f = dvec3(bsdf.diffuse.albedo) * reference_diffuse(bsdf.diffuse, wo.z, wi.z);
  if (bsdf.glossy.alpha > 0.0f) {
    const double cosine = glm::dot(wo, glm::normalize(wo + wi));
    const double facets = reference_microfacets(bsdf.glossy.alpha, wo, wi);
    for (int c = 0; c < 3; ++c) {
      f[c] += facets * schlick(bsdf.glossy.f0[c], bsdf.glossy.f90, cosine);
    }
  }
  return f;
}

}  // namespace ppm::statistics
