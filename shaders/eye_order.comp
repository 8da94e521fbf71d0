// Canonical order of hit points, step 3: those of each eye path sorted.
//
// One invocation an entry of ARRIVALS; writes ORDER. Its place within its eye path is its rank by (order, code), which
// are unique; so what is found in the places of ORDER is a function of the scene and the options alone.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"

layout(push_constant, scalar) uniform PushBlock { EyeOrderPush push; };
layout(binding = PPM_BIND_HIT_KEYS, scalar) readonly buffer HitKeys { HitKey hit_keys[]; };
layout(binding = PPM_BIND_SAMPLE_START, scalar) readonly buffer SampleStarts { uint sample_start[]; };
layout(binding = PPM_BIND_ARRIVALS, scalar) readonly buffer Arrivals { uint arrivals[]; };
layout(binding = PPM_BIND_ORDER, scalar) writeonly buffer Order { uint order[]; };

bool before(HitKey a, HitKey b) { return a.order < b.order || (a.order == b.order && a.code < b.code); }

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  uint hit = arrivals[item];
  HitKey key = hit_keys[hit];
  uint begin = sample_start[key.group];
  uint end = sample_start[key.group + 1u];
  uint place = begin;
  if (end - begin > 1u) {
    for (uint i = begin; i < end; ++i) place += before(hit_keys[arrivals[i]], key) ? 1u : 0u;
  }
  order[place] = hit;

  if (item == begin && key.group % push.samples == 0u) {
    uint pixel_hits = sample_start[key.group + push.samples] - begin;
    if (pixel_hits > PPM_RESOLVE_SLICE) atomicMax(counters[PPM_COUNTER_MAX_PIXEL_HITS], pixel_hits);
  }
}
