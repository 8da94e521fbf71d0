// What a round of the pilot decides about a hit point.
#ifndef PPM_LIB_PILOT_GLSL
#define PPM_LIB_PILOT_GLSL

#include "shared/geometry.h"
#include "shared/layout.h"

// The radius squared of a hit point that found so many photons, or `enough`; 0: the next round decides.
// `mark` is what stands in its place until then, the footprint squared, negated.
float radius2_from_round(PilotPush push, float mark, bool enough, uint found) {
  float least = square(push.footprints_min) * -mark;
  float most = square(push.round_index == 0u ? push.radius : 2.0 * push.radius);
  if (enough && push.last_round == 0u && square(push.radius) > least) return 0.0;
  // With less than the wanted in the first round this is the largest radius there is.
  float radius2 = square(push.radius) * float(push.wanted) / float(max(found, 1u));
  return clamp(enough ? least : radius2, min(least, most), most);
}

#endif
