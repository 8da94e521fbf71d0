// `ppm-vk resume`.
#pragma once

#include "options.hpp"

namespace ppm::cli {

/// Returns the exit code; throws Failure.
int resume_command(const ResumeOptions& options);

}  // namespace ppm::cli
