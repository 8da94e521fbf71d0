// Sharing between the invocations of a subgroup, of any power of two's size, all of which must take part.
//
// Made of shuffles alone: on lavapipe a shuffle is one instruction, the built-in reductions and votes are loops.
#ifndef PPM_LIB_SUBGROUP_GLSL
#define PPM_LIB_SUBGROUP_GLSL

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

// A power of two. Known to the compiler, so that it can unroll loops over the subgroup.
layout(constant_id = PPM_SPEC_SUBGROUP_SIZE) const uint kSubgroupSize = 32u;

uint lane() { return gl_SubgroupInvocationID & (kSubgroupSize - 1u); }

uint subgroup_min(uint x) {
  for (uint mask = kSubgroupSize / 2u; mask > 0u; mask /= 2u) x = min(x, subgroupShuffleXor(x, mask));
  return x;
}
uint subgroup_max(uint x) {
  for (uint mask = kSubgroupSize / 2u; mask > 0u; mask /= 2u) x = max(x, subgroupShuffleXor(x, mask));
  return x;
}
uint subgroup_sum(uint x) {
  for (uint mask = kSubgroupSize / 2u; mask > 0u; mask /= 2u) x += subgroupShuffleXor(x, mask);
  return x;
}
uvec3 subgroup_min(uvec3 v) { return uvec3(subgroup_min(v.x), subgroup_min(v.y), subgroup_min(v.z)); }
uvec3 subgroup_max(uvec3 v) { return uvec3(subgroup_max(v.x), subgroup_max(v.y), subgroup_max(v.z)); }

// Sum over this invocation and those before it.
uint subgroup_inclusive_sum(uint x) {
  for (uint offset = 1u; offset < kSubgroupSize; offset *= 2u) {
    uint before = subgroupShuffle(x, (lane() - offset) & (kSubgroupSize - 1u));
    x += lane() >= offset ? before : 0u;
  }
  return x;
}

#endif
