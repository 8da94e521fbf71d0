// Whether a rendering fits the memory there is, said before it is begun.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "memory_fit.hpp"

namespace ppm::cli {

/// "4G", "512M", "1.5g", "65536K", or bytes: powers of 1024, above 0.
std::optional<std::uint64_t> parse_size(std::string_view text);

using render::MemoryLimits;

/// Whether the scene has been read; before that its picture may not be known either.
enum class Known { a_part, all };

/// Settings with which the rendering fits the limits (render::fit_memory). Throws Failure, which
/// names what takes how much and what would fit, where there are none.
render::MemoryFit fit_or_refuse(const std::string& file, const render::MemoryDemand& demand,
                                const render::Settings& settings, const MemoryLimits& limits,
                                Known known);

}  // namespace ppm::cli
