// Evaluates the shared text on the device, see shared_probe.h.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "shared_probe.h"

layout(push_constant, scalar) uniform PushBlock { uint first, count, which; } push;
layout(binding = PPM_BIND_TEST_0, scalar) readonly buffer Inputs { ProbeWords inputs[]; };
layout(binding = PPM_BIND_TEST_1, scalar) writeonly buffer Outputs { ProbeWords outputs[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  outputs[item] = probe(push.which, inputs[item]);
}
