// Whether a batch of passes may go on: decided on the device, so that the host need not look on.
//
// One invocation. After tracing: every path has ended and the photons of every pass fit. After the searches of a
// tile: none is left to be continued. Otherwise BatchWords::go_on becomes 0, nothing recorded later has any items, and
// the host finds out where to take over.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"

layout(push_constant, scalar) uniform PushBlock { BatchCheckPush push; };
layout(binding = PPM_BIND_BATCH, scalar) buffer Batch { BatchWords batch; };

void after_tracing() {
  bool fits = batch.alive[push.rounds] == 0u;
  for (uint pass = 0u; pass < push.passes; ++pass) fits = fits && batch.photons[pass] <= push.photon_share;
  for (uint pass = 0u; pass < push.passes; ++pass) batch.sortable[pass] = fits ? batch.photons[pass] : 0u;
  batch.go_on = fits ? PPM_GO_ON : 0u;
}

void after_search() {
  if (counters[PPM_COUNTER_CONTINUE] != 0u) batch.go_on = 0u;
  counters[PPM_COUNTER_CONTINUE] = 0u;  // nor may anything be continued
  if (batch.go_on == 0u || push.step != PPM_CHECK_ALL_SEARCHED) return;
  batch.completed = push.pass + 1u;
  batch.clamped = counters[PPM_COUNTER_CLAMPED];
  batch.overflow = counters[PPM_COUNTER_OVERFLOW];
}

void main() {
  if (item_of_invocation(push.first) != push.first) return;
  if (push.step == PPM_CHECK_TRACED) {
    after_tracing();
  } else {
    after_search();
  }
}
