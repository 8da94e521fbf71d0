// What tests ask the layer that was loaded into their own process.
#pragma once

#include <cstdint>

extern "C" {

/// How often this function was called, such as "vkQueueSubmit", failed calls included; 0 also for
/// those that the layer does not know.
std::uint64_t ppm_layer_calls(const char* call);

/// Names of the functions that the layer takes part in, from index 0 on; null at their end.
const char* ppm_layer_function(unsigned index);

/// Objects of this kind that live, such as "Buffer"; "": of all kinds.
std::int64_t ppm_layer_live(const char* kind);
}
