// The glossy lobe: GGX microfacets with Smith's height-correlated masking and Schlick's Fresnel
// term.
//
// Walter et al. 2007; Heitz: Understanding the Masking-Shadowing Function (JCGT 2014); visible
// normals are sampled by Dupuy and Benyoub: Sampling Visible GGX Normals with Spherical Caps
// (2023). Directions are in the shading frame (normal = +z), both pointing away from the surface, z
// > 0.
#ifndef PPM_SHARED_BSDF_GGX_H
#define PPM_SHARED_BSDF_GGX_H

#include "shared/fresnel.h"
#include "shared/warp.h"

PPM_NAMESPACE_BEGIN

struct GgxLobe {
  vec3 f0;
  float f90;
  float alpha;  // square of the perceptual roughness
};

// Distribution of normals, per steradian. The form in sin^2 keeps its digits near the peak.
PPM_FN float ggx_distribution(float alpha, vec3 half_vector) {
  float a2 = alpha * alpha;
  float sin2 = half_vector.x * half_vector.x + half_vector.y * half_vector.y;
  float d = a2 * half_vector.z * half_vector.z + sin2;
  return a2 * PPM_INVERSE_PI / (d * d);
}

// Smith's Lambda.
PPM_FN float ggx_lambda(float alpha, vec3 w) {
  float tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 0.5f * (sqrt(1.0f + alpha * alpha * tan2) - 1.0f);
}

// Per steradian; no cosine included. The half vector h is left at its length, which cancels but for
// dot(wo, h) / |h| = |h| / 2; masking over the cosines is Heitz's
// 1 / (2 (z_o sqrt(z_i^2 + a^2 sin^2_i) + z_i sqrt(z_o^2 + a^2 sin^2_o))), which has no division
// but the last.
PPM_FN vec3 ggx_eval(GgxLobe lobe, vec3 wo, vec3 wi) {
  vec3 h = wo + wi;
  float h2 = dot(h, h);
  float a2 = lobe.alpha * lobe.alpha;
  float d = a2 * h.z * h.z + (h.x * h.x + h.y * h.y);
  float slope_i = sqrt(wi.z * wi.z + a2 * (wi.x * wi.x + wi.y * wi.y));
  float slope_o = sqrt(wo.z * wo.z + a2 * (wo.x * wo.x + wo.y * wo.y));
  float weight = schlick_weight(0.5f * sqrt(h2));
  vec3 fresnel = lobe.f0 + (vec3(lobe.f90) - lobe.f0) * weight;
  float numerator = (0.5f * PPM_INVERSE_PI) * a2 * h2 * h2;
  return fresnel * (numerator / (d * d * (wo.z * slope_i + wi.z * slope_o)));
}

// Density of ggx_sample, solid angle of wi.
PPM_FN float ggx_pdf_solid_angle(float alpha, vec3 wo, vec3 wi) {
  vec3 half_vector = normalize(wo + wi);
  return ggx_distribution(alpha, half_vector) / (4.0f * wo.z * (1.0f + ggx_lambda(alpha, wo)));
}

// A facet's normal as seen from wo: density G1(o) <o, h> D(h) / wo.z per steradian of h.
PPM_FN vec3 ggx_sample_normal(float alpha, vec3 wo, vec2 u) {
  vec3 stretched = normalize(vec3(alpha * wo.x, alpha * wo.y, wo.z));
  float z = (1.0f - u.x) * (1.0f + stretched.z) - stretched.z;
  float r = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
  vec2 circle = unit_circle(u.y);
  vec3 cap = vec3(r * circle.x, r * circle.y, z) + stretched;
  return normalize(vec3(alpha * cap.x, alpha * cap.y, max(cap.z, 0.0f)));
}

// A direction reflected about a visible normal. May point below the surface (z <= 0): no light
// then.
PPM_FN vec3 ggx_sample(float alpha, vec3 wo, vec2 u) {
  vec3 normal = ggx_sample_normal(alpha, wo, u);
  return normal * (2.0f * dot(wo, normal)) - wo;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_BSDF_GGX_H
