// What a surface does to light: the lobes of a material at one point, for both directions of
// transport.
//
// Directions are in the shading frame with the normal on the side of wo, and both point away from
// the surface. No value includes a cosine unless its name says so; densities are per solid angle.
//
// Specular here means a delta lobe: the mirror reflection of a smooth surface, and glass. All other
// lobes are "non-specular": a surface that has any of them stores hit points and photons [HOJ08
// section 3.1].
#ifndef PPM_SHARED_BSDF_H
#define PPM_SHARED_BSDF_H

#include "shared/bsdf/diffuse.h"
#include "shared/bsdf/ggx.h"

PPM_NAMESPACE_BEGIN

// Below this perceptual roughness the GGX lobe counts as a delta. At 0.03 its peak is 1/(4 pi
// alpha^2) = 1e5, more than progressive radii resolve in any reasonable time.
#define PPM_DELTA_ROUGHNESS 0.03f

// Kernels may define this as a specialisation constant: without rough gloss in the scene its code
// need not be run.
#ifndef PPM_ROUGH_GLOSS
#define PPM_ROUGH_GLOSS true
#endif

struct Bsdf {
  DiffuseLobe diffuse;
  GgxLobe glossy;   // a mirror when alpha is 0
  float glass;      // share of the surface that is glass
  vec3 glass_tint;  // of what glass transmits
  float eta;        // index beyond the surface over index on the side of wo; 1 for a thin sheet
  float thin_ior;   // index of a thin sheet, 0 if not one
};

// What a non-specular evaluation reads at a hit point, in 160 bits: ten 16-bit unorms.
// The one place that knows this format.
PPM_FN void pack_bsdf(Bsdf bsdf, PPM_OUT(uvec4) words, PPM_OUT(uint) extra) {
  words = uvec4(packUnorm2x16(vec2(bsdf.diffuse.albedo.x, bsdf.diffuse.albedo.y)),
                packUnorm2x16(vec2(bsdf.diffuse.albedo.z, bsdf.glossy.f90)),
                packUnorm2x16(vec2(bsdf.glossy.f0.x, bsdf.glossy.f0.y)),
                packUnorm2x16(vec2(bsdf.glossy.f0.z, sqrt(bsdf.glossy.alpha))));
  extra = packUnorm2x16(vec2(bsdf.diffuse.coat_f0, bsdf.diffuse.coat_f90));
}

PPM_FN Bsdf unpack_bsdf(uvec4 words, uint extra) {
  vec2 a = unpackUnorm2x16(words.x);
  vec2 b = unpackUnorm2x16(words.y);
  vec2 c = unpackUnorm2x16(words.z);
  vec2 d = unpackUnorm2x16(words.w);
  vec2 e = unpackUnorm2x16(extra);
  Bsdf bsdf;
  bsdf.diffuse.albedo = vec3(a.x, a.y, b.x);
  bsdf.diffuse.coat_f0 = e.x;
  bsdf.diffuse.coat_f90 = e.y;
  bsdf.glossy.f0 = vec3(c.x, c.y, d.x);
  bsdf.glossy.f90 = b.y;
  bsdf.glossy.alpha = d.y * d.y;
  bsdf.glass = 0.0f;
  bsdf.glass_tint = vec3(0.0f);
  bsdf.eta = 1.0f;
  bsdf.thin_ior = 0.0f;
  return bsdf;
}

PPM_FN bool has_glossy(Bsdf bsdf) {
  return bsdf.glossy.f90 > 0.0f || max_component(bsdf.glossy.f0) > 0.0f;
}
PPM_FN bool has_mirror(Bsdf bsdf) {
  return bsdf.glossy.alpha == 0.0f && has_glossy(bsdf);
}
PPM_FN bool has_rough_gloss(Bsdf bsdf) {
  return PPM_ROUGH_GLOSS && bsdf.glossy.alpha > 0.0f && has_glossy(bsdf);
}

// Whether the surface has a non-specular component.
PPM_FN bool is_non_specular(Bsdf bsdf) {
  return max_component(bsdf.diffuse.albedo) > 0.0f || has_rough_gloss(bsdf);
}

