// What a surface does to light: the lobes of a material at one point, for both directions of
// transport.
//
// Directions are in the shading frame with the normal on the side of wo, and both point away from
// the surface. No value includes a cosine unless its name says so; densities are per solid angle.
//
// Specular here means a delta lobe: the mirror reflection of a smooth surface or coat, and smooth
// glass. All other lobes are "non-specular": a surface that has any of them stores hit points and
// photons [HOJ08 section 3.1].
//
// From top to bottom: a clearcoat; below it, side by side, the glossy lobe, glass (smooth or as
// rough as the gloss) and the diffuse base.
#ifndef PPM_SHARED_BSDF_H
#define PPM_SHARED_BSDF_H

#include "shared/bsdf/clearcoat.h"
#include "shared/bsdf/diffuse.h"
#include "shared/bsdf/ggx.h"
#include "shared/bsdf/rough_dielectric.h"

PPM_NAMESPACE_BEGIN

// Below this perceptual roughness the GGX lobe counts as a delta. At 0.03 its peak is 1/(4 pi
// alpha^2) = 1e5, more than progressive radii resolve in any reasonable time.
#define PPM_DELTA_ROUGHNESS 0.03f

// Kernels may define these as specialisation constants: what no surface of the scene has need not
// be run. Layers are rough glass and clearcoats.
#ifndef PPM_ROUGH_GLOSS
#define PPM_ROUGH_GLOSS true
#endif
#ifndef PPM_LAYERS
#define PPM_LAYERS true
#endif

struct Bsdf {
  DiffuseLobe diffuse;
  GgxLobe glossy;   // a mirror when alpha is 0
  float glass;      // share of the surface that is glass, as rough as the glossy lobe
  vec3 glass_tint;  // of what glass transmits
  float eta;        // index beyond the surface over index on the side of wo; 1 for a thin sheet
  float thin_ior;   // index of a thin sheet, 0 if not one
  Clearcoat coat;
};

PPM_FN bool has_glossy(Bsdf bsdf) {
  return bsdf.glossy.f90 > 0.0f || max_component(bsdf.glossy.f0) > 0.0f;
}
PPM_FN bool has_mirror(Bsdf bsdf) {
  return bsdf.glossy.alpha == 0.0f && has_glossy(bsdf);
}
PPM_FN bool has_rough_gloss(Bsdf bsdf) {
  return PPM_ROUGH_GLOSS && bsdf.glossy.alpha > 0.0f && has_glossy(bsdf);
}

PPM_FN bool has_rough_glass(Bsdf bsdf) {
  bool shows = bsdf.thin_ior > 0.0f || max(bsdf.eta, 1.0f / bsdf.eta) >= PPM_LEAST_ROUGH_ETA;
  return PPM_LAYERS && bsdf.glass > 0.0f && bsdf.glossy.alpha > 0.0f && shows;
}
PPM_FN bool has_clearcoat(Bsdf bsdf) {
  return PPM_LAYERS && bsdf.coat.strength > 0.0f;
}
PPM_FN bool has_rough_clearcoat(Bsdf bsdf) {
  return has_clearcoat(bsdf) && bsdf.coat.alpha > 0.0f;
}

// Whether the surface has a non-specular component.
PPM_FN bool is_non_specular(Bsdf bsdf) {
  return max_component(bsdf.diffuse.albedo) > 0.0f || has_rough_gloss(bsdf) ||
         has_rough_glass(bsdf) || has_rough_clearcoat(bsdf);
}

// The non-specular lobes, prepared for one wo and many wi: what does not depend on wi is worked out
// once.
struct BsdfTowards {
  vec3 wo;
  vec3 diffuse;  // diffuse_base
  float coat_f0, coat_f90;
  GgxLobe glossy;  // alpha is 0 without rough gloss
  RoughDielectric glass;
  float glass_share;  // 0 without rough glass
  vec3 glass_tint;    // share included
  Clearcoat clearcoat;
};

PPM_FN RoughDielectric rough_glass(Bsdf bsdf) {
  RoughDielectric lobe;
  lobe.alpha = bsdf.glossy.alpha;
  lobe.eta = bsdf.eta;
  lobe.thin_ior = bsdf.thin_ior;
  return lobe;
}

