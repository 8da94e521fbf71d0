// The photon record: what a surface keeps of a photon that lands on it. Two planes of 16 bytes:
// where it landed, which is all that a search reads of photons it rejects, and all that a hit point
// needs to know of those it accepts.
#ifndef PPM_SHARED_PHOTON_H
#define PPM_SHARED_PHOTON_H

#include "shared/geometry.h"
#include "shared/layout.h"

PPM_NAMESPACE_BEGIN

struct Photon {
  vec3 position;
  vec3 incident;  // unit, pointing back to where the photon came from
  vec3 flux;      // incident flux, cosine not included (it is in the density of photons)
  vec3 normal;    // geometric, on the side the photon arrived on; in scenes with layers that of the
                  // front side
  uint events;    // scattering events before, saturates at 255
};

PPM_FN uvec4 pack_photon_position(Photon photon) {
  return uvec4(floatBitsToUint(photon.position.x), floatBitsToUint(photon.position.y),
               floatBitsToUint(photon.position.z), 0u);
}

// Both directions; the flux as three 16-bit mantissas under one exponent, that of the largest
// channel: each is rounded by at most 2^-17 of the largest. Channels from 2^-111 on are kept.
PPM_FN uvec4 pack_photon_flux(Photon photon) {
  uint exponent = max(floatBitsToUint(max_component(photon.flux)) >> 23u, 16u);
  vec3 mantissa = photon.flux * uintBitsToFloat((269u - exponent) << 23u);  // below 2^16
  uint red = uint(min(roundEven(mantissa.x), 65535.0f));
  uint green = uint(min(roundEven(mantissa.y), 65535.0f));
  uint blue = uint(min(roundEven(mantissa.z), 65535.0f));
  return uvec4(pack_direction(photon.incident), pack_direction(photon.normal), red | (green << 16u),
               blue | ((exponent - 15u) << 16u) | (min(photon.events, 255u) << 24u));
}

// All but the position.
PPM_FN Photon unpack_photon_flux(uvec4 flux) {
  Photon photon;
  photon.position = vec3(0.0f);
  photon.incident = unpack_direction(flux.x);
  photon.normal = unpack_direction(flux.y);
  float scale = uintBitsToFloat((flux.w << 7u) & 0x7f800000u);
  photon.flux =
      vec3(float(flux.z & 0xffffu), float(flux.z >> 16u), float(flux.w & 0xffffu)) * scale;
  photon.events = flux.w >> 24u;
  return photon;
}

PPM_FN Photon unpack_photon(uvec4 position, uvec4 flux) {
  Photon photon = unpack_photon_flux(flux);
  photon.position =
      vec3(uintBitsToFloat(position.x), uintBitsToFloat(position.y), uintBitsToFloat(position.z));
  return photon;
}

// Surfaces that face about the same way: the cosine between their normals is above this.
#define PPM_LEAST_NORMAL_COSINE 0.1f

// Whether a photon found within a hit point's disc counts there: it must have arrived on the side
// the eye sees (every lobe stored today reflects), on a surface that faces about the same way. The
// normals' threshold keeps light from leaking through thin walls and around edges; it vanishes with
// the radius on smooth surfaces. incident and photon_normal are packed; they are not made unit
// vectors first.
PPM_FN bool accepts_packed_photon(vec3 hit_normal, uint incident, uint photon_normal) {
  vec3 normal = unpack_octahedral(photon_normal);
  float cosine = dot(normal, hit_normal);
  float least = PPM_LEAST_NORMAL_COSINE * PPM_LEAST_NORMAL_COSINE * dot(normal, normal);
  return cosine > 0.0f && cosine * cosine > least &&
         dot(unpack_octahedral(incident), hit_normal) > 0.0f;
}

// The same in scenes with layers. hit_flags: PPM_HIT_*. Where the hit point shows what lies beyond
// it, photons from there count, too, if they fell on the same face: those on the other face of a
// thin plate of glass did not.
PPM_FN bool accepts_packed_photon_of_layers(vec3 hit_normal, uint hit_flags, uint incident,
                                            uint photon_front) {
  vec3 front = unpack_octahedral(photon_front);
  vec3 from = unpack_octahedral(incident);
  float cosine = dot(front, hit_normal);
  float least = PPM_LEAST_NORMAL_COSINE * PPM_LEAST_NORMAL_COSINE * dot(front, front);
  float side = dot(from, hit_normal);  // positive: the eye's
  // The surface on the side of arrival and the hit point's on the same side face the same way.
  float alike = cosine * dot(from, front) * side;
  bool through = side < 0.0f && (hit_flags & PPM_HIT_TRANSMITS) != 0u;
  float facing = (hit_flags & PPM_HIT_BACK) != 0u ? -cosine : cosine;
  bool same_face = (hit_flags & PPM_HIT_SOLID) == 0u || facing > 0.0f;
  return alike > 0.0f && cosine * cosine > least && (side > 0.0f || through) && same_face;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_PHOTON_H
