// Which item an invocation works on.
#ifndef PPM_LIB_INVOCATION_GLSL
#define PPM_LIB_INVOCATION_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "shared/bindings.h"
#include "shared/layout.h"

layout(local_size_x = PPM_WORKGROUP_SIZE, local_size_x_id = PPM_SPEC_WORKGROUP_SIZE) in;
layout(constant_id = PPM_SPEC_ALTERNATE_HALVES) const bool kAlternateHalves = true;

// Lavapipe hands each of its threads one contiguous half of the workgroups and steals nothing. Work that is dear in one
// part of the range is shared evenly when consecutive blocks of items alternate between the halves.
uint item_of_invocation(uint first) {
  uint group = gl_WorkGroupID.x;
  uint half_count = (gl_NumWorkGroups.x + 1u) / 2u;
  uint block = group;
  if (kAlternateHalves) block = group < half_count ? 2u * group : 2u * (group - half_count) + 1u;
  return first + block * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

// A word of the push block that decides which way a kernel goes. Where such a word alone decides over most of a kernel,
// lavapipe compiles the kernel anew whenever the word changes, and never frees the old ones. An item (below 2^31) in the
// sum keeps it from seeing that all invocations have the same.
uint read_at_run_time(uint word, uint item) { return word + (item >> 31u); }

#endif
