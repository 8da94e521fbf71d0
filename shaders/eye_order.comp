// Canonical order of hit points, step 4: each copied to its final place, and its statistics made ready.
//
// One invocation an entry of ORDER. Its place within its eye path is its rank by (order, code), which
// are unique; so the final order is a function of the scene and the options alone.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"
#include "shared/geometry.h"

layout(push_constant, scalar) uniform PushBlock { EyeOrderPush push; };
layout(binding = PPM_BIND_STAGED_HITS, scalar) readonly buffer StagedHits { HitPoint staged_hits[]; };
layout(binding = PPM_BIND_STAGED_KEYS, scalar) readonly buffer StagedKeys { StagedKey staged_keys[]; };
layout(binding = PPM_BIND_SAMPLE_START, scalar) readonly buffer SampleStarts { uint sample_start[]; };
layout(binding = PPM_BIND_ORDER, scalar) readonly buffer Order { uint order[]; };
layout(binding = PPM_BIND_HITS_0, scalar) writeonly buffer Hits0 { uvec4 hits_0[]; };
layout(binding = PPM_BIND_HITS_1, scalar) writeonly buffer Hits1 { uvec4 hits_1[]; };
layout(binding = PPM_BIND_HITS_2, scalar) writeonly buffer Hits2 { uvec4 hits_2[]; };
layout(binding = PPM_BIND_HITS_3, scalar) writeonly buffer Hits3 { uvec4 hits_3[]; };
layout(binding = PPM_BIND_STATISTICS, scalar) writeonly buffer Statistics { vec4 statistics[]; };

bool before(StagedKey a, StagedKey b) { return a.order < b.order || (a.order == b.order && a.code < b.code); }

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  uint staged = order[item];
  StagedKey key = staged_keys[staged];
  uint begin = sample_start[key.group];
  uint end = sample_start[key.group + 1u];
  uint slot = begin;
  for (uint i = begin; i < end; ++i) slot += before(staged_keys[order[i]], key) ? 1u : 0u;

  HitPoint hit = staged_hits[staged];
  hits_0[slot] = uvec4(floatBitsToUint(hit.position), hit.geometric_normal);
  hits_1[slot] = uvec4(hit.shading_normal, hit.outgoing, slot, hit.flags);
  hits_2[slot] = uvec4(floatBitsToUint(hit.weight), hit.bsdf_extra);
  hits_3[slot] = hit.bsdf;
  // Until the first radius is found its place holds the footprint; light seen has none and is never searched.
  statistics[slot] = vec4(0.0, 0.0, 0.0, square(key.footprint));

  if (item == begin && key.group % push.samples == 0u) {
    uint pixel_hits = sample_start[key.group + push.samples] - begin;
    atomicMax(counters[PPM_COUNTER_MAX_PIXEL_HITS], pixel_hits);
  }
}