// The non-specular lobes. Zero unless both directions are above the surface.
PPM_FN vec3 bsdf_eval(Bsdf bsdf, vec3 wo, vec3 wi) {
  if (wo.z <= 0.0f || wi.z <= 0.0f) return vec3(0.0f);
  vec3 f = diffuse_eval(bsdf.diffuse, wo.z, wi.z);
  if (has_rough_gloss(bsdf)) f += ggx_eval(bsdf.glossy, wo, wi);
  return f;
}

// The same for many wi and one wo: what does not depend on wi is worked out once.
struct BsdfTowards {
  vec3 wo;
  vec3 diffuse;  // diffuse_base
  float coat_f0, coat_f90;
  GgxLobe glossy;  // alpha is 0 without rough gloss
};

PPM_FN BsdfTowards bsdf_towards(Bsdf bsdf, vec3 wo) {
  BsdfTowards result;
  result.wo = wo;
  result.diffuse = wo.z > 0.0f ? diffuse_base(bsdf.diffuse, wo.z) : vec3(0.0f);
  result.coat_f0 = bsdf.diffuse.coat_f0;
  result.coat_f90 = bsdf.diffuse.coat_f90;
  result.glossy = bsdf.glossy;
  if (wo.z <= 0.0f || !has_rough_gloss(bsdf)) result.glossy.alpha = 0.0f;
  return result;
}

// bsdf_eval(bsdf, wo, wi) for wi.z > 0.
PPM_FN vec3 bsdf_eval_towards(BsdfTowards bsdf, vec3 wi) {
  DiffuseLobe coat;
  coat.albedo = vec3(0.0f);
  coat.coat_f0 = bsdf.coat_f0;
  coat.coat_f90 = bsdf.coat_f90;
  vec3 f = bsdf.diffuse * coat_transmittance(coat, wi.z);
  if (PPM_ROUGH_GLOSS && bsdf.glossy.alpha > 0.0f) f += ggx_eval(bsdf.glossy, bsdf.wo, wi);
  return f;
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
  if (bsdf.glass > 0.0f) {
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
  float diffuse, glossy, reflection, transmission;  // probabilities, sum 1 (or all 0: black)
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
  choice.reflection = mean_component(specular.reflected);
  choice.transmission = mean_component(specular.transmitted);
  float sum = choice.diffuse + choice.glossy + choice.reflection + choice.transmission;
  float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
  choice.diffuse *= scale;
  choice.glossy *= scale;
  choice.reflection *= scale;
  choice.transmission *= scale;
  return choice;
}

// Density with which bsdf_sample, given wo, draws the non-specular direction wi (choice of lobe
// included). The reverse density is bsdf_pdf_solid_angle(bsdf, wi, wo).
PPM_FN float bsdf_pdf_solid_angle(Bsdf bsdf, vec3 wo, vec3 wi) {
  if (wo.z <= 0.0f || wi.z <= 0.0f) return 0.0f;
  LobeChoice choice = lobe_choice(bsdf, specular_lobes(bsdf, wo.z), wo.z);
  float pdf = choice.diffuse * cosine_hemisphere_pdf_solid_angle(wi.z);
  if (choice.glossy > 0.0f) pdf += choice.glossy * ggx_pdf_solid_angle(bsdf.glossy.alpha, wo, wi);
  return pdf;
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
    Bsdf beyond = bsdf;
    beyond.eta = 1.0f / bsdf.eta;
    SpecularLobes back = specular_lobes(beyond, specular.cos_transmitted);
    result.reverse_pdf_solid_angle =
        lobe_choice(beyond, back, specular.cos_transmitted).transmission;
    result.specular = 1u;
    result.transmission = 1u;
    return result;
  }
  threshold += choice.glossy;
  vec3 wi = u.x < threshold ? ggx_sample(bsdf.glossy.alpha, wo, vec2(u.y, u.z))
                            : sample_cosine_hemisphere(vec2(u.y, u.z));
  float pdf = bsdf_pdf_solid_angle(bsdf, wo, wi);
  if (wi.z <= 0.0f || pdf <= 0.0f) return result;
  result.wi = wi;
  result.weight = bsdf_eval(bsdf, wo, wi) * (wi.z / pdf);
  result.forward_pdf_solid_angle = pdf;
  result.reverse_pdf_solid_angle = bsdf_pdf_solid_angle(bsdf, wi, wo);
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
