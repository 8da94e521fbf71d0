#include "bsdf_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

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
  float coat = 0.0f;
  float coat_roughness = 0.0f;
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
  bsdf.coat = {s.coat, s.coat_roughness * s.coat_roughness};
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
  const Surface glass{.roughness = 0.0f, .transmission = 1.0f};
  const auto solid = [](Surface surface, Glass side, float ior) {
    surface.glass = side;
    surface.ior = ior;
    return surface;
  };
  const Surface tinted_glass{.base = colour, .roughness = 0.0f, .transmission = 1.0f};
  add("glass_thin", glass, true);
  add("glass_entering", solid(glass, Glass::entering, 1.5f), true);
  add("glass_leaving", solid(glass, Glass::leaving, 1.5f), true);
  add("diamond_leaving", solid(glass, Glass::leaving, 2.4f), true);
  add("glass_tinted", solid(tinted_glass, Glass::entering, 1.5f));
  add("half_glass_thin", {.roughness = 0.3f, .transmission = 0.5f});
  add("half_glass_entering", {.transmission = 0.5f, .glass = Glass::entering});
  add("half_glass_leaving", {.base = colour, .transmission = 0.5f, .glass = Glass::leaving});
  add("half_glass_smooth", {.roughness = 0.0f, .transmission = 0.5f, .glass = Glass::entering},
      true);
  add("half_metal_glass",
      {.base = gold, .metallic = 0.3f, .roughness = 0.2f, .transmission = 0.7f});

  for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
    const Surface rough{.roughness = roughness, .transmission = 1.0f};
    const std::string suffix = std::to_string(std::lround(10.0f * roughness));
    add(("rough_glass_thin_" + suffix).c_str(), rough);
    add(("rough_glass_entering_" + suffix).c_str(), solid(rough, Glass::entering, 1.5f));
    add(("rough_glass_leaving_" + suffix).c_str(), solid(rough, Glass::leaving, 1.5f));
  }
  const Surface tinted_rough{.base = colour, .roughness = 0.4f, .transmission = 1.0f};
  add("rough_water_entering", solid(tinted_rough, Glass::entering, 1.33f));
  add("rough_diamond_leaving", solid(tinted_rough, Glass::leaving, 2.4f));
  add("rough_glass_black", {.base = none, .roughness = 0.4f, .transmission = 1.0f});
  add("rough_glass_half_entering", {.base = gold,
                                    .metallic = 0.2f,
                                    .roughness = 0.5f,
                                    .transmission = 0.6f,
                                    .glass = Glass::entering});

  add("coat_on_lambert", {.f0 = none, .f90 = 0.0f, .coat = 1.0f}, true);
  add("coat_half_on_lambert", {.base = colour, .f0 = none, .f90 = 0.0f, .coat = 0.5f});
  add("coat_on_smooth_plastic", {.roughness = 0.0f, .coat = 1.0f}, true);
  add("coat_on_mirror", {.metallic = 1.0f, .roughness = 0.0f, .coat = 1.0f}, true);
  add("coat_on_gold", {.base = gold, .metallic = 1.0f, .roughness = 0.4f, .coat = 0.8f});
  add("coat_on_glass", {.roughness = 0.0f, .transmission = 1.0f, .coat = 1.0f}, true);
  add("coat_on_glass_leaving",
      {.roughness = 0.0f, .transmission = 1.0f, .glass = Glass::leaving, .coat = 1.0f});
  add("coat_on_rough_glass",
      {.roughness = 0.3f, .transmission = 0.8f, .glass = Glass::entering, .coat = 0.7f});
  add("rough_coat_on_lambert", {.f0 = none, .f90 = 0.0f, .coat = 1.0f, .coat_roughness = 0.3f});
  add("rough_coat_on_plastic", {.roughness = 0.6f, .coat = 1.0f, .coat_roughness = 0.1f});
  add("rough_coat_on_mirror",
      {.base = gold, .metallic = 1.0f, .roughness = 0.0f, .coat = 1.0f, .coat_roughness = 0.2f});
  add("rough_coat_on_rough_glass", {.base = colour,
                                    .roughness = 0.3f,
                                    .transmission = 1.0f,
                                    .glass = Glass::leaving,
                                    .coat = 0.6f,
                                    .coat_roughness = 0.5f});
  return rows;
}

double schlick(double f0, double f90, double cosine) {
  return f0 + (f90 - f0) * std::pow(1.0 - cosine, 5.0);
}

double coat_passes(const shared::Clearcoat& coat, double cosine) {
  return 1.0 - double(coat.strength) * schlick(PPM_CLEARCOAT_F0, 1.0, cosine);
}

