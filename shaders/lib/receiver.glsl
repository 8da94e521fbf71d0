// A hit point that receives photons: f_r * flux of each [HOJ08 Eq. 11], and their sums.
#ifndef PPM_LIB_RECEIVER_GLSL
#define PPM_LIB_RECEIVER_GLSL

#include "lib/counters.glsl"
#include "lib/scene_kinds.glsl"
#include "lib/search.glsl"
#include "shared/bsdf_record.h"
#include "shared/ppm.h"

layout(binding = PPM_BIND_SCENE_CONSTANTS, scalar) uniform SceneBlock { SceneConstants scene; };
PPM_TEXELS(PPM_BIND_HITS_2, hits_2);
PPM_TEXELS(PPM_BIND_HITS_3, hits_3);
PPM_TEXELS(PPM_BIND_HITS_4, hits_4);
PPM_TEXELS(PPM_BIND_STATISTICS, statistics);
layout(binding = PPM_BIND_GATHER_SUMS, scalar) buffer GatherSums { GatherSum gather_sums[]; };

struct Receiver {
  vec3 position;
  vec3 geometric_normal;
  vec3 shading_normal, tangent, bitangent;
  int most_events;       // of a photon that counts, scattering events of the eye path taken off
  uint flags;            // PPM_HIT_*
  BsdfTowards bsdf;
};

Receiver fetch_receiver(uint hit) {
  uvec4 plane0 = PPM_FETCH(hits_0, hit);
  uvec4 plane1 = PPM_FETCH(hits_1, hit);
  Receiver receiver;
  receiver.position = uintBitsToFloat(plane0.xyz);
  receiver.geometric_normal = unpack_direction(plane0.w);
  receiver.shading_normal = unpack_direction(plane1.x);
  tangent_frame(receiver.shading_normal, receiver.tangent, receiver.bitangent);
  vec3 outgoing = unpack_direction(plane1.y);
  vec3 wo = vec3(dot(outgoing, receiver.tangent), dot(outgoing, receiver.bitangent),
                 dot(outgoing, receiver.shading_normal));
  receiver.flags = plane1.w;
  receiver.most_events = most_photon_events(scene.max_depth, plane1.w);
  Bsdf bsdf = unpack_bsdf(PPM_FETCH(hits_3, hit), PPM_FETCH(hits_2, hit).w);
  if (kLayers) bsdf = with_layers(bsdf, PPM_FETCH(hits_4, hit));
  receiver.bsdf = bsdf_towards(bsdf, wo);
  return receiver;
}

// Of a hit point: R^2, not positive where it is light seen.
float fetch_radius2(uint hit) { return uintBitsToFloat(PPM_FETCH(statistics, PPM_FETCH(hits_1, hit).z).w); }

struct Sums {
  uint count;
  Fixed64 red, green, blue;
  uint highs;                // bits that the high words have ever had
  uint clamped, overflow;    // events: counted here and told once a search, atomics being dear
};

Sums no_sums() { return Sums(0u, Fixed64(0u, 0u), Fixed64(0u, 0u), Fixed64(0u, 0u), 0u, 0u, 0u); }

// Adds a photon of the disc, if `found` and if it counts there. Without branches: lavapipe runs the code of every
// branch, with lanes masked off. packed: the photon's plane SORTED_FLUX.
void add_photon(Receiver receiver, uvec4 packed, bool found, inout Sums sums) {
  Photon photon = unpack_photon_flux(packed);
  vec3 wi = vec3(dot(photon.incident, receiver.tangent), dot(photon.incident, receiver.bitangent),
                 dot(photon.incident, receiver.shading_normal));
  bool accepted = accepts(receiver.geometric_normal, receiver.flags, packed.x, packed.y);
  bool short_enough = int(photon.events) <= receiver.most_events;
  bool counts = found && accepted && short_enough;
  sums.count += counts ? 1u : 0u;
  float factor = merge_normal_factor(wi.z, dot(photon.incident, photon.normal));
  bool clamped = counts && factor > PPM_MAX_NORMAL_FACTOR;
  sums.clamped += clamped ? 1u : 0u;
  // Both normals must have the photon on the same side.
  bool shows = wi.z > 0.0;
  if (kLayers) shows = wi.z != 0.0 && shows == (dot(photon.incident, receiver.geometric_normal) > 0.0);
  factor = counts && shows ? min(factor, PPM_MAX_NORMAL_FACTOR) : 0.0;
  precise vec3 term = bsdf_eval_towards(receiver.bsdf, wi) * (photon.flux * factor);
  bool fits = term.x + term.y + term.z < PPM_FIXED_LIMIT;  // false for NaN, too
  sums.overflow += counts && !fits ? 1u : 0u;
  term = mix(vec3(0.0), term, bvec3(fits && factor > 0.0));
  accumulate_fixed(sums.red, term.x, sums.highs);
  accumulate_fixed(sums.green, term.y, sums.highs);
  accumulate_fixed(sums.blue, term.z, sums.highs);
}

// Ends a search: adds its sums to the hit point's, which no other search does meanwhile.
void add_to_hit_point(uint hit, Sums sums) {
  if (sums.count == 0u) return;
  GatherSum total = gather_sums[hit];
  uint carry0, carry1, carry2;
  Fixed64 red = add_fixed(Fixed64(total.flux[0], total.flux[1]), sums.red, carry0);
  Fixed64 green = add_fixed(Fixed64(total.flux[2], total.flux[3]), sums.green, carry1);
  Fixed64 blue = add_fixed(Fixed64(total.flux[4], total.flux[5]), sums.blue, carry2);
  uint overflow = sums.overflow + carry0 + carry1 + carry2 + (sums.highs >> 31u);
  if (overflow != 0u) atomicAdd(counters[PPM_COUNTER_OVERFLOW], overflow);
  if (sums.clamped != 0u) atomicAdd(counters[PPM_COUNTER_CLAMPED], sums.clamped);
  total.count += sums.count;
  total.flux = uint[6](red.low, red.high, green.low, green.high, blue.low, blue.high);
  gather_sums[hit] = total;
}

#endif
