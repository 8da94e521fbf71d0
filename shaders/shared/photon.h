// The photon record: what a surface keeps of a photon that lands on it. Two planes of 16 bytes; a
// search that rejects a photon for its distance reads only the first.
#ifndef PPM_SHARED_PHOTON_H
#define PPM_SHARED_PHOTON_H

#include "shared/geometry.h"

PPM_NAMESPACE_BEGIN

struct Photon {
  vec3 position;
  vec3 incident;  // unit, pointing back to where the photon came from
  vec3 flux;      // incident flux, cosine not included (it is in the density of photons)
  vec3 normal;    // geometric, on the side the photon arrived on
  uint events;    // scattering events before, saturates at 255
};

PPM_FN uvec4 pack_photon_position(Photon photon) {
  return uvec4(floatBitsToUint(photon.position.x), floatBitsToUint(photon.position.y),
               floatBitsToUint(photon.position.z), pack_direction(photon.incident));
}

// The event count sits in the low byte of the third channel's mantissa, which is rounded to 16 bits
// for it: an error up to 2^-16 of that channel, against 4 bytes more a photon.
PPM_FN uvec4 pack_photon_flux(Photon photon) {
  uint blue = (floatBitsToUint(photon.flux.z) + 0x80u) & 0xffffff00u;
  return uvec4(floatBitsToUint(photon.flux.x), floatBitsToUint(photon.flux.y),
               blue | min(photon.events, 255u), pack_direction(photon.normal));
}

PPM_FN Photon unpack_photon(uvec4 position, uvec4 flux) {
  Photon photon;
  photon.position =
      vec3(uintBitsToFloat(position.x), uintBitsToFloat(position.y), uintBitsToFloat(position.z));
  photon.incident = unpack_direction(position.w);
  photon.flux =
      vec3(uintBitsToFloat(flux.x), uintBitsToFloat(flux.y), uintBitsToFloat(flux.z & 0xffffff00u));
  photon.normal = unpack_direction(flux.w);
  photon.events = flux.z & 0xffu;
  return photon;
}

// Surfaces that face about the same way: the cosine between their normals is above this.
#define PPM_LEAST_NORMAL_COSINE 0.1f

// Whether a photon found within a hit point's disc counts there: it must have arrived on the side
// the eye sees (every lobe stored today reflects), on a surface that faces about the same way. The
// normals' threshold keeps light from leaking through thin walls and around edges; it vanishes with
// the radius on smooth surfaces.
PPM_FN bool accepts_photon(vec3 hit_normal, vec3 incident, vec3 photon_normal) {
  return dot(photon_normal, hit_normal) > PPM_LEAST_NORMAL_COSINE &&
         dot(incident, hit_normal) > 0.0f;
}

// The same from packed directions, without making them unit vectors.
PPM_FN bool accepts_packed_photon(vec3 hit_normal, uint incident, uint photon_normal) {
  vec3 normal = unpack_octahedral(photon_normal);
  float cosine = dot(normal, hit_normal);
  float least = PPM_LEAST_NORMAL_COSINE * PPM_LEAST_NORMAL_COSINE * dot(normal, normal);
  return cosine > 0.0f && cosine * cosine > least &&
         dot(unpack_octahedral(incident), hit_normal) > 0.0f;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_PHOTON_H
