// A compute shader as the build embeds it.
#pragma once

#include <cstdint>
#include <span>

namespace ppm::gpu {

struct Shader {
  const char* name;                      ///< also the label of its timings
  std::span<const std::uint32_t> words;  ///< validated SPIR-V, entry point `main`
};

}  // namespace ppm::gpu
