// Read-only buffers are read as texels: 1.3 to 2 times faster than storage buffers on lavapipe, which checks the
// bounds of the latter lane by lane. The one place to change where a device chooses otherwise.
#ifndef PPM_LIB_TEXELS_GLSL
#define PPM_LIB_TEXELS_GLSL

#include "shared/bindings.h"

#define PPM_TEXELS(number, name) layout(binding = number) uniform usamplerBuffer name
#define PPM_FETCH(name, index) texelFetch(name, int(index))

// The same for what may be larger than one buffer ought to be: segments of 2^kSegmentShift texels, all of them full
// but the last, in an array of as many buffers as the constant PPM_SPEC_SEGMENTS + number says. No device need index
// it dynamically; where there is one segment, as in all but huge scenes, nothing of the others is left. (The host
// sets the constant; by default there are as many as there may be, so that no index is out of range.) Plain scenes
// (lib/scene_kinds.glsl) have one segment of each.
#ifdef PPM_PLAIN_SCENE
#define PPM_SEGMENTED_TEXELS(number, name) PPM_TEXELS(number, name)
#define PPM_FETCH_SEGMENTED(name, index) PPM_FETCH(name, index)
#else
layout(constant_id = PPM_SPEC_SEGMENT_SHIFT) const uint kSegmentShift = 23u;

#define PPM_FETCH_SEGMENT(name, i) \
  if (name##_segments > i && segment == i) return texelFetch(name[i], within);

#define PPM_SEGMENTED_TEXELS(number, name)                                                   \
  layout(constant_id = PPM_SPEC_SEGMENTS + number) const uint name##_segments = PPM_SEGMENTS; \
  layout(binding = number) uniform usamplerBuffer name[name##_segments];                     \
  uvec4 name##_texel(uint index) {                                                           \
    if (name##_segments == 1u) return texelFetch(name[0], int(index));                       \
    uint segment = index >> kSegmentShift;                                                   \
    int within = int(index & ((1u << kSegmentShift) - 1u));                                  \
    PPM_FETCH_SEGMENT(name, 1) PPM_FETCH_SEGMENT(name, 2) PPM_FETCH_SEGMENT(name, 3)         \
    PPM_FETCH_SEGMENT(name, 4) PPM_FETCH_SEGMENT(name, 5) PPM_FETCH_SEGMENT(name, 6)         \
    PPM_FETCH_SEGMENT(name, 7) PPM_FETCH_SEGMENT(name, 8) PPM_FETCH_SEGMENT(name, 9)         \
    PPM_FETCH_SEGMENT(name, 10) PPM_FETCH_SEGMENT(name, 11) PPM_FETCH_SEGMENT(name, 12)      \
    PPM_FETCH_SEGMENT(name, 13) PPM_FETCH_SEGMENT(name, 14) PPM_FETCH_SEGMENT(name, 15)      \
    return texelFetch(name[0], within);                                                      \
  }
#define PPM_FETCH_SEGMENTED(name, index) name##_texel(index)
#endif

#endif
