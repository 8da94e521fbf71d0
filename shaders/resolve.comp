// Radiance evaluation [HOJ08 section 4.3, Eq. 13]: the picture from the hit points.
//
// One invocation a pixel of the tile. Sums its hit points in canonical order, PPM_RESOLVE_SLICE of them a dispatch;
// the first dispatch of a picture starts from zero.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texels.glsl"

layout(push_constant, scalar) uniform PushBlock { ResolvePush push; };
PPM_TEXELS(PPM_BIND_HITS_1, hits_1);
PPM_TEXELS(PPM_BIND_HITS_2, hits_2);
PPM_TEXELS(PPM_BIND_STATISTICS, statistics);
layout(binding = PPM_BIND_SAMPLE_START, scalar) readonly buffer SampleStarts { uint sample_start[]; };
layout(binding = PPM_BIND_ORDER, scalar) readonly buffer Order { uint order[]; };
layout(binding = PPM_BIND_PIXELS, scalar) buffer Pixels { vec4 pixels[]; };

void main() {
  uint pixel = item_of_invocation(push.first);
  if (pixel >= push.first + push.count) return;
  uint first = sample_start[pixel * push.samples] + push.skip;
  uint last = min(first + PPM_RESOLVE_SLICE, sample_start[(pixel + 1u) * push.samples]);
  vec3 sum = push.skip == 0u ? vec3(0.0) : pixels[pixel].xyz;
  for (uint i = first; i < last; ++i) {
    uint hit = order[i];
    uvec4 plane1 = PPM_FETCH(hits_1, hit);
    vec3 weight = uintBitsToFloat(PPM_FETCH(hits_2, hit).xyz);
    if ((plane1.w & PPM_HIT_EMISSION) != 0u) {
      sum += weight;
    } else {
      vec3 lambda = uintBitsToFloat(PPM_FETCH(statistics, plane1.z).xyz);
      sum += weight * lambda * push.scale;
    }
  }
  // Brighter than a float can say: as bright as one can.
  pixels[pixel] = vec4(min(sum, vec3(3.4028234e38)), 1.0);
}
