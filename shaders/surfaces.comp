// Layers of a picture: what the eye paths of each pixel found first, seen through mirrors and smooth glass.
//
// One invocation a pixel of the tile. Sums its records (eye.comp with kSurfaces) in canonical order,
// PPM_RESOLVE_SLICE of them a dispatch; the first dispatch starts from zero. Writes four sums a pixel to PIXELS:
// weight times albedo, by channel; then by mean weight the position and the path's length, the geometric normal and
// the weight itself, the shading normal. Records of one pixel alone go into its sums, so that tiles do not matter.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texels.glsl"
#include "shared/geometry.h"

layout(push_constant, scalar) uniform PushBlock { ResolvePush push; };
PPM_TEXELS(PPM_BIND_HITS_0, hits_0);
PPM_TEXELS(PPM_BIND_HITS_1, hits_1);
PPM_TEXELS(PPM_BIND_HITS_2, hits_2);
PPM_TEXELS(PPM_BIND_HITS_3, hits_3);
layout(binding = PPM_BIND_SAMPLE_START, scalar) readonly buffer SampleStarts { uint sample_start[]; };
layout(binding = PPM_BIND_ORDER, scalar) readonly buffer Order { uint order[]; };
layout(binding = PPM_BIND_PIXELS, scalar) buffer Pixels { vec4 pixels[]; };

void main() {
  uint pixel = item_of_invocation(push.first);
  if (pixel >= push.first + push.count) return;
  uint first = sample_start[pixel * push.samples] + push.skip;
  uint last = min(first + PPM_RESOLVE_SLICE, sample_start[(pixel + 1u) * push.samples]);
  vec4 albedo = vec4(0.0), place = vec4(0.0), geometric = vec4(0.0), shading = vec4(0.0);
  if (read_at_run_time(push.skip, pixel) != 0u) {
    albedo = pixels[4u * pixel];
    place = pixels[4u * pixel + 1u];
    geometric = pixels[4u * pixel + 2u];
    shading = pixels[4u * pixel + 3u];
  }
  for (uint i = first; i < last; ++i) {
    uint record = order[i];
    uvec4 plane0 = PPM_FETCH(hits_0, record);
    uvec4 plane1 = PPM_FETCH(hits_1, record);
    vec3 weight = uintBitsToFloat(PPM_FETCH(hits_2, record).xyz);
    float mean = mean_component(weight);
    albedo += vec4(weight * uintBitsToFloat(PPM_FETCH(hits_3, record).xyz), 0.0);
    place += mean * vec4(uintBitsToFloat(plane0.xyz), uintBitsToFloat(plane1.y));
    geometric += mean * vec4(unpack_direction(plane0.w), 1.0);
    shading += mean * vec4(unpack_direction(plane1.x), 0.0);
  }
  pixels[4u * pixel] = albedo;
  pixels[4u * pixel + 1u] = place;
  pixels[4u * pixel + 2u] = geometric;
  pixels[4u * pixel + 3u] = shading;
}