PPM_FN BsdfTowards bsdf_towards(Bsdf bsdf, vec3 wo) {
  BsdfTowards result;
  result.wo = wo;
  result.diffuse = wo.z > 0.0f ? diffuse_base(bsdf.diffuse, wo.z) : vec3(0.0f);
  result.coat_f0 = bsdf.diffuse.coat_f0;
  result.coat_f90 = bsdf.diffuse.coat_f90;
  result.glossy = bsdf.glossy;
  if (wo.z <= 0.0f || !has_rough_gloss(bsdf)) result.glossy.alpha = 0.0f;
  result.glass = rough_glass(bsdf);
  result.glass_share = wo.z > 0.0f && has_rough_glass(bsdf) ? bsdf.glass : 0.0f;
  result.glass_tint = bsdf.glass_tint * result.glass_share;
  result.clearcoat = bsdf.coat;
  if (wo.z <= 0.0f || !has_clearcoat(bsdf)) result.clearcoat.strength = 0.0f;
  if (has_clearcoat(bsdf)) {
    result.diffuse *= diffuse_under_clearcoat(bsdf.diffuse, bsdf.coat, wo.z);
  }
  return result;
}

// Without layers 0 unless wi.z > 0; with them wi may come from beyond the surface, and what rough
// glass lets through is told for radiance towards wo. wi.z is not 0.
PPM_FN vec3 bsdf_eval_towards(BsdfTowards bsdf, vec3 wi) {
  DiffuseLobe coat;
  coat.albedo = vec3(0.0f);
  coat.coat_f0 = bsdf.coat_f0;
  coat.coat_f90 = bsdf.coat_f90;
  vec3 diffuse = bsdf.diffuse * coat_transmittance(coat, wi.z);
  vec3 facets = vec3(0.0f);
  if (PPM_ROUGH_GLOSS && bsdf.glossy.alpha > 0.0f) facets = ggx_eval(bsdf.glossy, bsdf.wo, wi);
  if (!PPM_LAYERS) return diffuse + facets;

  bool through = wi.z < 0.0f;
  if (through) diffuse = facets = vec3(0.0f);
  if (bsdf.glass_share > 0.0f) {
    vec3 f = rough_dielectric_eval(bsdf.glass, bsdf.glass_tint, bsdf.wo, wi);
    facets += through ? f : f * bsdf.glass_share;
  }
  if (bsdf.clearcoat.strength > 0.0f) {
    diffuse *= clearcoat_transmittance(bsdf.clearcoat, wi.z);
    facets *= under_clearcoat(bsdf.clearcoat, bsdf.wo.z, wi.z);
    if (bsdf.clearcoat.alpha > 0.0f && !through) {
      facets += ggx_eval(clearcoat_lobe(bsdf.clearcoat), bsdf.wo, wi);
    }
  }
  return diffuse + facets;
}

// The same for one pair of directions. Zero unless wo is above the surface.
PPM_FN vec3 bsdf_eval(Bsdf bsdf, vec3 wo, vec3 wi) {
  bool through = wi.z < 0.0f && has_rough_glass(bsdf);
  if (wo.z <= 0.0f || (wi.z <= 0.0f && !through)) return vec3(0.0f);
  return bsdf_eval_towards(bsdf_towards(bsdf, wo), wi);
}

// The specular lobes seen along wo: what reflection and transmission carry (Fresnel terms and tint
// included), and the cosine of the transmitted direction (0 where there is none).
struct SpecularLobes {
  vec3 reflected, transmitted;
  float cos_transmitted;
};

PPM_FN SpecularLobes specular_lobes(Bsdf bsdf, float cos_o) {
  SpecularLobes lobes;
  lobes.reflected = vec3(0.0f);
  lobes.transmitted = vec3(0.0f);
  lobes.cos_transmitted = 0.0f;
  if (has_mirror(bsdf)) {
    lobes.reflected =
        bsdf.glossy.f0 + (vec3(bsdf.glossy.f90) - bsdf.glossy.f0) * schlick_weight(cos_o);
  }
  if (bsdf.glass > 0.0f && !has_rough_glass(bsdf)) {
    float fresnel;
    if (bsdf.thin_ior > 0.0f) {
      float unused;
      fresnel = thin_sheet_reflectance(fresnel_dielectric(cos_o, bsdf.thin_ior, unused));
      lobes.cos_transmitted = cos_o;
    } else {
      fresnel = fresnel_dielectric(cos_o, bsdf.eta, lobes.cos_transmitted);
    }
    lobes.reflected += vec3(bsdf.glass * fresnel);
    lobes.transmitted = bsdf.glass_tint * (bsdf.glass * (1.0f - fresnel));
  }
  if (has_clearcoat(bsdf)) {
    float passes = clearcoat_transmittance(bsdf.coat, cos_o);
    lobes.reflected *= passes;
    lobes.transmitted *= under_clearcoat(bsdf.coat, cos_o, lobes.cos_transmitted);
    if (bsdf.coat.alpha == 0.0f) lobes.reflected += vec3(1.0f - passes);
  }
  return lobes;
}

