// Looks up a texture at coordinates given by a test.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texture.glsl"

layout(push_constant, scalar) uniform PushBlock { uint first, count; } push;
layout(binding = PPM_BIND_TEST_0, scalar) readonly buffer Lookups { uvec3 lookups[]; };  // texture, s, t
layout(binding = PPM_BIND_TEST_1, scalar) writeonly buffer Colors { vec4 colors[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  uvec3 lookup = lookups[item];
  colors[item] = sample_texture(lookup.x, uintBitsToFloat(lookup.yz));
}
