// Photon map: the searches for hit points' n-th nearest photons begin.
//
// One invocation for each hit point that takes part, every `stride`-th in SEARCH_ORDER; writes NEAREST, and the hit
// point's number to the list CONTINUE_OUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/texels.glsl"
#include "shared/nearest.h"

layout(push_constant, scalar) uniform PushBlock { NearestStepPush push; };
PPM_TEXELS(PPM_BIND_SEARCH_ORDER, search_order);
PPM_TEXELS(PPM_BIND_STATISTICS, statistics);
layout(binding = PPM_BIND_NEAREST, scalar) writeonly buffer Searches { NearestSearch searches[]; };
layout(binding = PPM_BIND_CONTINUE_OUT, scalar) writeonly buffer ContinueOut { uint continue_out[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  uint place = item * push.stride;
  uint hit = PPM_FETCH(search_order, place >> 2u)[place & 3u];
  float guess = push.guess;
  if (guess <= 0.0) guess *= -uintBitsToFloat(PPM_FETCH(statistics, hit).w);
  searches[hit] = nearest_begin(guess, push.spread, push.most);
  continue_out[item] = hit;
}
