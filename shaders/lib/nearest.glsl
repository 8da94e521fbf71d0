// What a search for the n-th nearest photon (shared/nearest.h) does with the photons it meets.
#ifndef PPM_LIB_NEAREST_GLSL
#define PPM_LIB_NEAREST_GLSL

#include "lib/counters.glsl"
#include "lib/search.glsl"
#include "shared/nearest.h"

layout(push_constant, scalar) uniform PushBlock { NearestPush push; };
layout(binding = PPM_BIND_NEAREST, scalar) buffer Searches { NearestSearch searches[]; };
layout(binding = PPM_BIND_CONTINUE_OUT, scalar) writeonly buffer ContinueOut { GatherCursor continue_out[]; };

// Of the hit point in hand.
vec3 hit_position, hit_normal;
uint hit_flags;
int most_events;
NearestSearch known;
float least_distance2, reach2;

// What this search has found.
uvec3 counts;
uint nearest[PPM_NEAREST_LIST];

void forget() {
  counts = uvec3(0u);
  for (uint i = 0u; i < PPM_NEAREST_LIST; ++i) nearest[i] = 0xffffffffu;
}

void begin_search(uint hit) {
  uvec4 plane0 = PPM_FETCH(hits_0, hit);
  hit_position = uintBitsToFloat(plane0.xyz);
  hit_normal = unpack_direction(plane0.w);
  hit_flags = PPM_FETCH(hits_1, hit).w;
  most_events = most_photon_events(push.max_depth, hit_flags);
  known = searches[hit];
  least_distance2 = known.from == PPM_NEAREST_LEAST ? 0.0 : uintBitsToFloat(known.from);
  reach2 = uintBitsToFloat(nearest_reach(known, push.wanted));
  forget();
}

void keep_nearer(uint i, inout uint word) {
  uint nearer = min(nearest[i], word);
  word = max(nearest[i], word);
  nearest[i] = nearer;
}

// Keeps the smallest words in order, equal ones as often as they come. No loop: its turns would count, and all loops
// of an invocation may take 65535 together on some drivers.
void keep_if_near(uint word) {
  keep_nearer(0u, word);
  keep_nearer(1u, word);
  keep_nearer(2u, word);
  keep_nearer(3u, word);
  keep_nearer(4u, word);
  keep_nearer(5u, word);
  keep_nearer(6u, word);
  keep_nearer(7u, word);
}

// A photon in reach, if `found`. Without branches, as add_photon.
void count_photon(uint photon, bool found) {
  vec3 position = uintBitsToFloat(PPM_FETCH(sorted_position, photon).xyz);
  uvec4 packed = PPM_FETCH(sorted_flux, photon);
  bool accepted = accepts(hit_normal, hit_flags, packed.x, packed.y);
  bool short_enough = int(packed.w >> 24u) <= most_events;
  bool here = found && accepted && short_enough;
  uint word = nearest_word(squared_distance(position, hit_position));
  word = here && word >= known.from ? word : 0xffffffffu;
  counts += uvec3(lessThanEqual(uvec3(word), uvec3(known.words[0], known.words[1], known.words[2])));
  keep_if_near(word);
}

// Ends a search among some of the photons, or a part of one: no other deals with the hit point meanwhile.
void add_to_search(uint hit) {
  if (nearest_lists(known, push.wanted)) {
    for (uint i = 0u; i < PPM_NEAREST_LIST; ++i) keep_if_near(known.words[i]);
    for (uint i = 0u; i < PPM_NEAREST_LIST; ++i) searches[hit].words[i] = nearest[i];
  } else if (counts.z != 0u) {
    for (uint i = 0u; i < 3u; ++i) searches[hit].words[3u + i] = known.words[3u + i] + counts[i];
  }
}

void leave_cursor(uint hit, uint row, uint offset) {
  uint slot = atomicAdd(counters[PPM_COUNTER_CONTINUE], 1u);
  if (slot < push.cursor_capacity) continue_out[slot] = GatherCursor(hit, row, offset);
}

#endif
