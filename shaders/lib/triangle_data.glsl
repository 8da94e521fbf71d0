// What triangles say of a point on them: texture coordinates, colours, tangents.
#ifndef PPM_LIB_TRIANGLE_DATA_GLSL
#define PPM_LIB_TRIANGLE_DATA_GLSL

#include "lib/scene_kinds.glsl"

#include "lib/texture.glsl"
#include "shared/geometry.h"

PPM_SEGMENTED_TEXELS(PPM_BIND_TRIANGLE_SHADING, triangle_shading);
PPM_SEGMENTED_TEXELS(PPM_BIND_TRIANGLE_DETAILS, triangle_details);

// Weights of the three corners; `barycentric` are those of the corners 1 and 2.
vec3 corner_weights(vec2 barycentric) { return vec3(1.0 - barycentric.x - barycentric.y, barycentric); }

vec4 unpack_color(uvec2 words) { return vec4(unpackUnorm2x16(words.x), unpackUnorm2x16(words.y)); }

// COLOR_0, from the texels 2 and 3 of TRIANGLE_SHADING.
vec4 color_at(uvec4 c, uvec4 d, vec3 weights) {
  return unpack_color(c.zw) * weights.x + unpack_color(d.xy) * weights.y + unpack_color(d.zw) * weights.z;
}

// What TRIANGLE_DETAILS says: the second set of coordinates, and the tangent with its handedness.
struct Details {
  vec2 texcoord1;
  vec4 tangent;
};

Details details_at(uint triangle, vec3 weights) {
  uvec4 a = PPM_FETCH_SEGMENTED(triangle_details, PPM_DETAIL_TEXELS * triangle);
  uvec4 b = PPM_FETCH_SEGMENTED(triangle_details, PPM_DETAIL_TEXELS * triangle + 1u);
  uint tangent2 = PPM_FETCH_SEGMENTED(triangle_details, PPM_DETAIL_TEXELS * triangle + 2u).x;
  vec2 texcoord1 = uintBitsToFloat(a.xy) * weights.x + uintBitsToFloat(a.zw) * weights.y +
                   uintBitsToFloat(b.xy) * weights.z;
  vec3 tangent = unpack_direction(b.z) * weights.x + unpack_direction(b.w) * weights.y +
                 unpack_direction(tangent2) * weights.z;
  float mirrored = dot(weights, vec3(b.z & 1u, b.w & 1u, tangent2 & 1u));
  return Details(texcoord1, vec4(tangent, mirrored > 0.5 ? -1.0 : 1.0));
}

// Both sets of texture coordinates, from the texels 1 and 2 of TRIANGLE_SHADING, and `details` where there are any.
Texcoords texcoords_at(uvec4 b, uvec4 c, vec3 weights, Details details) {
  vec2 set0 = uintBitsToFloat(b.xy) * weights.x + uintBitsToFloat(b.zw) * weights.y +
              uintBitsToFloat(c.xy) * weights.z;
  return Texcoords(set0, kDetails ? details.texcoord1 : set0);
}

#endif
