// `ppm-vk bench`: how fast it renders, and whether that was better before.
#pragma once

#include "options.hpp"

namespace ppm::cli {

/// Returns the exit code: 0 done, 130 interrupted (nothing is written then). Throws Failure for a
/// scene, file or device that cannot serve, and for figures that are worse than they were.
int bench_command(const BenchOptions& options);

}  // namespace ppm::cli