PPM_FN vec3 specular_reflection(vec3 wo) {
  return vec3(-wo.x, -wo.y, wo.z);
}

PPM_FN vec3 specular_transmission(Bsdf bsdf, vec3 wo, float cos_transmitted) {
  return vec3(-wo.x / bsdf.eta, -wo.y / bsdf.eta, -cos_transmitted);
}

// How the lobes share the random choice: by what each is expected to carry away.
struct LobeChoice {
  float diffuse, glossy, reflection, transmission;  // probabilities, sum with the next 1 (or all
                                                    // 0: black)
  float glass, coat;                                // rough ones
};

PPM_FN LobeChoice lobe_choice(Bsdf bsdf, SpecularLobes specular, float cos_o) {
  LobeChoice choice;
  choice.diffuse = mean_component(bsdf.diffuse.albedo) * coat_transmittance(bsdf.diffuse, cos_o);
  choice.glossy = 0.0f;
  if (has_rough_gloss(bsdf)) {
    float weight = schlick_weight(cos_o);
    float f0 = mean_component(bsdf.glossy.f0);
    choice.glossy = f0 + (bsdf.glossy.f90 - f0) * weight;
  }
  choice.glass = 0.0f;
  choice.coat = 0.0f;
  if (has_rough_glass(bsdf)) {
    float reflectance = facet_reflectance(rough_glass(bsdf), cos_o);
    choice.glass =
        bsdf.glass * (reflectance + (1.0f - reflectance) * mean_component(bsdf.glass_tint));
  }
  if (has_clearcoat(bsdf)) {
    float passes = clearcoat_transmittance(bsdf.coat, cos_o);
    choice.diffuse *= passes;
    choice.glossy *= passes;
    choice.glass *= passes;
    if (bsdf.coat.alpha > 0.0f) choice.coat = 1.0f - passes;
  }
  choice.reflection = mean_component(specular.reflected);
  choice.transmission = mean_component(specular.transmitted);
  float sum = choice.diffuse + choice.glossy + choice.reflection + choice.transmission;
  if (PPM_LAYERS) sum += choice.glass + choice.coat;
  float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
  choice.diffuse *= scale;
  choice.glossy *= scale;
  choice.reflection *= scale;
  choice.transmission *= scale;
  choice.glass *= scale;
  choice.coat *= scale;
  return choice;
}

// Density with which bsdf_sample, given wo, draws the non-specular direction wi (choice of lobe
// included).
PPM_FN float bsdf_pdf_solid_angle(Bsdf bsdf, vec3 wo, vec3 wi) {
  bool through = wi.z < 0.0f && has_rough_glass(bsdf);
  if (wo.z <= 0.0f || (wi.z <= 0.0f && !through)) return 0.0f;
  LobeChoice choice = lobe_choice(bsdf, specular_lobes(bsdf, wo.z), wo.z);
  float pdf = choice.diffuse * cosine_hemisphere_pdf_solid_angle(wi.z);
  if (choice.glossy > 0.0f) pdf += choice.glossy * ggx_pdf_solid_angle(bsdf.glossy.alpha, wo, wi);
  if (!PPM_LAYERS) return pdf;
  if (choice.coat > 0.0f) pdf += choice.coat * ggx_pdf_solid_angle(bsdf.coat.alpha, wo, wi);
  if (through) pdf = 0.0f;
  if (choice.glass > 0.0f) {
    float tint = mean_component(bsdf.glass_tint);
    pdf += choice.glass * rough_dielectric_pdf_solid_angle(rough_glass(bsdf), tint, wo, wi);
  }
  return pdf;
}

// The surface as met from beyond it, along the same path.
PPM_FN Bsdf other_side(Bsdf bsdf) {
  Bsdf result = bsdf;
  result.eta = 1.0f / bsdf.eta;
  return result;
}

// Density of wo given wi: the path walked backwards, from the other side if wi lies there.
PPM_FN float bsdf_reverse_pdf_solid_angle(Bsdf bsdf, vec3 wo, vec3 wi) {
  if (wi.z > 0.0f) return bsdf_pdf_solid_angle(bsdf, wi, wo);
  return bsdf_pdf_solid_angle(other_side(bsdf), vec3(wi.x, wi.y, -wi.z), vec3(wo.x, wo.y, -wo.z));
}

#define PPM_TRANSPORT_RADIANCE \
  0u                           // wo points to the eye: what is sampled is where light comes from
#define PPM_TRANSPORT_FLUX 1u  // wo points to the light: photons

