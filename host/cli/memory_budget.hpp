// Whether a rendering fits the memory there is, said before it is begun.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "memory_plan.hpp"

namespace ppm::cli {

/// "4G", "512M", "1.5g", "65536K", or bytes: powers of 1024, above 0.
std::optional<std::uint64_t> parse_size(std::string_view text);

/// What a rendering may take.
struct MemoryLimits {
  std::optional<std::uint64_t> budget;  ///< --memory-budget: in all, instead of the others
  std::uint64_t machine = 0;            ///< what the machine has left
  /// Of a device with memory of its own; nothing: it shares the machine's, or is not known yet.
  std::optional<std::uint64_t> device;
};

/// Throws Failure, which names what takes how much and what would mend it, where the plan's peak is
/// beyond the limits.
void check_memory(const std::string& file, const render::MemoryPlan& plan,
                  const MemoryLimits& limits);

}  // namespace ppm::cli
