// The initial radius where no pilot pass decides it: a fixed one, or so many footprints of the pixel; and for the pilot,
// the mark of hit points that have none yet (the footprint squared, negated).
//
// One invocation a hit point. Reads the footprint squared from STATISTICS.w, which it replaces.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "shared/geometry.h"

layout(push_constant, scalar) uniform PushBlock { RadiusPush push; };
layout(binding = PPM_BIND_STATISTICS, scalar) buffer Statistics { vec4 statistics[]; };

void main() {
  uint hit = item_of_invocation(push.first);
  if (hit >= push.first + push.count) return;
  float footprint2 = statistics[hit].w;
  if (footprint2 <= 0.0) return;  // light seen
  float radius2 = -footprint2;
  if (push.fixed_radius > 0.0) {
    radius2 = square(push.fixed_radius);
  } else if (push.footprints > 0.0) {
    radius2 = footprint2 * square(push.footprints);
  }
  statistics[hit].w = radius2;
}
