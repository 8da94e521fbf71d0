// Counters that the host reads back. Integer atomics: their sums do not depend on order.
#ifndef PPM_LIB_COUNTERS_GLSL
#define PPM_LIB_COUNTERS_GLSL

layout(binding = PPM_BIND_COUNTERS, scalar) buffer Counters { uint counters[]; };

void count_event(uint counter) { atomicAdd(counters[counter], 1u); }

#endif