struct BsdfSample {
  vec3 wi;      // zero length: absorbed
  vec3 weight;  // f * |cos_i| / pdf; radiance includes the squared ratio of indices
  float forward_pdf_solid_angle;  // of wi given wo, lobe choice included; specular: the choice's
                                  // probability
  float reverse_pdf_solid_angle;  // of wo given wi
  uint specular;                  // 1: a delta lobe
  uint transmission;              // 1: wi is on the other side
};

PPM_FN BsdfSample absorbed_sample() {
  BsdfSample result;
  result.wi = vec3(0.0f);
  result.weight = vec3(0.0f);
  result.forward_pdf_solid_angle = 0.0f;
  result.reverse_pdf_solid_angle = 0.0f;
  result.specular = 0u;
  result.transmission = 0u;
  return result;
}

// u.x chooses the lobe, u.yz the direction.
PPM_FN BsdfSample bsdf_sample(Bsdf bsdf, vec3 wo, vec3 u, uint transport) {
  BsdfSample result = absorbed_sample();
  if (wo.z <= 0.0f) return result;
  SpecularLobes specular = specular_lobes(bsdf, wo.z);
  LobeChoice choice = lobe_choice(bsdf, specular, wo.z);

  float threshold = choice.reflection;
  if (u.x < threshold) {
    result.wi = specular_reflection(wo);
    result.weight = specular.reflected / choice.reflection;
    result.forward_pdf_solid_angle = choice.reflection;
    result.reverse_pdf_solid_angle = choice.reflection;
    result.specular = 1u;
    return result;
  }
  threshold += choice.transmission;
  if (u.x < threshold) {
    result.wi = specular_transmission(bsdf, wo, specular.cos_transmitted);
    result.weight = specular.transmitted / choice.transmission;
    if (transport == PPM_TRANSPORT_RADIANCE) result.weight /= bsdf.eta * bsdf.eta;
    result.forward_pdf_solid_angle = choice.transmission;
    // The way back starts on the other side, where other lobes may share the choice differently.
    Bsdf beyond = other_side(bsdf);
    SpecularLobes back = specular_lobes(beyond, specular.cos_transmitted);
    result.reverse_pdf_solid_angle =
        lobe_choice(beyond, back, specular.cos_transmitted).transmission;
    result.specular = 1u;
    result.transmission = 1u;
    return result;
  }
  threshold += choice.glossy;
  uint through = 0u;
  vec3 wi = u.x < threshold ? ggx_sample(bsdf.glossy.alpha, wo, vec2(u.y, u.z))
                            : sample_cosine_hemisphere(vec2(u.y, u.z));
  if (choice.coat > 0.0f && u.x >= threshold && u.x < threshold + choice.coat) {
    wi = ggx_sample(bsdf.coat.alpha, wo, vec2(u.y, u.z));
  }
  threshold += choice.coat;
  if (choice.glass > 0.0f && u.x >= threshold && u.x < threshold + choice.glass) {
    float within = clamp((u.x - threshold) / choice.glass, 0.0f, 0.99999994f);
    wi = rough_dielectric_sample(rough_glass(bsdf), mean_component(bsdf.glass_tint), wo,
                                 vec3(within, u.y, u.z), through);
  }
  float pdf = bsdf_pdf_solid_angle(bsdf, wo, wi);
  if ((wi.z <= 0.0f) != (through == 1u) || pdf <= 0.0f) return result;
  result.wi = wi;
  result.weight = bsdf_eval(bsdf, wo, wi) * (abs(wi.z) / pdf);
  if (through == 1u && transport == PPM_TRANSPORT_FLUX) result.weight *= bsdf.eta * bsdf.eta;
  result.forward_pdf_solid_angle = pdf;
  result.reverse_pdf_solid_angle = bsdf_reverse_pdf_solid_angle(bsdf, wo, wi);
  result.transmission = through;
  return result;
}

// Shading normals break the symmetry that photons rely on. Veach's correction for a photon that
// arrives from wi and leaves along wo: flux times |wi.ns| |wo.ng| / (|wi.ng| |wo.ns|) [Veach 1997,
// section 5.3]. Its factors have no bound; above this they are clamped and counted.
#define PPM_MAX_NORMAL_FACTOR 10.0f

PPM_FN float shading_normal_factor(float wi_ns, float wi_ng, float wo_ns, float wo_ng) {
  return abs(wi_ns * wo_ng) / max(abs(wi_ng * wo_ns), 1e-12f);
}

// The same at a hit point: photon density is per area of the photon's own surface, f_r is about the
// hit point's shading normal, so each photon counts |w.ns| / |w.ng| times.
PPM_FN float merge_normal_factor(float w_ns, float w_ng) {
  return abs(w_ns) / max(abs(w_ng), 1e-12f);
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_BSDF_H
