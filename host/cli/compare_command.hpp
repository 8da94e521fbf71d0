// `ppm-vk compare`: methods against the same clock, and a report.
#pragma once

#include "options.hpp"

namespace ppm::cli {

/// Returns the exit code: 0 done, 130 interrupted (the folder goes on with the same command).
/// Throws Failure for a scene, folder, reference or device that cannot serve, and once the report
/// is written for methods that failed.
int compare_command(const CompareOptions& options);

}  // namespace ppm::cli
