// Rough glass: a surface of GGX microfacets, each of which reflects and transmits as Fresnel's
// equations say.
//
// Walter et al.: Microfacet Models for Refraction through Rough Surfaces (2007). Masking is
// 1 / (1 + Lambda_o + Lambda_i) on either side: symmetric, and never above G1 of either direction,
// so that no energy is gained; light that would meet a second facet is lost.
//
// A solid bends: eta is the index beyond the surface over the one on the side of wo, and values for
// wi beyond it are those for radiance towards wo; for flux they are eta^2 times that [Veach 1997,
// section 5.2]. A thin sheet (thin_ior > 0) does not: its transmission is its reflection mirrored
// at the sheet, shared out as between the two faces of a smooth one. Directions are in the shading
// frame, wo.z > 0, wi.z != 0.
#ifndef PPM_SHARED_BSDF_ROUGH_DIELECTRIC_H
#define PPM_SHARED_BSDF_ROUGH_DIELECTRIC_H

#include "shared/bsdf/ggx.h"

PPM_NAMESPACE_BEGIN

// Indices closer than this bend by less than the roughness could show, and leave no digits of the
// facet's normal: such an interface is smooth glass.
#define PPM_LEAST_ROUGH_ETA 1.01f

struct RoughDielectric {
  float alpha;
  float eta;       // 1 for a thin sheet
  float thin_ior;  // 0 for a solid
};

PPM_FN float facet_reflectance(RoughDielectric lobe, float cosine) {
  float unused;
  bool thin = lobe.thin_ior > 0.0f;
  float reflectance = fresnel_dielectric(cosine, thin ? lobe.thin_ior : lobe.eta, unused);
  return thin ? thin_sheet_reflectance(reflectance) : reflectance;
}

// The chance that a facet that reflects F and transmits (1 - F) tint is made to reflect.
PPM_FN float facet_choice(float reflectance, float tint) {
  return reflectance / max(reflectance + (1.0f - reflectance) * tint, 1e-20f);
}

// What both value and density of a direction are made of.
struct FacetMeeting {
  float reflectance;  // of the facet
  float facets;       // reflected or thin: D / 4; refracted: D |o.h| |i.h| / (o.h + eta i.h)^2
  float slope_o, slope_i;
  uint exists;  // 1: some facet sends light from wi to wo
};

PPM_FN FacetMeeting facet_meeting(RoughDielectric lobe, vec3 wo, vec3 wi) {
  float a2 = lobe.alpha * lobe.alpha;
  bool through = wi.z < 0.0f;
  bool bends = through && lobe.thin_ior <= 0.0f;
  // The facet's normal, of any length and sign; D of it is a2 |h|^4 / (pi d^2).
  vec3 h = bends ? wo + wi * lobe.eta : wo + vec3(wi.x, wi.y, abs(wi.z));
  float h2 = max(dot(h, h), 1e-20f);
  float d = a2 * h.z * h.z + (h.x * h.x + h.y * h.y);
  float cos_o = dot(wo, h);
  float cos_i = dot(wi, h);
  FacetMeeting meeting;
  meeting.reflectance = facet_reflectance(lobe, min(abs(cos_o) / sqrt(h2), 1.0f));
  meeting.slope_o = sqrt(wo.z * wo.z + a2 * (wo.x * wo.x + wo.y * wo.y));
  meeting.slope_i = sqrt(wi.z * wi.z + a2 * (wi.x * wi.x + wi.y * wi.y));
  float scale = bends ? abs(cos_o * cos_i) : 0.25f * h2 * h2;
  meeting.facets = scale * a2 * PPM_INVERSE_PI / max(d * d, 1e-37f);
  // A facet that bends light is met on its front by one direction, on its back by the other.
  meeting.exists = !bends || (cos_o * h.z > 0.0f && cos_i * h.z < 0.0f) ? 1u : 0u;
  return meeting;
}

// Per steradian; no cosine included. `tint` is of what is transmitted.
PPM_FN vec3 rough_dielectric_eval(RoughDielectric lobe, vec3 tint, vec3 wo, vec3 wi) {
  FacetMeeting meeting = facet_meeting(lobe, wo, wi);
  // G2 over both cosines, see ggx_eval.
  float masking = 2.0f / (wo.z * meeting.slope_i + abs(wi.z) * meeting.slope_o);
  float f = meeting.exists == 1u ? meeting.facets * masking : 0.0f;
  return wi.z < 0.0f ? tint * (f * (1.0f - meeting.reflectance)) : vec3(f * meeting.reflectance);
}

// Density of rough_dielectric_sample, solid angle of wi. `tint` is the mean of the transmission's.
PPM_FN float rough_dielectric_pdf_solid_angle(RoughDielectric lobe, float tint, vec3 wo, vec3 wi) {
  FacetMeeting meeting = facet_meeting(lobe, wo, wi);
  float reflects = facet_choice(meeting.reflectance, tint);
  bool through = wi.z < 0.0f;
  float choice = through ? 1.0f - reflects : reflects;
  float stretch = through && lobe.thin_ior <= 0.0f ? lobe.eta * lobe.eta : 1.0f;
  return meeting.exists == 1u ? choice * stretch * 2.0f * meeting.facets / (wo.z + meeting.slope_o)
                              : 0.0f;
}

// u.x chooses between reflection and transmission. The direction may lie on the wrong side of the
// surface (`transmits` tells which is meant): no light then.
PPM_FN vec3 rough_dielectric_sample(RoughDielectric lobe, float tint, vec3 wo, vec3 u,
                                    PPM_OUT(uint) transmits) {
  vec3 normal = ggx_sample_normal(lobe.alpha, wo, vec2(u.y, u.z));
  float cosine = dot(wo, normal);
  transmits = u.x < facet_choice(facet_reflectance(lobe, min(cosine, 1.0f)), tint) ? 0u : 1u;
  vec3 mirrored = normal * (2.0f * cosine) - wo;
  if (transmits == 0u) return mirrored;
  if (lobe.thin_ior > 0.0f) return vec3(mirrored.x, mirrored.y, -mirrored.z);
  float cos_transmitted;
  fresnel_dielectric(min(cosine, 1.0f), lobe.eta, cos_transmitted);
  return normalize(normal * (cosine / lobe.eta - cos_transmitted) - wo * (1.0f / lobe.eta));
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_BSDF_ROUGH_DIELECTRIC_H