// Means by quadrature, of what both coats let through.
double reference_diffuse(const Bsdf& bsdf, double cos_o, double cos_i) {
  const auto passes = [&](double cosine) {
    return (1.0 - schlick(bsdf.diffuse.coat_f0, bsdf.diffuse.coat_f90, cosine)) *
           coat_passes(bsdf.coat, cosine);
  };
  const double average = integrate([&](double c) { return 2.0 * c * passes(c); }, 0.0, 1.0);
  return passes(cos_o) * passes(cos_i) / (average * std::numbers::pi);
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

// Fresnel's sine and tangent laws.
double reference_fresnel(double cosine, double index) {
  const double incident = std::acos(std::min(cosine, 1.0));
  const double sine = std::sin(incident) / index;
  if (sine >= 1.0) return 1.0;
  const double refracted = std::asin(sine);
  const double s = std::sin(incident - refracted) / std::sin(incident + refracted);
  const double t = std::tan(incident - refracted) / std::tan(incident + refracted);
  const double normal = (index - 1.0) / (index + 1.0);
  return incident < 1e-3 ? normal * normal : 0.5 * (s * s + t * t);
}

// Walter et al., Eqs. 20 and 21, for light that comes from wi and is seen from wo, with D by
// tangents. Indices: 1 on the side of wo, eta beyond.
dvec3 reference_rough_glass(const Bsdf& bsdf, dvec3 wo, dvec3 wi) {
  const double alpha = bsdf.glossy.alpha, eta = bsdf.eta;
  const auto reflectance = [&](double cosine) {
    if (bsdf.thin_ior <= 0.0f) return reference_fresnel(cosine, eta);
    const double r = reference_fresnel(cosine, bsdf.thin_ior);
    return 2.0 * r / (1.0 + r);
  };
  const dvec3 tint(bsdf.glass_tint);
  if (wi.z > 0.0 || bsdf.thin_ior > 0.0f) {
    const dvec3 mirrored(wi.x, wi.y, std::abs(wi.z));
    const double r = reflectance(glm::dot(wo, glm::normalize(wo + mirrored)));
    const double f = reference_microfacets(alpha, wo, mirrored);
    return wi.z > 0.0 ? dvec3(f * r) : tint * (f * (1.0 - r));
  }
  dvec3 h = glm::normalize(-(wo + eta * wi));
  if (h.z < 0.0) h = -h;
  const double oh = glm::dot(wo, h), ih = glm::dot(wi, h);
  if (oh <= 0.0 || ih >= 0.0) return dvec3(0.0);
  const double a2 = alpha * alpha;
  const double d =
      a2 / (std::numbers::pi * std::pow(h.z, 4.0) * std::pow(a2 + 1.0 / (h.z * h.z) - 1.0, 2.0));
  const auto lambda = [&](double z) {
    return 0.5 * (std::sqrt(1.0 + a2 * (1.0 / (z * z) - 1.0)) - 1.0);
  };
  const double g = 1.0 / (1.0 + lambda(wo.z) + lambda(wi.z));
  const double f =
      oh * -ih * (1.0 - reflectance(oh)) * g * d / (wo.z * -wi.z * std::pow(oh + eta * ih, 2.0));
  return tint * f;
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
  double scale = 1.0;
  if (bsdf.glossy.alpha > 0.0f) scale = bsdf.glossy.alpha;
  if (shared::has_rough_clearcoat(bsdf)) scale = std::min(scale, double(bsdf.coat.alpha));
  const dvec3 mirror(-wo.x, -wo.y, wo.z);
  return {glm::normalize(mirror), scale, true};
}

DirectionChart chart_below(const Bsdf& bsdf, vec3 wo) {
  dvec3 axis = dvec3(-wo.x, -wo.y, 0.0) / double(bsdf.eta);
  axis.z = std::sqrt(std::max(1.0 - glm::dot(axis, axis), 1e-4));
  return {glm::normalize(axis), double(bsdf.glossy.alpha), true};
}

dvec3 non_specular_albedo(const Bsdf& bsdf, vec3 wo) {
  dvec3 albedo = chart_for(bsdf, wo).integrate_all(
      [&](dvec3 wi) { return dvec3(shared::bsdf_eval(bsdf, wo, vec3(wi))) * wi.z; });
  if (shared::has_rough_glass(bsdf)) {
    const double eta2 = double(bsdf.eta) * bsdf.eta;
    albedo += chart_below(bsdf, wo).integrate_all([&](dvec3 wi) {
      return dvec3(shared::bsdf_eval(bsdf, wo, vec3(below(wi)))) * (wi.z * eta2);
    });
  }
  return albedo;
}

dvec3 directional_albedo(const Bsdf& bsdf, vec3 wo) {
  const shared::SpecularLobes specular = shared::specular_lobes(bsdf, wo.z);
  return non_specular_albedo(bsdf, wo) + dvec3(specular.reflected) + dvec3(specular.transmitted);
}

dvec3 reference_eval(const Bsdf& bsdf, dvec3 wo, dvec3 wi) {
  const double under = coat_passes(bsdf.coat, std::min(wo.z, std::abs(wi.z)));
  dvec3 f(0.0);
  if (shared::has_rough_glass(bsdf)) {
    f = reference_rough_glass(bsdf, wo, wi) * (double(bsdf.glass) * under);
  }
  if (wi.z < 0.0) return f;
  f += dvec3(bsdf.diffuse.albedo) * reference_diffuse(bsdf, wo.z, wi.z);
  const double cosine = std::min(glm::dot(wo, glm::normalize(wo + wi)), 1.0);
  if (bsdf.glossy.alpha > 0.0f) {
    const double facets = under * reference_microfacets(bsdf.glossy.alpha, wo, wi);
    for (int c = 0; c < 3; ++c) {
      f[c] += facets * schlick(bsdf.glossy.f0[c], bsdf.glossy.f90, cosine);
    }
  }
  if (shared::has_rough_clearcoat(bsdf)) {
    f += reference_microfacets(bsdf.coat.alpha, wo, wi) * (1.0 - coat_passes(bsdf.coat, cosine));
  }
  return f;
}

}  // namespace ppm::statistics
