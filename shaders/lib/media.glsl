// The media of a scene: what a path in them meets, and what they leave of it.
#ifndef PPM_LIB_MEDIA_GLSL
#define PPM_LIB_MEDIA_GLSL

#include "lib/surface.glsl"
#include "shared/media.h"

PPM_TEXELS(PPM_BIND_MEDIA, media_records);

MediumRecord fetch_medium(uint medium) {
  uvec4 a = PPM_FETCH(media_records, PPM_MEDIUM_TEXELS * (medium - 1u));
  uvec4 b = PPM_FETCH(media_records, PPM_MEDIUM_TEXELS * (medium - 1u) + 1u);
  return MediumRecord(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.x), b.y, b.z, b.w);
}

// What is left of light after `distance` in these media.
vec3 media_transmittance(uint media, float distance) {
  if (!kMedia || media == PPM_MEDIA_OUTSIDE) return vec3(1.0);
  uvec4 first = PPM_FETCH(media_records, PPM_MEDIUM_TEXELS * (media_current(media) - 1u));
  return exp(-uintBitsToFloat(first.xyz) * distance);
}

// Index of refraction, 1 outside all media.
float media_ior(uint media) {
  if (media == PPM_MEDIA_OUTSIDE) return 1.0;
  return uintBitsToFloat(PPM_FETCH(media_records, PPM_MEDIUM_TEXELS * (media_current(media) - 1u)).w);
}

// The same of each channel.
vec3 media_channel_ior(uint media) {
  if (media == PPM_MEDIA_OUTSIDE) return vec3(1.0);
  MediumRecord medium = fetch_medium(media_current(media));
  return vec3(dispersed_ior(medium.ior, medium.dispersion, 0u), medium.ior,
              dispersed_ior(medium.ior, medium.dispersion, 2u));
}

// The surface as a path in `media` meets it.
struct Crossing {
  MediaInterface sides;
  bool straight;  // light does not notice the surface: nothing happens there
};

// Tells the surface what lies before and behind it. A surface that gives off light is always met.
Crossing cross_media(inout Surface surface, uint media) {
  Crossing crossing = Crossing(MediaInterface(media, media), false);
  if (kMedia && surface.medium != 0u) {
    crossing.sides = media_interface(media, surface.medium, surface.front);
    surface.bsdf.eta = media_ior(crossing.sides.after) / media_ior(crossing.sides.before);
    if (kDispersion) {
      surface.channel_eta = media_channel_ior(crossing.sides.after) / media_channel_ior(crossing.sides.before);
    }
    crossing.straight = !is_real_interface(crossing.sides) && (surface.flags & PPM_MATERIAL_EMITS) == 0u;
  }
  return crossing;
}

#endif
