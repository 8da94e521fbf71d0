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

// Per steradian; no cosine included.
PPM_FN vec3 ggx_eval(GgxLobe lobe, vec3 wo, vec3 wi) {
  vec3 half_vector = normalize(wo + wi);
  float masking = 1.0f / (1.0f + ggx_lambda(lobe.alpha, wo) + ggx_lambda(lobe.alpha, wi));
  float weight = schlick_weight(dot(wo, half_vector));
  vec3 fresnel = lobe.f0 + (vec3(lobe.f90) - lobe.f0) * weight;
  return fresnel * (ggx_distribution(lobe.alpha, half_vector) * masking / (4.0f * wo.z * wi.z));
}

// Density of ggx_sample, solid angle of wi.
PPM_FN float ggx_pdf_solid_angle(float alpha, vec3 wo, vec3 wi) {
  vec3 half_vector = normalize(wo + wi);
  return ggx_distribution(alpha, half_vector) / (4.0f * wo.z * (1.0f + ggx_lambda(alpha, wo)));
}

// A direction reflected about a visible normal. May point below the surface (z <= 0): no light
// then.
PPM_FN vec3 ggx_sample(float alpha, vec3 wo, vec2 u) {
  vec3 stretched = normalize(vec3(alpha * wo.x, alpha * wo.y, wo.z));
  float z = (1.0f - u.x) * (1.0f + stretched.z) - stretched.z;
  float r = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
  vec2 circle = unit_circle(u.y);
  vec3 cap = vec3(r * circle.x, r * circle.y, z) + stretched;
  vec3 normal = normalize(vec3(alpha * cap.x, alpha * cap.y, max(cap.z, 0.0f)));
  return normal * (2.0f * dot(wo, normal)) - wo;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_BSDF_GGX_H
