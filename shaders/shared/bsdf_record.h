// What a hit point keeps of a surface's lobes.
#ifndef PPM_SHARED_BSDF_RECORD_H
#define PPM_SHARED_BSDF_RECORD_H

#include "shared/bsdf.h"

PPM_NAMESPACE_BEGIN

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
  bsdf.coat.strength = 0.0f;
  bsdf.coat.alpha = 0.0f;
  return bsdf;
}

// What rough glass and a clearcoat add to that, in 128 bits: six 16-bit unorms, and the index of a
// solid, or the negated one of a thin sheet.
PPM_FN uvec4 pack_layers(Bsdf bsdf) {
  float index = bsdf.thin_ior > 0.0f ? -bsdf.thin_ior : bsdf.eta;
  return uvec4(packUnorm2x16(vec2(bsdf.glass, bsdf.glass_tint.x)),
               packUnorm2x16(vec2(bsdf.glass_tint.y, bsdf.glass_tint.z)), floatBitsToUint(index),
               packUnorm2x16(vec2(bsdf.coat.strength, sqrt(bsdf.coat.alpha))));
}

PPM_FN Bsdf with_layers(Bsdf bsdf, uvec4 words) {
  vec2 a = unpackUnorm2x16(words.x);
  vec2 b = unpackUnorm2x16(words.y);
  vec2 c = unpackUnorm2x16(words.w);
  float index = uintBitsToFloat(words.z);
  Bsdf result = bsdf;
  result.glass = a.x;
  result.glass_tint = vec3(a.y, b.x, b.y);
  result.eta = index < 0.0f ? 1.0f : index;
  result.thin_ior = index < 0.0f ? -index : 0.0f;
  result.coat.strength = c.x;
  result.coat.alpha = c.y * c.y;
  return result;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_BSDF_RECORD_H
