// Adds what a test gives to the film.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/film.glsl"

struct Splat {
  uint pixel;
  vec3 radiance;
};

layout(push_constant, scalar) uniform PushBlock { uint first, count; } push;
layout(binding = PPM_BIND_TEST_0, scalar) readonly buffer Splats { Splat splats[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  film_add(splats[item].pixel, splats[item].radiance);
}
